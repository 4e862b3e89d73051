// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Whether matched points p_i with mean c constrain the rotation of a rigid
// motion,
//
//   min_{|w| = 1}  sum_i |w x (p_i - c)|^2  >  b^2,                         (1)
//
// with the noise bound b. The left side is the sum of squared distances by
// which a rotation of one radian about the least observable axis moves the
// points, to first order. (1) is violated by points on a line up to the noise
// bound.

#ifndef QUATRO_ROBUST_ESTIMATORS_ROTATION_OBSERVABILITY_H_
#define QUATRO_ROBUST_ESTIMATORS_ROTATION_OBSERVABILITY_H_

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include "solvers/closed_form/rotation.h"

namespace quatro {

// The left side of (1) [m^2], by the curvature of the fit. It is exact for
// matches without noise.
inline double LeastTurn(const RigidEstimate& rigid) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(
      rigid.curvature.topLeftCorner<3, 3>(), Eigen::EigenvaluesOnly);
  return 0.5 * eigen.eigenvalues()[0];
}

// Whether (1) holds.
inline bool IsRotationObservable(const RigidEstimate& rigid,
                                 double noise_bound) {
  return LeastTurn(rigid) > noise_bound * noise_bound;
}

}  // namespace quatro

#endif  // QUATRO_ROBUST_ESTIMATORS_ROTATION_OBSERVABILITY_H_
