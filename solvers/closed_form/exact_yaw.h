// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Yaw from pairs with outliers, exactly: the global minimum of truncated least
// squares,
//
//   f(theta) = sum_k w_k min( r_k(theta)^2 / c_k^2, 1 ),
//   r_k(theta)^2 = a^2 + b^2 - 2 a b cos(theta - phi),                     (1)
//
// where a = |xy(alpha_k)|, b = |xy(beta_k)|, xy() is the first two coordinates,
// and phi is the angle from alpha_k to beta_k. This is equation (3) of the
// Quatro paper. Graduated non-convexity only approximates its minimum, and
// seldom finds it if 99 % are outliers; this solver always does.
//
// The inequality r_k <= c_k holds on an arc about phi of half-width
//
//   acos( (a^2 + b^2 - c^2) / (2 a b) ),                                   (2)
//
// which is empty if the ratio is above 1 and the full circle if it is below -1.
// Between two consecutive ends of arcs the set of inliers is constant, and (1)
// is a single sinusoid with a closed-form minimum. The least of these minima is
// the minimum of (1), because the sinusoid of any set is >= f everywhere, and
// equal to f where that set is the set of inliers. The cost is one sort of the
// 2K ends and one sweep, O(K log K).

#ifndef QUATRO_SOLVERS_CLOSED_FORM_EXACT_YAW_H_
#define QUATRO_SOLVERS_CLOSED_FORM_EXACT_YAW_H_

#include <Eigen/Core>
#include <optional>

#include "features/base/types.h"

namespace quatro {

// The global minimum of f and its inliers.
struct ExactYawEstimate {
  double target_from_source = 0.0;  // [rad], in [-pi, pi].
  double cost = 0.0;                // f at the minimum, in [0, sum of weights].
  Eigen::Array<bool, Eigen::Dynamic, 1> is_inlier;  // r_k <= c_k.
  Eigen::Index num_inliers = 0;
};

// Column k of `source` is alpha_k, and column k of `target` is beta_k [m].
// `noise_bounds` holds the c_k > 0 [m], which are radii in the xy plane. All
// sizes must be equal. Returns nullopt if anything is not finite, or if no
// measurement that depends on the yaw is an inlier at any yaw: there are none,
// they have no weight, all are vertical, or no pair has consistent lengths. If
// minima are equal, returns the first one counter-clockwise from -pi.
std::optional<ExactYawEstimate> EstimateExactYaw(
    const PointsRef& source,
    const PointsRef& target,
    const WeightsRef& weights,
    const WeightsRef& noise_bounds);

// f at a given yaw [rad].
double TruncatedYawCost(const PointsRef& source,
                        const PointsRef& target,
                        const WeightsRef& weights,
                        const WeightsRef& noise_bounds,
                        double yaw);

}  // namespace quatro

#endif  // QUATRO_SOLVERS_CLOSED_FORM_EXACT_YAW_H_
