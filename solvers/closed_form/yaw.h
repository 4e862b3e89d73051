// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Yaw from weighted point pairs, in closed form.
//
// Given pairs (s_i, t_i) and weights w_i >= 0, finds the angle
//
//   yaw = argmin_a  sum_i w_i || xy(t_i) - R(a) xy(s_i) ||^2,             (1)
//
// where R(a) is the counter-clockwise rotation by a, and xy() the first two
// rows. Expanding (1) gives a single sinusoid in a. So the minimum is global
// and takes one pass over the pairs:
//
//   yaw = atan2(S, C),   S = sum_i w_i (s_i x t_i)_z,
//                        C = sum_i w_i <xy(s_i), xy(t_i)>.                (2)
//
// This is the rotation step of Quatro (Lim et al., ICRA 2022): gravity is
// known, so roll and pitch are not estimated. There, each pair is a difference
// of two points, which makes (1) independent of the translation.

#ifndef QUATRO_SOLVERS_CLOSED_FORM_YAW_H_
#define QUATRO_SOLVERS_CLOSED_FORM_YAW_H_

#include <optional>

#include "features/base/types.h"

namespace quatro {

// The minimum of (1) and its curvature.
struct YawEstimate {
  // Rotates a direction from the source frame into the target frame. [rad], in
  // [-pi, pi].
  double target_from_source = 0.0;

  // Value of (1) at the minimum [m^2].
  double cost = 0.0;

  // Second derivative of (1) at the minimum [m^2/rad^2]: how strongly the pairs
  // constrain the yaw. With inverse variances [1/m^2] as weights, 2 / curvature
  // is the variance of the yaw [rad^2].
  double curvature = 0.0;
};

// `source` and `target` hold the s_i and t_i column by column [m]. Their sizes
// and that of `weights` must be equal. Returns nullopt if the pairs do not
// determine a yaw, because the sinusoid is flat: for example, there are no
// pairs, all weights are zero, or all pairs are on the z axis. Also returns
// nullopt if a weight, x or y is NaN.
std::optional<YawEstimate> EstimateYaw(const PointsRef& source,
                                       const PointsRef& target,
                                       const WeightsRef& weights);

}  // namespace quatro

#endif  // QUATRO_SOLVERS_CLOSED_FORM_YAW_H_
