// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// SO(2) for Ceres, stored as the unit vector (cos a, sin a).

#ifndef QUATRO_SOLVERS_CERES_MANIFOLDS_H_
#define QUATRO_SOLVERS_CERES_MANIFOLDS_H_

#include <ceres/autodiff_manifold.h>

namespace quatro {

// Plus rotates x by the angle delta [rad]. Minus is the signed angle from x to
// y. Both are smooth where a crosses pi, where an angle parameter would jump.
struct UnitCircle {
  template <typename T>
  bool Plus(const T* x, const T* delta, T* x_plus_delta) const {
    const T c = cos(delta[0]);
    const T s = sin(delta[0]);
    x_plus_delta[0] = c * x[0] - s * x[1];
    x_plus_delta[1] = s * x[0] + c * x[1];
    return true;
  }

  template <typename T>
  bool Minus(const T* y, const T* x, T* y_minus_x) const {
    y_minus_x[0] = atan2(x[0] * y[1] - x[1] * y[0], x[0] * y[0] + x[1] * y[1]);
    return true;
  }
};

// The manifold in Ceres' interface.
using UnitCircleManifold = ceres::AutoDiffManifold<UnitCircle, 2, 1>;

}  // namespace quatro

#endif  // QUATRO_SOLVERS_CERES_MANIFOLDS_H_
