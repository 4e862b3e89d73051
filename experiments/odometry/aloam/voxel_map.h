// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The points of many scans, one per voxel: the mean of the points in it. Voxels
// far from the sensor are removed.

#ifndef QUATRO_EXPERIMENTS_ODOMETRY_ALOAM_VOXEL_MAP_H_
#define QUATRO_EXPERIMENTS_ODOMETRY_ALOAM_VOXEL_MAP_H_

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <map>

#include "features/base/types.h"

namespace quatro {

class VoxelMap {
 public:
  // `voxel_size` > 0 [m].
  explicit VoxelMap(double voxel_size) : voxel_size_(voxel_size) {}

  // Points in the frame of the map, within 1e9 voxels of its origin.
  void Insert(const PointsRef& points);

  // Removes voxels whose mean is farther than `radius` [m] from `center`.
  void Crop(const Eigen::Vector3d& center, double radius);

  // In the order of the voxels' indices.
  Points Means() const;

  Eigen::Index size() const { return static_cast<Eigen::Index>(cells_.size()); }

 private:
  struct Cell {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double count = 0.0;
  };

  double voxel_size_;
  std::map<std::array<std::int64_t, 3>, Cell> cells_;
};

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_ODOMETRY_ALOAM_VOXEL_MAP_H_
