// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Matches with a point far from all the others: a stray coordinate of 1e12 m,
// or FLT_MAX for "no return". With m the median of a cloud by axis and
//
//   s = max( median_i |p_i - m|, noise bound ),    |.| the largest axis,   (1)
//
// a point is within k if |p_i - m| <= k s, and a match if both of its points
// are. The matches within 20 have a mean and a largest distance that no stray
// coordinate moves. Distances above noise bound / epsilon are rounded by more
// than the noise bound, and squares of distances far above s / epsilon overflow
// in the end.

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

// By axis. There is at least one point.
Eigen::Vector3d Median(const PointsRef& points);

// The matches within 20, in ascending order; all if there are none. In a scan
// these are all.
std::vector<Eigen::Index> FindNear(const PointsRef& source,
                                   const PointsRef& target,
                                   double noise_bound);

// The matches within 1 / epsilon, in ascending order. The others have a point
// so far away that its last digit is longer than s.
std::vector<Eigen::Index> FindPlaceable(const PointsRef& source,
                                        const PointsRef& target,
                                        double noise_bound);

}  // namespace quatro

#endif  // QUATRO_ROBUST_GRAPH_FAR_MATCHES_H_
