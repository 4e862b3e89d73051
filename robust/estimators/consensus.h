// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// How well a pose fits matched points: the truncated squared error,
//
//   f(R, t) = sum_i min( |q_i - R p_i - t|^2 / b^2, 1 ).                   (1)
//
// The cost does not depend on the axes of the frame, unlike the inliers of a
// translation that is estimated axis by axis. So it compares poses in SE(3).

#ifndef QUATRO_ROBUST_ESTIMATORS_CONSENSUS_H_
#define QUATRO_ROBUST_ESTIMATORS_CONSENSUS_H_

#include <Eigen/Core>
#include <vector>

#include "features/base/rigid3.h"
#include "features/base/types.h"

namespace quatro {

// Equation (1) for `noise_bound` b, a radius [m].
double ConsensusCost(const PointsRef& source,
                     const PointsRef& target,
                     const Rigid3& target_from_source,
                     double noise_bound);

// The columns with |q_i - R p_i - t| <= b, which (1) does not truncate, in
// ascending order. `noise_bound` b is a radius [m].
std::vector<Eigen::Index> FindWithinBall(const PointsRef& source,
                                         const PointsRef& target,
                                         const Rigid3& target_from_source,
                                         double noise_bound);

// The columns with |q_i - R p_i - t| <= b on each axis of the target frame, in
// ascending order. `noise_bound` b is half the edge of a box [m].
std::vector<Eigen::Index> FindInliers(const PointsRef& source,
                                      const PointsRef& target,
                                      const Rigid3& target_from_source,
                                      double noise_bound);

}  // namespace quatro

#endif  // QUATRO_ROBUST_ESTIMATORS_CONSENSUS_H_
