// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The rotation of a vehicle on the ground as a subproblem of robust/gnc/gnc.h:
// yaw only, from planar residuals,
//
//   r_k(yaw)^2 = | xy(beta_k) - R(yaw) xy(alpha_k) |^2 / noise_bound^2,
//
// so errors in z have no effect. noise_bound is a radius in the plane. Equation
// (6) of the Quatro paper.

#ifndef QUATRO_ROBUST_GNC_QUASI_SO3_H_
#define QUATRO_ROBUST_GNC_QUASI_SO3_H_

#include <Eigen/Core>
#include <cmath>
#include <optional>

#include "features/base/types.h"
#include "solvers/closed_form/yaw.h"

namespace quatro {

// Yaw from differences of points (TIMs).
struct QuasiSo3 {
  using Estimate = YawEstimate;

  Points source;             // alpha_k [m]
  Points target;             // beta_k [m]
  double noise_bound = 1.0;  // Radius, for differences [m].

  Eigen::Index NumMeasurements() const { return source.cols(); }

  Estimate Identity() const { return {}; }

  std::optional<Estimate> Solve(const WeightsRef& weights) const {
    return EstimateYaw(source, target, weights);
  }

  Eigen::VectorXd SquaredResiduals(const Estimate& yaw) const {
    const double c = std::cos(yaw.target_from_source);
    const double s = std::sin(yaw.target_from_source);
    const auto x = target.row(0) - (c * source.row(0) - s * source.row(1));
    const auto y = target.row(1) - (s * source.row(0) + c * source.row(1));
    return ((x.array().square() + y.array().square()) /
            (noise_bound * noise_bound))
        .matrix()
        .transpose();
  }
};

}  // namespace quatro

#endif  // QUATRO_ROBUST_GNC_QUASI_SO3_H_
