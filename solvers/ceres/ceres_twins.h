// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Every closed form once more, solved by Ceres on the right manifold: oracles
// for tests and for cross-checks of a run. They share no formula with what they
// check but the problem,
//
//   R, t = argmin  sum_i w_i || q_i - R p_i - t ||^2,                       (1)
//
//   SolveYawByCeres            S^1, t = 0, planar   EstimateYaw()
//   SolveRotationByCeres       SO(3), t = 0         EstimateRotation()
//   SolveYawTranslationByCeres S^1 x R^3            EstimateYawTranslation()
//   SolvePoseByCeres           SO(3) x R^3          EstimateRigid()
//
// R is a point on the unit circle or a unit quaternion, t free; `estimate` has
// the fields, units and conventions of the closed form's.
//
// Starts. Besides its minimum, (1) is flat at a half turn from it (yaw) or at
// three (rotation: two saddles, one maximum), where a descent can be stuck. So
// it is made from `initial_...` and from that turned by 90 deg (yaw) or by 180
// deg about x, y and z (rotation), and the least cost counts. One of the starts
// is always within 135 or 120 deg of the minimum.
//
// Precision. Ceres takes steps that lower the cost, so it stops where the cost
// has no more digits, at sqrt(1e-16) of the argument. From there Newton steps
// on the gradient, for as long as they lower it, go on to the last digits.
//
// Curvature. All of the second derivative, 2 sum_k (J_k^T J_k + r_k r_k''), in
// the tangent space at the estimate, of the same residuals by jets of jets.
// (The first part alone is Ceres' Gauss-Newton one, which at a poor fit is too
// high.)

#ifndef QUATRO_SOLVERS_CERES_CERES_TWINS_H_
#define QUATRO_SOLVERS_CERES_CERES_TWINS_H_

#include <Eigen/Core>
#include <string>

#include "features/base/rigid3.h"
#include "features/base/types.h"
#include "solvers/closed_form/rotation.h"
#include "solvers/closed_form/yaw.h"
#include "solvers/closed_form/yaw_translation.h"

namespace quatro {

// What Ceres makes of a closed form's problem.
template <typename Estimate>
struct CeresTwin {
  // False if Ceres failed, no pair has weight, or a number of one that has is
  // not finite: then `estimate` means nothing. Pairs that do not determine the
  // answer are usable: one of the minima, and a curvature that is singular.
  bool is_usable = false;
  Estimate estimate;
  std::string message = "not solved";  // Ceres' reason to stop.
};

// Who takes the derivative of the yaw's residual.
enum class YawDerivative { kAutomatic, kAnalytic };

// Sizes as for the closed forms. Weights are >= 0.
CeresTwin<YawEstimate> SolveYawByCeres(
    const PointsRef& source,
    const PointsRef& target,
    const WeightsRef& weights,
    double initial_target_from_source = 0.0,
    YawDerivative derivative = YawDerivative::kAutomatic);

// Of equation (1) of solvers/closed_form/rotation.h, from the given start.
CeresTwin<RotationEstimate> SolveRotationByCeres(
    const PointsRef& source,
    const PointsRef& target,
    const WeightsRef& weights,
    const Eigen::Matrix3d& initial_target_from_source =
        Eigen::Matrix3d::Identity());

// Of the initial rotation only the yaw counts.
CeresTwin<YawTranslationEstimate> SolveYawTranslationByCeres(
    const PointsRef& source,
    const PointsRef& target,
    const WeightsRef& weights,
    const Rigid3& initial_target_from_source = {});

// Of equation (5) of solvers/closed_form/rotation.h, from the given start.
CeresTwin<RigidEstimate> SolvePoseByCeres(
    const PointsRef& source,
    const PointsRef& target,
    const WeightsRef& weights,
    const Rigid3& initial_target_from_source = {});

}  // namespace quatro

#endif  // QUATRO_SOLVERS_CERES_CERES_TWINS_H_
