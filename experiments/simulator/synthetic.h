// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Matched points with a known motion on the ground, by seed: the families on
// which estimators are compared.
//
//   q_i = R_z(yaw) p_i + t + noise     for true matches,
//
// |yaw| <= pi, |t_x|, |t_y| <= 20 m, |t_z| <= 1 m; points within 50 m in x and
// y and 4 m in z of the sensor; noise normal on each axis.

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

// `outlier_ratio` of the matches have a target drawn anywhere. The true ones
// come last.
MatchedProblem MakeOutlierProblem(Eigen::Index num_matches,
                                  double outlier_ratio,
                                  double noise_sigma,
                                  std::uint64_t seed);

// As what pruning leaves of a hard pair: `num_true` true matches among gross
// outliers of which no two, and none with a true one, keep a length within
// `consistency_bound` [m].
MatchedProblem MakeDegenerateProblem(Eigen::Index num_matches,
                                     Eigen::Index num_true,
                                     double noise_sigma,
                                     double consistency_bound,
                                     std::uint64_t seed);

// `num_quasi` of the matches are right in x and y and 0.5-3 m off in z, up or
// down; `num_true` are right, the others drawn anywhere.
MatchedProblem MakeQuasiInlierProblem(Eigen::Index num_matches,
                                      Eigen::Index num_true,
                                      Eigen::Index num_quasi,
                                      double noise_sigma,
                                      std::uint64_t seed);

// Differences of matches as after a gate on their lengths: source and target
// agree in length to within the noise, and `outlier_ratio` of them are turned
// anyhow. The true rotation is a yaw; there is no translation.
MatchedProblem MakeTimProblem(Eigen::Index num_tims,
                              double outlier_ratio,
                              double noise_sigma,
                              std::uint64_t seed);

// Matches on a hill, and what an INS says of the two attitudes.
struct SlopeProblem {
  MatchedProblem matches;
  Attitude source_attitude;
  Attitude target_attitude;
};

// As MakeOutlierProblem, but that the source is tilted by `tilt` [rad] against
// the target in any direction, and the target against the horizon by up to 0.1
// rad in roll and pitch. The INS is off by `attitude_std` [rad] in each angle.
SlopeProblem MakeSlopeProblem(Eigen::Index num_matches,
                              double outlier_ratio,
                              double noise_sigma,
                              double tilt,
                              double attitude_std,
                              std::uint64_t seed);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_SIMULATOR_SYNTHETIC_H_
