// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The residual of a weighted pair, for Ceres,
//
//   r = sqrt(w) (q - R p - t),     its squared norm w || q - R p - t ||^2,  (1)
//
// where R is stored as the numbers of a group, TurnAboutZ or Turn. A group
// defines how to rotate a point, Rotate(), and how its numbers change under R
// -> exp([delta]x) R, to second order in delta, Perturb().

#ifndef QUATRO_SOLVERS_CERES_CERES_RESIDUALS_H_
#define QUATRO_SOLVERS_CERES_CERES_RESIDUALS_H_

#include <ceres/autodiff_cost_function.h>
#include <ceres/manifold.h>
#include <ceres/sized_cost_function.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "solvers/ceres/manifolds.h"
#include "solvers/ceres/second_derivative.h"

namespace quatro {

// R_z(a), stored as (cos a, sin a).
struct TurnAboutZ {
  static constexpr int kSize = 2;
  static constexpr int kFreedoms = 1;
  using Manifold = UnitCircleManifold;

  template <typename T>
  static Eigen::Vector3<T> Rotate(const T* r, const Eigen::Vector3<T>& p) {
    return {r[0] * p.x() - r[1] * p.y(), r[1] * p.x() + r[0] * p.y(), p.z()};
  }

  template <typename T>
  static void Perturb(const T* r, const T* delta, T* perturbed) {
    UnitCircle().Plus(r, delta, perturbed);
  }
};

// Any rotation, stored as a unit quaternion in Eigen's order (x, y, z, w).
struct Turn {
  static constexpr int kSize = 4;
  static constexpr int kFreedoms = 3;
  using Manifold = ceres::EigenQuaternionManifold;

  template <typename T>
  static Eigen::Vector3<T> Rotate(const T* r, const Eigen::Vector3<T>& p) {
    return Eigen::Map<const Eigen::Quaternion<T>>(r) * p;
  }

  // The quaternion of exp([delta]x), (sin(|delta| / 2) delta / |delta|,
  // cos(|delta| / 2)), to second order, in a form that jets can evaluate at
  // zero.
  template <typename T>
  static void Perturb(const T* r, const T* delta, T* perturbed) {
    const T x = delta[0] * Constant<T>(0.5);
    const T y = delta[1] * Constant<T>(0.5);
    const T z = delta[2] * Constant<T>(0.5);
    const T w = Constant<T>(1.0) - (x * x + y * y + z * z) * Constant<T>(0.5);
    const Eigen::Quaternion<T> exp(w, x, y, z);
    Eigen::Map<Eigen::Quaternion<T>> product(perturbed);
    product = exp * Eigen::Map<const Eigen::Quaternion<T>>(r);
  }
};

// Equation (1), to be differentiated by Ceres or ComputeSecondDerivative().
template <typename Group>
struct PairResidual {
  using CostFunction =
      ceres::AutoDiffCostFunction<PairResidual, 3, Group::kSize, 3>;

  template <typename T>
  bool operator()(const T* r, const T* t, T* residual) const {
    const Eigen::Vector3<T> p(Constant<T>(source.x()),
                              Constant<T>(source.y()),
                              Constant<T>(source.z()));
    const Eigen::Vector3<T> rotated = Group::Rotate(r, p);
    for (int i = 0; i < 3; ++i) {
      residual[i] = Constant<T>(sqrt_weight) *
                    (Constant<T>(target[i]) - rotated[i] - t[i]);
    }
    return true;
  }

  Eigen::Vector3d source;
  Eigen::Vector3d target;
  double sqrt_weight = 1.0;
};

}  // namespace quatro

#endif  // QUATRO_SOLVERS_CERES_CERES_RESIDUALS_H_
