// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Matched points with a known motion on the ground, drawn by a seed. Estimators
// are compared on these families of problems.
//
//   q_i = R_z(yaw) p_i + t + noise     for inliers,
//
// with |yaw| <= pi, |t_x|, |t_y| <= 20 m, |t_z| <= 1 m. Points are within 50 m
// in x and y and 4 m in z of the sensor. The noise is normal on each axis.

#ifndef QUATRO_EXPERIMENTS_SIMULATOR_SYNTHETIC_H_
#define QUATRO_EXPERIMENTS_SIMULATOR_SYNTHETIC_H_

#include <Eigen/Core>
#include <cstdint>

#include "features/base/rigid3.h"
#include "features/base/types.h"
#include "solvers/closed_form/gravity.h"

namespace quatro {

struct MatchedProblem {
  Points source;  // [m]
  Points target;  // [m]
  Rigid3 true_target_from_source;
};

// For the share `outlier_ratio` of the matches, the target is a random point.
// The inliers come last.
MatchedProblem MakeOutlierProblem(Eigen::Index num_matches,
                                  double outlier_ratio,
                                  double noise_sigma,
                                  std::uint64_t seed);

// Similar to a hard pair after pruning: `num_true` inliers among gross
// outliers. No outlier is consistent with another match within
// `consistency_bound` [m].
MatchedProblem MakeDegenerateProblem(Eigen::Index num_matches,
                                     Eigen::Index num_true,
                                     double noise_sigma,
                                     double consistency_bound,
                                     std::uint64_t seed);

// `num_true` matches are inliers, `num_quasi` are quasi-inliers, 0.5-3 m too
// high or too low, and the targets of the others are random points.
MatchedProblem MakeQuasiInlierProblem(Eigen::Index num_matches,
                                      Eigen::Index num_true,
                                      Eigen::Index num_quasi,
                                      double noise_sigma,
                                      std::uint64_t seed);

// TIMs that have passed a test of their lengths: source and target have equal
// lengths within the noise. The share `outlier_ratio` of the TIMs is rotated by
// random yaws. The true rotation is a yaw; there is no translation.
MatchedProblem MakeTimProblem(Eigen::Index num_tims,
                              double outlier_ratio,
                              double noise_sigma,
                              std::uint64_t seed);

// Matches on a hill, and the two attitudes measured by an INS.
struct SlopeProblem {
  MatchedProblem matches;
  Attitude source_attitude;
  Attitude target_attitude;
};

// Like MakeOutlierProblem, but the source is tilted by `tilt` [rad] relative to
// the target in any direction, and the target relative to the horizon by up to
// 0.1 rad in roll and pitch. The INS has an error of `attitude_std` [rad] in
// each angle.
SlopeProblem MakeSlopeProblem(Eigen::Index num_matches,
                              double outlier_ratio,
                              double noise_sigma,
                              double tilt,
                              double attitude_std,
                              std::uint64_t seed);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_SIMULATOR_SYNTHETIC_H_
