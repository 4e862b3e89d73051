// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Nearest points in space: the one place that knows nanoflann.

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

// A point of the tree, as seen from a query.
struct Neighbor {
  Eigen::Index index = 0;
  double squared_distance = 0.0;  // [m^2]
};

// Holds its own copy of the points, which must be finite. Const members may be
// called from several threads; the first call builds the tree.
class KdTree {
 public:
  // Of these points; it can be moved, not copied.
  explicit KdTree(Points points);
  ~KdTree();
  KdTree(KdTree&&) noexcept;
  KdTree& operator=(KdTree&&) noexcept;

  // The copy.
  const Points& points() const { return *points_; }

  // All points no further than `radius` [m], in ascending order of index.
  std::vector<Neighbor> WithinRadius(const Eigen::Vector3d& query,
                                     double radius) const;

  // The `k` nearest, nearest first; fewer if the tree holds fewer.
  std::vector<Neighbor> Nearest(const Eigen::Vector3d& query, int k) const;

  // The nearest no further than `radius` [m]. Faster than Nearest() where there
  // is none.
  std::optional<Neighbor> NearestWithin(const Eigen::Vector3d& query,
                                        double radius) const;

 private:
  class Index;
  std::unique_ptr<const Points> points_;
  std::unique_ptr<Index> index_;
};

// Of each point of the tree those within `radius` [m], in ascending order of
// index.
Neighborhoods FindNeighborhoods(const KdTree& tree,
                                double radius,
                                int num_threads);

// The same, bit for bit, by the tree alone: what cells are measured against,
// and where they can't be used.
Neighborhoods FindNeighborhoodsByTree(const KdTree& tree,
                                      double radius,
                                      int num_threads);

// The same of the `k` nearest, nearest first; fewer if the tree holds fewer.
Neighborhoods FindNearestNeighborhoods(const KdTree& tree,
                                       int k,
                                       int num_threads);

}  // namespace quatro

#endif  // QUATRO_FEATURES_KD_TREE_H_
