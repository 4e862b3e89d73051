// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Matched points of a known motion among gross outliers. Every draw is a pure
// function of the seed, so that a case that fails can be run alone.

#ifndef QUATRO_TESTS_SUPPORT_MATCHED_PROBLEMS_H_
#define QUATRO_TESTS_SUPPORT_MATCHED_PROBLEMS_H_

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <vector>

#include "features/base/random.h"
#include "features/base/rigid3.h"
#include "features/base/types.h"
#include "tests/support/random_problems.h"

namespace quatro {

// Uniform in [-1, 1).
inline double SignedUniform(Random* random) {
  return 2.0 * random->Uniform() - 1.0;
}

// Uniform in a box about the origin with these half widths [m].
inline Points RandomPointsInBox(Eigen::Index num_points,
                                const Eigen::Vector3d& half_widths,
                                Random* random) {
  return half_widths.asDiagonal() * Points::NullaryExpr(3, num_points, [&] {
           return SignedUniform(random);
         });
}

struct KnownProblem {
  Points source;
  Points target;
  Rigid3 true_target_from_source;
  std::vector<Eigen::Index> inliers;  // Columns, ascending.
};

struct MatchedProblemOptions {
  Eigen::Index num_inliers = 40;
  Eigen::Index num_outliers = 40;
  double noise = 0.05;  // [m], the most an inlier is off on each axis.
  double yaw = 2.0;     // [rad]
  Eigen::Vector3d translation{8.0, -5.0, 0.5};   // [m]
  Eigen::Vector3d half_widths{40.0, 40.0, 4.0};  // [m], of where points are.
};

// Inliers and outliers in random order. An outlier's two points have nothing to
// do with each other, but are where points are.
inline KnownProblem MakeMatchedProblem(const MatchedProblemOptions& options,
                                       std::uint64_t seed) {
  Random random(seed);
  const Eigen::Index n = options.num_inliers + options.num_outliers;
  KnownProblem problem;
  problem.true_target_from_source = {RotationZ(options.yaw),
                                     options.translation};
  problem.source = RandomPointsInBox(n, options.half_widths, &random);
  problem.target = problem.true_target_from_source.Apply(
      RandomPointsInBox(n, options.half_widths, &random));
  std::vector<bool> is_inlier(static_cast<std::size_t>(n), false);
  const auto order = RandomPermutation(n, Mix(seed));
  for (Eigen::Index k = 0; k < options.num_inliers; ++k) {
    is_inlier[static_cast<std::size_t>(order[static_cast<std::size_t>(k)])] =
        true;
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    if (!is_inlier[static_cast<std::size_t>(i)]) continue;
    problem.inliers.push_back(i);
    const Eigen::Vector3d noise =
        RandomPointsInBox(1, Eigen::Vector3d::Constant(options.noise), &random);
    problem.target.col(i) = problem.true_target_from_source *
                                Eigen::Vector3d(problem.source.col(i)) +
                            noise;
  }
  return problem;
}

// The same, and no outlier agrees with any other match in length or in planar
// length, nor is nearer to it than twice `bound` [m]: the inliers are the
// largest consistent set, however few they are.
inline KnownProblem MakeInconsistentProblem(
    const MatchedProblemOptions& options, double bound, std::uint64_t seed) {
  MatchedProblemOptions inliers_only = options;
  inliers_only.num_outliers = 0;
  KnownProblem problem = MakeMatchedProblem(inliers_only, seed);
  const auto agree = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return std::abs(a.norm() - b.norm()) <= 2.0 * bound ||
           std::abs(a.head<2>().norm() - b.head<2>().norm()) <= 2.0 * bound;
  };
  Random random(~seed);
  Eigen::Index n = options.num_inliers;
  problem.source.conservativeResize(3, n + options.num_outliers);
  problem.target.conservativeResize(3, n + options.num_outliers);
  while (n < problem.source.cols()) {
    const Eigen::Vector3d p =
        RandomPointsInBox(1, options.half_widths, &random);
    const Eigen::Vector3d q =
        RandomPointsInBox(1, options.half_widths, &random);
    bool is_alone = true;
    for (Eigen::Index i = 0; i < n && is_alone; ++i) {
      is_alone = !agree(p - problem.source.col(i), q - problem.target.col(i));
    }
    if (!is_alone) continue;
    problem.source.col(n) = p;
    problem.target.col(n) = q;
    ++n;
  }
  return problem;
}

// Column k of the result is column order[k] of `points`.
inline Points Reordered(const PointsRef& points,
                        const std::vector<Eigen::Index>& order) {
  Points reordered(3, static_cast<Eigen::Index>(order.size()));
  for (std::size_t k = 0; k < order.size(); ++k) {
    reordered.col(static_cast<Eigen::Index>(k)) = points.col(order[k]);
  }
  return reordered;
}

// The farthest that two motions take one of these points apart [m].
inline double LargestDisplacement(const Rigid3& a,
                                  const Rigid3& b,
                                  const PointsRef& points) {
  return (a.Apply(points) - b.Apply(points)).colwise().norm().maxCoeff();
}

}  // namespace quatro

#endif  // QUATRO_TESTS_SUPPORT_MATCHED_PROBLEMS_H_
