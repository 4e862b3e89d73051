// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Quatro without a consistency graph: the motion on the ground,
//
//   q_i = R_z(yaw) p_i + t + noise,
//
// from very many matches, most of them outliers, in memory O(N + M):
//
//   M random pairs of matches
//     -> pairs that keep their planar length and height difference
//     -> yaw by the exact sweep of their differences
//        (solvers/closed_form/exact_yaw.h)
//     -> translation axis by axis from the matches of the inlier pairs
//     -> yaw and translation refitted to all inliers
//
// About M e^2 of the M random pairs consist of two inliers, where e is the
// inlier ratio. The yaws of these pairs lie in one arc of the circle, while
// those of the other pairs that pass the test are spread over all of it. So the
// required M depends on e but not on N; M e^2 >= 50 is safe. There is no
// clique, and no memory that grows with the square of N. There is no pose if no
// pair passes the test.

#ifndef QUATRO_ROBUST_ESTIMATORS_ARC_CONSENSUS_H_
#define QUATRO_ROBUST_ESTIMATORS_ARC_CONSENSUS_H_

#include <Eigen/Core>
#include <cstdint>
#include <string>

#include "features/base/types.h"
#include "robust/estimators/pose_summary.h"

namespace quatro {

// The noise bound, the pairs, and their number.
struct ArcConsensusOptions {
  // Largest error of an inlier on each axis (half the edge of a box) [m].
  double noise_bound = 0.3;
  double max_tilt = 0.035;  // Between the scans; widens the height test [rad].

  // M. All pairs are used if there are no more than this.
  Eigen::Index num_pairs = 1'000'000;

  // Pairs whose planar length is below this many noise bounds are rejected,
  // because they say little about the yaw and pass the test by chance.
  double min_planar_length_factor = 10.0;

  std::uint64_t seed = 0;
  int num_threads = 1;  // 0: all cores. Does not change the result.

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// Column i of `source` is matched with column i of `target` [m]; z is up. In
// the summary, `consistent` are the matches of the pairs that are inliers of
// the yaw, and `translation_inliers` are all inliers of the pose.
PoseSummary SolveArcConsensus(const PointsRef& source,
                              const PointsRef& target,
                              const ArcConsensusOptions& options);

}  // namespace quatro

#endif  // QUATRO_ROBUST_ESTIMATORS_ARC_CONSENSUS_H_
