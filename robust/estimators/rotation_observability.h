// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Whether matched points hold the rotation of a rigid motion: if they are on a
// line up to the noise bound b, a turn about it by a radian moves them, in the
// root of their sum of squares, by no more than b.

#ifndef QUATRO_ROBUST_ESTIMATORS_ROTATION_OBSERVABILITY_H_
#define QUATRO_ROBUST_ESTIMATORS_ROTATION_OBSERVABILITY_H_

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include "solvers/closed_form/rotation.h"

namespace quatro {

// The sum of squared distances [m^2] by which a turn of a radian about the
// worst axis moves the points, to second order.
inline double LeastTurn(const RigidEstimate& rigid) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(
      rigid.curvature.topLeftCorner<3, 3>(), Eigen::EigenvaluesOnly);
  return 0.5 * eigen.eigenvalues()[0];
}

// Whether even the least turn shows above the noise.
inline bool HoldsRotation(const RigidEstimate& rigid, double noise_bound) {
  return LeastTurn(rigid) > noise_bound * noise_bound;
}

}  // namespace quatro

#endif  // QUATRO_ROBUST_ESTIMATORS_ROTATION_OBSERVABILITY_H_
