// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The largest planar consensus, with a certificate:
//
//   max over yaw, t of  #{ i : |e_i,x| <= b, |e_i,y| <= b },               (1)
//   e_i = q_i - R_z(yaw) p_i - t.
//
// Branch and bound over the yaw. While the yaw is within w of a center, the
// translation of match i is within b + 2 |p_i| sin(w / 2) of that at the
// center, on each axis. So the largest number of squares of that size that
// share a point bounds (1) on the interval. It is found by a sweep in
// O(N log N). At the center, with squares of size b, it is (1) itself.
//
// Heights do not count. This is an oracle for
// robust/estimators/consensus_search.h, which is a hundred times faster.

#ifndef QUATRO_ROBUST_ESTIMATORS_MAX_CONSENSUS_H_
#define QUATRO_ROBUST_ESTIMATORS_MAX_CONSENSUS_H_

#include <Eigen/Core>
#include <string>

#include "features/base/types.h"

namespace quatro {

// How far the search goes.
struct MaxConsensusOptions {
  double noise_bound = 0.3;  // b [m]

  // Narrower intervals of the yaw are not divided [rad].
  double min_width = 1e-5;

  int max_num_intervals = 100'000;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// A maximum of (1), and how certain it is one.
struct MaxConsensus {
  double yaw = 0.0;                                       // [rad]
  Eigen::Vector2d translation = Eigen::Vector2d::Zero();  // [m]
  Eigen::Index num_inliers = 0;                           // (1) there.
  Eigen::Index upper_bound = 0;                           // On (1) anywhere.
  int num_intervals = 0;                                  // That were bounded.

  // No other pose has more inliers.
  bool IsOptimal() const { return upper_bound == num_inliers; }
};

// Column i of `source` is matched with column i of `target` [m]; all finite.
// Without matches there are no inliers.
MaxConsensus FindMaxConsensus(const PointsRef& source,
                              const PointsRef& target,
                              const MaxConsensusOptions& options);

}  // namespace quatro

#endif  // QUATRO_ROBUST_ESTIMATORS_MAX_CONSENSUS_H_
