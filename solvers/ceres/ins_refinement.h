// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The pose from matched points and an INS's measurement of the vertical:
//
//   R, t = argmin  sum_i |q_i - R p_i - t|^2 / noise_sigma^2
//                  + |R u - v|^2 / angle_std^2,                             (1)
//
// where u and v are the unit vectors that point up in the source and in the
// target. For small angles, |R u - v| is the angle between the two verticals.
// The prior does not constrain the rotation about the vertical, so only the
// matches constrain the yaw.
//
// Swapping source and target as well as u and v gives the inverse.

#ifndef QUATRO_SOLVERS_CERES_INS_REFINEMENT_H_
#define QUATRO_SOLVERS_CERES_INS_REFINEMENT_H_

#include <Eigen/Core>
#include <optional>

#include "features/base/rigid3.h"
#include "features/base/types.h"

namespace quatro {

// The up direction in each cloud, and its uncertainty.
struct VerticalPrior {
  Eigen::Vector3d up_in_source = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d up_in_target = Eigen::Vector3d::UnitZ();
  double angle_std = 0.01;  // About each level axis [rad], > 0.

  // The second term of (1).
  double Cost(const Eigen::Matrix3d& target_from_source) const;
};

// The minimum of (1).
struct InsRefinement {
  Rigid3 target_from_source;
  double cost = 0.0;  // Value of (1) at the minimum.
};

// A local minimum of (1), found by Ceres from `initial_target_from_source`.
// Column i of `source` is matched with column i of `target` [m]. `noise_sigma`
// > 0 is the standard deviation of a match on each axis [m]. Returns nullopt if
// matches and prior together do not constrain the rotation (fewer than two
// matches, or all on one vertical line), if anything is not finite, or if Ceres
// fails.
std::optional<InsRefinement> RefineWithIns(
    const PointsRef& source,
    const PointsRef& target,
    double noise_sigma,
    const Rigid3& initial_target_from_source,
    const VerticalPrior& prior);

}  // namespace quatro

#endif  // QUATRO_SOLVERS_CERES_INS_REFINEMENT_H_
