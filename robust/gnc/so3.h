// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The full rotation as a subproblem of robust/gnc/gnc.h, for unknown roll and
// pitch:
//
//   r_k(R)^2 = | beta_k - R alpha_k |^2 / noise_bound^2.
//
// noise_bound is a radius. The rotation needs two differences that are not
// parallel, and therefore three matches.

#ifndef QUATRO_ROBUST_GNC_SO3_H_
#define QUATRO_ROBUST_GNC_SO3_H_

#include <Eigen/Core>
#include <optional>

#include "features/base/types.h"
#include "solvers/closed_form/rotation.h"

namespace quatro {

// Rotation from differences of points (TIMs).
struct So3 {
  using Estimate = RotationEstimate;

  Points source;             // alpha_k [m]
  Points target;             // beta_k [m]
  double noise_bound = 1.0;  // Radius, for differences [m].

  Eigen::Index NumMeasurements() const { return source.cols(); }

  Estimate Identity() const {
    Estimate identity;
    identity.target_from_source.setIdentity();
    return identity;
  }

  std::optional<Estimate> Solve(const WeightsRef& weights) const {
    return EstimateRotation(source, target, weights);
  }

  Eigen::VectorXd SquaredResiduals(const Estimate& rotation) const {
    return (target - rotation.target_from_source * source)
               .colwise()
               .squaredNorm()
               .transpose() /
           (noise_bound * noise_bound);
  }
};

}  // namespace quatro

#endif  // QUATRO_ROBUST_GNC_SO3_H_
