// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The largest planar consensus, with a certificate:
//
//   max over yaw, t of  #{ i : |e_i,x| <= b, |e_i,y| <= b },               (1)
//   e_i = q_i - R_z(yaw) p_i - t.
//
// by branch and bound over the yaw. While the yaw is within w of a center, the
// translation of match i is within b + 2 |p_i| sin(w / 2) of that at the
// center, on each axis. So the largest number of squares of this half-width
// that share a point bounds (1) on the interval. It is found by a sweep in O(N
// log N). With half-width b, it is (1) at the center.
//
// Heights are ignored. This is an oracle for
// robust/estimators/consensus_search.h, which is a hundred times faster.

#ifndef QUATRO_ROBUST_ESTIMATORS_MAX_CONSENSUS_H_
#define QUATRO_ROBUST_ESTIMATORS_MAX_CONSENSUS_H_

#include <Eigen/Core>
#include <string>

#include "features/base/types.h"

namespace quatro {

// The noise bound, and when the search stops.
struct MaxConsensusOptions {
  double noise_bound = 0.3;  // b, half the edge of a square [m].

  // Intervals of the yaw with at most this half-width are not divided [rad].
  double min_width = 1e-5;

  int max_num_intervals = 100'000;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// The largest consensus found, and an upper bound.
struct MaxConsensus {
  double yaw = 0.0;                                       // [rad]
  Eigen::Vector2d translation = Eigen::Vector2d::Zero();  // [m]
  Eigen::Index num_inliers = 0;                           // (1) at this pose.
  Eigen::Index upper_bound = 0;  // Bounds (1) over all poses.
  int num_intervals = 0;         // Intervals examined.

  // No other pose has more inliers.
  bool IsOptimal() const { return upper_bound == num_inliers; }
};

// Column i of `source` is matched with column i of `target` [m]; all must be
// finite. Without matches all fields are zero.
MaxConsensus FindMaxConsensus(const PointsRef& source,
                              const PointsRef& target,
                              const MaxConsensusOptions& options);

}  // namespace quatro

#endif  // QUATRO_ROBUST_ESTIMATORS_MAX_CONSENSUS_H_
