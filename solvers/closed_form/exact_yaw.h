// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The yaw with outliers, exactly: the global minimum of truncated least
// squares,
//
//   f(theta) = sum_k w_k min( r_k(theta)^2 / c_k^2, 1 ),
//   r_k(theta)^2 = a^2 + b^2 - 2 a b cos(theta - phi),                     (1)
//
// a = |xy(alpha_k)|, b = |xy(beta_k)|, phi the angle from alpha_k to beta_k.
// Equation (3) of the Quatro paper, which graduated non-convexity only
// approximates: with 99 % outliers it seldom finds the minimum, this always.
//
// r_k <= c_k on an arc about phi of half-width
//
//   acos( (a^2 + b^2 - c^2) / (2 a b) ),                                   (2)
//
// none of the circle if the ratio is above 1, all of it if below -1. Between
// two ends of arcs the same measurements are inliers and (1) is one sinusoid,
// whose minimum is closed form. The least over all of them is the minimum of
// (1): a set's sinusoid lies on or above f everywhere, and on it where the set
// holds. One sort of the 2K ends and one sweep, O(K log K).

#ifndef QUATRO_SOLVERS_CLOSED_FORM_EXACT_YAW_H_
#define QUATRO_SOLVERS_CLOSED_FORM_EXACT_YAW_H_

#include <Eigen/Core>
#include <optional>

#include "features/base/types.h"

namespace quatro {

// The global optimum, and who agrees with it.
struct ExactYawEstimate {
  double target_from_source = 0.0;  // [rad], in [-pi, pi].
  double cost = 0.0;                // f there, in [0, sum of weights].
  Eigen::Array<bool, Eigen::Dynamic, 1> is_inlier;  // r_k <= c_k there.
  Eigen::Index num_inliers = 0;
};

// `noise_bounds` holds c_k > 0 [m]; sizes must agree. Nullopt if no yaw makes
// an inlier of a measurement that depends on it: none given, no weight, all of
// them vertical, or no two lengths that agree; and if anything is not finite.
// Of equal minima the first counter-clockwise from -pi.
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
