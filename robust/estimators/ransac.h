// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// RANSAC on matched points: of the poses that minimal samples give
// (robust/estimators/minimal_pose.h), the one that explains the matches best,
//
//   R, t = argmin  sum_i min( |q_i - R p_i - t|^2 / b^2, 1 ),              (1)
//
// then least squares on its inliers, |q_i - R p_i - t| <= b, until these stay
// the same. (1) is the cost of MSAC, which unlike the count of inliers tells
// poses with the same count apart.
//
// With I of N matches inliers, a sample of m holds no outlier with chance
// I (I - 1) .. / (N (N - 1) ..), so k samples all hold one with chance
//
//   ( 1 - prod_{j < m} (I - j) / (N - j) )^k <= 1 - confidence,            (2)
//
// where the search stops, I being that of the best pose so far. A sample whose
// sides disagree counts as drawn.
//
// Sample k is a function of seed and k over an order of the matches that is
// their own (robust/estimators/distinct_matches.h): the answer depends on
// neither threads, nor order, nor repetition, bit for bit. kPointAndNormal
// takes each match once and then ends.
//
// Source: Fischler and Bolles, CACM 1981; Torr and Zisserman, "MLESAC", CVIU
// 2000 (MSAC); Chum, Matas and Kittler, "Locally Optimized RANSAC", DAGM 2003,
// with the shrinking bound of Lebeda, Matas and Chum, BMVC 2012.

#ifndef QUATRO_ROBUST_ESTIMATORS_RANSAC_H_
#define QUATRO_ROBUST_ESTIMATORS_RANSAC_H_

#include <Eigen/Core>
#include <cstdint>
#include <string>

#include "features/base/types.h"
#include "robust/estimators/minimal_pose.h"
#include "robust/estimators/pose_summary.h"

namespace quatro {

// The sample, and when enough have been drawn.
struct RansacOptions {
  MinimalPoseOptions minimal;  // And the noise bound b [m].

  std::int64_t max_iterations = 10'000;  // Samples drawn, at most.
  double confidence = 0.999;  // In (2); 1: never stop before max_iterations.

  // Refit every new best pose with the bound shrinking from 3 b to b, and keep
  // the refit where it costs less.
  bool local_optimization = true;

  std::uint64_t seed = 0;
  int num_threads = 1;  // 0: all cores. Never changes the answer.

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// The pose, and what it took to find it.
struct RansacSummary : PoseSummary {
  std::int64_t num_iterations = 0;    // Samples drawn.
  std::int64_t num_hypotheses = 0;    // Of these, gave a pose to score.
  std::int64_t num_improvements = 0;  // Times a new best was found.
  bool is_confident = false;  // (2) held, or no sample was left to draw.
  double cost = 0.0;          // (1) of the answer.
};

// Column i of `source` is matched with column i of `target` [m]. kThreePoints
// needs three matches, kTwoPoints two, kPointAndNormal one and `normals`.
RansacSummary SolveRansac(const PointsRef& source,
                          const PointsRef& target,
                          const RansacOptions& options,
                          const MatchedNormals* normals = nullptr);

// The least k with (2). Infinite if there are fewer inliers than a sample has,
// or for confidence 1 unless all are inliers.
double NumIterationsFor(double confidence,
                        Eigen::Index num_inliers,
                        Eigen::Index num_matches,
                        int sample_size);

}  // namespace quatro

#endif  // QUATRO_ROBUST_ESTIMATORS_RANSAC_H_
