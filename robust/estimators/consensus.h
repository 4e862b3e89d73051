// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// How well a pose explains matched points: truncated least squares in space,
//
//   f(R, t) = sum_i min( |q_i - R p_i - t|^2 / b^2, 1 ).                   (1)
//
// It has no favourite axes, unlike the translation axis by axis: poses in SE(3)
// are chosen by it.

#ifndef QUATRO_ROBUST_ESTIMATORS_CONSENSUS_H_
#define QUATRO_ROBUST_ESTIMATORS_CONSENSUS_H_

#include <Eigen/Core>
#include <vector>

#include "features/base/rigid3.h"
#include "features/base/types.h"

namespace quatro {

// (1) for `noise_bound` b [m].
double ConsensusCost(const PointsRef& source,
                     const PointsRef& target,
                     const Rigid3& target_from_source,
                     double noise_bound);

// The columns that (1) does not truncate, in ascending order.
std::vector<Eigen::Index> FindWithinBall(const PointsRef& source,
                                         const PointsRef& target,
                                         const Rigid3& target_from_source,
                                         double noise_bound);

// The columns with |q_i - R p_i - t| <= b on each axis, in ascending order.
std::vector<Eigen::Index> FindInliers(const PointsRef& source,
                                      const PointsRef& target,
                                      const Rigid3& target_from_source,
                                      double noise_bound);

}  // namespace quatro

#endif  // QUATRO_ROBUST_ESTIMATORS_CONSENSUS_H_
