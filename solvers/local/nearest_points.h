// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The nearest point of a cloud to each of many queries that move a little at a
// time.
//
// Suppose that a search at x finds the nearest point at distance a and the
// second nearest at distance b. At y with |y - x| = m, all other points are at
// least b - m away. So the nearest point is still the same if its distance from
// y is less than b - m. If a - m exceeds max_distance, no point is within
// max_distance. Only the other queries are searched again. The results are
// those of a search for each query.
//
// Source: Greenspan and Godin, "A Nearest Neighbor Method for Efficient ICP",
// 3DIM 2001, for the idea.

#ifndef QUATRO_SOLVERS_LOCAL_NEAREST_POINTS_H_
#define QUATRO_SOLVERS_LOCAL_NEAREST_POINTS_H_

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <vector>

#include "features/kd_tree.h"

namespace quatro {

// Nearest points that are searched again only if they may have changed.
class NearestPoints {
 public:
  // Prepares `num_queries` moving queries. `cloud` must outlive this object.
  // `max_distance` is in meters.
  NearestPoints(const KdTree& cloud,
                Eigen::Index num_queries,
                double max_distance)
      : cloud_(cloud),
        max_distance_(max_distance),
        last_(static_cast<std::size_t>(num_queries)) {}

  // The index of the point nearest to query i, now at `x`, or -1 if no point is
  // within max_distance. It may be called from several threads for different i.
  Eigen::Index Find(Eigen::Index i, const Eigen::Vector3d& x) {
    Last& last = last_[static_cast<std::size_t>(i)];
    if (last.index >= 0) {
      const double moved = (x - last.x).norm() * kRounding;
      const double distance = (cloud_.points().col(last.index) - x).norm();
      if (distance * kRounding < last.second_distance - moved) {
        return distance <= max_distance_ ? last.index : -1;
      }
      if (last.distance - moved > max_distance_ * kRounding) return -1;
    }
    const auto found = cloud_.Nearest(x, 2);
    if (found.empty()) return -1;
    last.x = x;
    last.index = found[0].index;
    last.distance = std::sqrt(found[0].squared_distance);
    last.second_distance = found.size() > 1
                               ? std::sqrt(found[1].squared_distance)
                               : std::numeric_limits<double>::infinity();
    return last.distance <= max_distance_ ? last.index : -1;
  }

 private:
  static constexpr double kRounding = 1.0 + 1e-12;

  struct Last {
    Eigen::Vector3d x;
    Eigen::Index index = -1;
    double distance = 0.0;
    double second_distance = 0.0;
  };

  const KdTree& cloud_;
  double max_distance_;
  std::vector<Last> last_;
};

}  // namespace quatro

#endif  // QUATRO_SOLVERS_LOCAL_NEAREST_POINTS_H_
