// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Solves the problem of every weighted least-squares closed form by Ceres on
// the appropriate manifold, as an oracle for tests and for cross-checks within
// a run. The twins share no formula with the closed forms, only the problem,
//
//   R, t = argmin  sum_i w_i || q_i - R p_i - t ||^2,                       (1)
//
//   SolveYawByCeres            S^1, t = 0, planar   EstimateYaw()
//   SolveRotationByCeres       SO(3), t = 0         EstimateRotation()
//   SolveYawTranslationByCeres S^1 x R^3            EstimateYawTranslation()
//   SolvePoseByCeres           SO(3) x R^3          EstimateRigid()
//
// R is a point on the unit circle or a unit quaternion, and t is free.
// `estimate` has the fields, units and conventions of the closed form's result.
//
// Starts. Apart from its minimum, (1) is stationary half a rotation away from
// it (yaw) or at three other rotations (two saddles and a maximum), where a
// descent can get stuck. So the descent starts at `initial_...`, and at that
// rotated by 90 deg (yaw) or by 180 deg about x, y and z (rotation). The result
// with the least cost is taken. One of the starts is always within 135 deg
// (yaw) or 120 deg (rotation) of the minimum.
//
// Precision. Ceres accepts only steps that lower the cost. So it stops when the
// digits of the cost are exhausted, at a relative error of sqrt(1e-16) in the
// argument. From there, up to five Newton steps on the gradient, taken as long
// as they reduce it, reach the last digits.
//
// Curvature. This is the full second derivative, 2 sum_k (J_k^T J_k + r_k
// r_k''), in the tangent space at the estimate, from the same residuals by jets
// of jets. The first term alone is the Gauss-Newton approximation of Ceres,
// which is too large if the fit is poor.

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

// The solution of a closed form's problem by Ceres.
template <typename Estimate>
struct CeresTwin {
  // False if Ceres failed, if no pair has weight, or if a weight or a pair with
  // weight is not finite; then `estimate` is meaningless. Pairs that do not
  // determine the solution are usable: the estimate is one of the minima, and
  // its curvature is singular.
  bool is_usable = false;
  Estimate estimate;
  std::string message = "not solved";  // Why Ceres stopped.
};

// Solves (1) of solvers/closed_form/yaw.h from the given start [rad]. Here and
// below, sizes are those of the closed forms, and weights are >= 0.
CeresTwin<YawEstimate> SolveYawByCeres(const PointsRef& source,
                                       const PointsRef& target,
                                       const WeightsRef& weights,
                                       double initial_target_from_source = 0.0);

// Solves (1) of solvers/closed_form/rotation.h from the given start.
CeresTwin<RotationEstimate> SolveRotationByCeres(
    const PointsRef& source,
    const PointsRef& target,
    const WeightsRef& weights,
    const Eigen::Matrix3d& initial_target_from_source =
        Eigen::Matrix3d::Identity());

// Solves (1) of solvers/closed_form/yaw_translation.h from the given start, of
// whose rotation only the yaw is used.
CeresTwin<YawTranslationEstimate> SolveYawTranslationByCeres(
    const PointsRef& source,
    const PointsRef& target,
    const WeightsRef& weights,
    const Rigid3& initial_target_from_source = {});

// Solves (4) of solvers/closed_form/rotation.h from the given start.
CeresTwin<RigidEstimate> SolvePoseByCeres(
    const PointsRef& source,
    const PointsRef& target,
    const WeightsRef& weights,
    const Rigid3& initial_target_from_source = {});

}  // namespace quatro

#endif  // QUATRO_SOLVERS_CERES_CERES_TWINS_H_
