// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// How many cells of a grid a cloud occupies, for one cell size v after another:
//
//   N(v) = |{ floor((p_i - low) / v) }|,   low = min_i p_i on each axis.
//
// It is several times as fast as sampling the voxels (features/voxel_grid.h).

#ifndef QUATRO_FEATURES_VOXEL_COUNT_H_
#define QUATRO_FEATURES_VOXEL_COUNT_H_

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "features/base/types.h"

namespace quatro {

// Keeps the coordinates of a cloud in single precision.
class VoxelCounter {
 public:
  // The points must be finite, at least one, and their width must be finite.
  explicit VoxelCounter(const PointsRef& points);

  // The number of points.
  std::size_t num_points() const { return coordinates_[0].size(); }

  // The largest side of the bounding box [m].
  double width() const { return width_; }

  // The least size that Estimate() and FirstPoints() accept [m].
  double min_voxel_size() const;

  // N(v) for v = `voxel_size` [m], at least min_voxel_size(). Of many points, a
  // quarter of the cells, selected by a hash, is counted. The standard
  // deviation of the result is then sqrt(3 N(v)).
  double Estimate(double voxel_size) const;

  // The index of the first point in each occupied cell, in ascending order.
  std::vector<Eigen::Index> FirstPoints(double voxel_size) const;

 private:
  // Calls use(key, index) for each point, in order. Points have the same key if
  // and only if they are in the same cell.
  template <typename Use>
  void ForEachKey(double voxel_size, const Use& use) const;

  double width_ = 0.0;
  std::array<std::vector<float>, 3> coordinates_;  // In [0, 1], of the width.
};

}  // namespace quatro

#endif  // QUATRO_FEATURES_VOXEL_COUNT_H_
