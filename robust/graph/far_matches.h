// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Finds matches with a point far from all others, for example with a stray
// coordinate of 1e12 m, or FLT_MAX for "no return". Let m be the median of a
// cloud on each axis and
//
//   s = max( median_i |p_i - m|, noise bound ),    |.| the maximum norm.   (1)
//
// A point is within k if |p_i - m| <= k s, and a match if both of its points
// are. Stray coordinates do not affect the mean and the largest distance of the
// matches within 20. A double rounds distances above noise bound / epsilon by
// more than the noise bound, and squares of much larger distances overflow.

#ifndef QUATRO_ROBUST_GRAPH_FAR_MATCHES_H_
#define QUATRO_ROBUST_GRAPH_FAR_MATCHES_H_

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "features/base/types.h"

namespace quatro {

// The longest distance that a double resolves to the noise bound [m].
inline double MaxResolved(double noise_bound) {
  return noise_bound / std::numeric_limits<double>::epsilon();
}

// The median on each axis. Requires at least one point.
Eigen::Vector3d Median(const PointsRef& points);

// The matches within 20, in ascending order; all matches if there are none.
// Matches of real scans are usually all within 20.
std::vector<Eigen::Index> FindNear(const PointsRef& source,
                                   const PointsRef& target,
                                   double noise_bound);

// The matches within 1 / epsilon, in ascending order. The others have a point
// so far away that a double rounds it by more than s.
std::vector<Eigen::Index> FindPlaceable(const PointsRef& source,
                                        const PointsRef& target,
                                        double noise_bound);

}  // namespace quatro

#endif  // QUATRO_ROBUST_GRAPH_FAR_MATCHES_H_
