// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Yaw and translation from weighted point pairs, in closed form.
//
// Given points p_i, q_i and weights w_i >= 0, finds
//
//   yaw, t = argmin  sum_i w_i || q_i - R_z(yaw) p_i - t ||^2.              (1)
//
// For any yaw, the best t is mean(q) - R_z(yaw) mean(p) with weighted means.
// The yaw is that of EstimateYaw() for the points relative to their means.

#ifndef QUATRO_SOLVERS_CLOSED_FORM_YAW_TRANSLATION_H_
#define QUATRO_SOLVERS_CLOSED_FORM_YAW_TRANSLATION_H_

#include <Eigen/Core>
#include <optional>

#include "features/base/rigid3.h"
#include "features/base/types.h"

namespace quatro {

// The minimum of (1) and its curvature.
struct YawTranslationEstimate {
  Rigid3 target_from_source;
  double yaw = 0.0;  // [rad], in [-pi, pi]; the rotation is RotationZ(yaw).

  // Value of (1) at the minimum [m^2].
  double cost = 0.0;

  // Second derivative of (1) for a rotation by a [rad] about the vertical
  // through the centroid c of the source and a translation by tau [m],
  //   x -> R_z(yaw + a) (x - c) + R_z(yaw) c + t + tau,    in order (a, tau).
  // It is diagonal.
  Eigen::Matrix4d curvature = Eigen::Matrix4d::Zero();
};

// `source` and `target` hold the points column by column [m]. Their sizes and
// that of `weights` must be equal. Returns nullopt if the points do not
// determine the yaw: for example, fewer than two have weight, those with weight
// are on one vertical line in one of the clouds, or one is NaN.
std::optional<YawTranslationEstimate> EstimateYawTranslation(
    const PointsRef& source,
    const PointsRef& target,
    const WeightsRef& weights);

}  // namespace quatro

#endif  // QUATRO_SOLVERS_CLOSED_FORM_YAW_TRANSLATION_H_
