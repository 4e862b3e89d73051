// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Searches among points p_i in space, for a query q:
//
//   { i : |p_i - q| <= radius }   and   argmin_i |p_i - q|.
//
// This is the only file that uses nanoflann.

#ifndef QUATRO_FEATURES_KD_TREE_H_
#define QUATRO_FEATURES_KD_TREE_H_

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "features/base/types.h"
#include "features/neighborhoods.h"

namespace quatro {

// A point of the tree and its distance to a query.
struct Neighbor {
  Eigen::Index index = 0;
  double squared_distance = 0.0;  // [m^2]
};

// A k-d tree with its own copy of the points, which must be finite. Const
// members may be called from several threads. The first query builds the tree.
class KdTree {
 public:
  // Takes ownership of the points. The tree is movable but not copyable.
  explicit KdTree(Points points);
  ~KdTree();
  KdTree(KdTree&&) noexcept;
  KdTree& operator=(KdTree&&) noexcept;

  // The points of the tree.
  const Points& points() const { return *points_; }

  // All points within `radius` [m], boundary included, in ascending order of
  // index.
  std::vector<Neighbor> WithinRadius(const Eigen::Vector3d& query,
                                     double radius) const;

  // The `k` nearest points, nearest first. There are fewer if the tree has
  // fewer points.
  std::vector<Neighbor> Nearest(const Eigen::Vector3d& query, int k) const;

  // The nearest point within `radius` [m], boundary included. It is faster than
  // Nearest() if no point is that near.
  std::optional<Neighbor> NearestWithin(const Eigen::Vector3d& query,
                                        double radius) const;

 private:
  class Index;
  std::unique_ptr<const Points> points_;
  std::unique_ptr<Index> index_;
};

// For each point of the tree, its neighbors within `radius` [m] in ascending
// order of index.
Neighborhoods FindNeighborhoods(const KdTree& tree,
                                double radius,
                                int num_threads);

// Returns the result of FindNeighborhoods(), bit for bit, but uses only the
// tree. It is the reference for the faster search by cells, and the fallback
// for clouds that are too wide for cells.
Neighborhoods FindNeighborhoodsByTree(const KdTree& tree,
                                      double radius,
                                      int num_threads);

// For each point of the tree, its `k` nearest points, nearest first. There are
// fewer if the tree has fewer points.
Neighborhoods FindNearestNeighborhoods(const KdTree& tree,
                                       int k,
                                       int num_threads);

}  // namespace quatro

#endif  // QUATRO_FEATURES_KD_TREE_H_
