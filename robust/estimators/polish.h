// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// From the heading to the full pose: roll and pitch of real scans differ by a
// degree or two, which a yaw-only answer keeps as its error.
//
// Candidates are refined in SE(3) on the matches that agree with them,
//
//   min_{R, t}  sum_{i in I} |q_i - R p_i - t|^2,
//   I = { i : |q_i - R p_i - t| <= b },                                    (1)
//
// alternating I and the closed form, with b narrowing to the noise bound. One
// starts from the yaw-only answer; a second from SO(3) by graduated
// non-convexity on the consistent set, which reaches tilts that the first
// can't. The one with the least truncated cost (robust/estimators/consensus.h)
// is kept if it is better than the yaw-only answer and the matches hold it:
// with H the curvature of (1) over rotations and s the residuals' standard
// deviation, no axis may be less certain than max_rotation_std,  s /
// sqrt(smallest eigenvalue of H / 2). Otherwise the yaw-only answer stands.

#ifndef QUATRO_ROBUST_ESTIMATORS_POLISH_H_
#define QUATRO_ROBUST_ESTIMATORS_POLISH_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "features/base/rigid3.h"
#include "features/base/types.h"

namespace quatro {

// When a pose in SE(3) is believed.
struct PolishOptions {
  double noise_bound = 0.3;  // b [m]

  // The polished pose is refused if it is turned farther from the yaw-only one
  // [rad], or less certain than this [rad].
  double max_tilt = 0.3;
  double max_rotation_std = 0.01;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// The pose, polished or as it was given.
struct PolishSummary {
  Rigid3 target_from_source;  // The pose given if nothing better is held.
  bool is_polished = false;
  double rotation_std =
      0.0;              // Of the polished pose's least certain axis [rad].
  std::string message;  // Why it was not, or "polished".
};

// `consistent` are the columns that pruning kept.
PolishSummary Polish(const PointsRef& source,
                     const PointsRef& target,
                     const std::vector<Eigen::Index>& consistent,
                     const Rigid3& target_from_source,
                     const PolishOptions& options);

}  // namespace quatro

#endif  // QUATRO_ROBUST_ESTIMATORS_POLISH_H_
