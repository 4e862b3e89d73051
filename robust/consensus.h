// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// How well a pose explains matched points: truncated least squares in space,
//
//   f(R, t) = sum_i min( |q_i - R p_i - t|^2 / (3 b^2), 1 ).               (1)
//
// The ball of radius sqrt(3) b holds the box of +-b on each axis that the
// axis-wise translation works with.

#ifndef QUATRO_ROBUST_CONSENSUS_H_
#define QUATRO_ROBUST_CONSENSUS_H_

#include <Eigen/Core>
#include <vector>

#include "features/types.h"
#include "solvers/rigid3.h"

namespace quatro {

// (1) for `noise_bound` b [m].
double ConsensusCost(const PointsRef& source,
                     const PointsRef& target,
                     const Rigid3& target_from_source,
                     double noise_bound);

// The columns with |q_i - R p_i - t| <= b on each axis, in ascending order.
std::vector<Eigen::Index> FindAgreeing(const PointsRef& source,
                                       const PointsRef& target,
                                       const Rigid3& target_from_source,
                                       double noise_bound);

}  // namespace quatro

#endif  // QUATRO_ROBUST_CONSENSUS_H_
