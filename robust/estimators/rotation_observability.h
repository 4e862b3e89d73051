// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Whether matched points constrain the rotation of a rigid motion. If they are
// on a line up to the noise bound b, a rotation by one radian about that line
// moves them by at most b, measured by the root of the sum of squared
// distances.

#ifndef QUATRO_ROBUST_ESTIMATORS_ROTATION_OBSERVABILITY_H_
#define QUATRO_ROBUST_ESTIMATORS_ROTATION_OBSERVABILITY_H_

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include "solvers/closed_form/rotation.h"

namespace quatro {

// The sum of squared distances by which a rotation of one radian about the
// least observable axis moves the points, to second order [m^2].
inline double LeastTurn(const RigidEstimate& rigid) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(
      rigid.curvature.topLeftCorner<3, 3>(), Eigen::EigenvaluesOnly);
  return 0.5 * eigen.eigenvalues()[0];
}

// Whether the rotation about every axis is observable above the noise.
inline bool IsRotationObservable(const RigidEstimate& rigid,
                                 double noise_bound) {
  return LeastTurn(rigid) > noise_bound * noise_bound;
}

}  // namespace quatro

#endif  // QUATRO_ROBUST_ESTIMATORS_ROTATION_OBSERVABILITY_H_
