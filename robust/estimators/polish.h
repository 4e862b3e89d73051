// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The polish: refines a yaw-only pose to a full pose. Roll and pitch of real
// scans differ by a degree or two, which a yaw-only pose cannot represent.
//
// Candidates are refined in SE(3) on their inliers,
//
//   min_{R, t}  sum_{i in I} |q_i - R p_i - t|^2,
//   I = { i : |q_i - R p_i - t| <= b },                                    (1)
//
// by alternating I and the closed form, while b shrinks to the noise bound, a
// radius. The first candidate starts from the yaw-only pose. The second starts
// from a rotation in SO(3) by graduated non-convexity on the consistent set,
// which reaches tilts that the first cannot. A candidate is acceptable if
//
//   - its truncated cost (robust/estimators/consensus.h) is below that of the
//     yaw-only pose;
//   - its rotation differs from the yaw-only one by at most max_tilt;
//   - its inliers constrain the rotation: the standard deviation about the
//     least certain axis, s / sqrt(smallest eigenvalue of H / 2), is at most
//     max_rotation_std. H is the curvature of (1) over rotations, and s the
//     standard deviation of the residuals, but at least a tenth of the bound.
//
// The acceptable candidate with the lowest cost replaces the yaw-only pose. If
// there is none, the yaw-only pose is kept.

#ifndef QUATRO_ROBUST_ESTIMATORS_POLISH_H_
#define QUATRO_ROBUST_ESTIMATORS_POLISH_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "features/base/rigid3.h"
#include "features/base/types.h"

namespace quatro {

// When a pose in SE(3) is accepted.
struct PolishOptions {
  double noise_bound = 0.3;  // b, a radius [m].

  // The polished pose is rejected if its rotation differs from the yaw-only one
  // by more than max_tilt [rad], or if the standard deviation about its least
  // certain axis exceeds max_rotation_std [rad].
  double max_tilt = 0.3;
  double max_rotation_std = 0.01;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// The polished pose, or the input pose if no better one was accepted.
struct PolishSummary {
  Rigid3 target_from_source;
  bool is_polished = false;

  // About the least certain axis of the polished pose [rad]; 0 if not polished.
  double rotation_std = 0.0;

  std::string message;  // Why it was not polished, or "polished".
};

// Column i of `source` is matched with column i of `target` [m]. `consistent`
// are the columns that pruning kept.
PolishSummary Polish(const PointsRef& source,
                     const PointsRef& target,
                     const std::vector<Eigen::Index>& consistent,
                     const Rigid3& target_from_source,
                     const PolishOptions& options);

}  // namespace quatro

#endif  // QUATRO_ROBUST_ESTIMATORS_POLISH_H_
