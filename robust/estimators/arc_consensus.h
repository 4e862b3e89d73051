// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Quatro without a graph: the motion on the ground from very many matches,
// nearly all of them wrong, in memory O(N + M).
//
//   M random pairs of matches
//     -> those that keep their planar length and height difference
//     -> yaw by the exact sweep of their differences
//     (solvers/closed_form/exact_yaw.h)
//     -> translation axis by axis from the matches of the agreeing pairs
//     -> yaw and translation once more from all matches that agree.
//
// Of N matches with inlier ratio e, M e^2 of the pairs are right; they agree in
// one arc of the circle, while the wrong ones that pass the gate spread over
// all of it. So M is what decides, not N: M e^2 of 50 and more is safe. There
// is no clique, hence nothing to grow with the square of N.

#ifndef QUATRO_ROBUST_ESTIMATORS_ARC_CONSENSUS_H_
#define QUATRO_ROBUST_ESTIMATORS_ARC_CONSENSUS_H_

#include <Eigen/Core>
#include <cstdint>
#include <string>

#include "features/base/types.h"
#include "robust/estimators/pose_summary.h"

namespace quatro {

// How far a match may be off, and how many pairs are drawn.
struct ArcConsensusOptions {
  double noise_bound = 0.3;  // How far a right match may be off [m].
  double max_tilt = 0.035;   // Between the scans, widens the height gate [rad].

  // M. All pairs are taken if there are no more.
  Eigen::Index num_pairs = 1'000'000;

  // Shorter pairs say little about the yaw and pass the gate by chance [m].
  double min_planar_length = 3.0;

  std::uint64_t seed = 0;
  int num_threads = 1;  // 0: all cores. Never changes the answer.

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// `consistent` are the matches of the pairs that agree with the yaw;
// `translation_inliers` are all that agree with the pose.
//
// Column i of `source` is matched with column i of `target` [m].
PoseSummary SolveArcConsensus(const PointsRef& source,
                              const PointsRef& target,
                              const ArcConsensusOptions& options);

}  // namespace quatro

#endif  // QUATRO_ROBUST_ESTIMATORS_ARC_CONSENSUS_H_
