// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/odometry/aloam/voxel_map.h"

#include <cmath>

namespace quatro {

void VoxelMap::Insert(const PointsRef& points) {
  for (const auto& point : points.colwise()) {
    std::array<std::int64_t, 3> voxel;
    for (int i = 0; i < 3; ++i) {
      voxel[static_cast<std::size_t>(i)] =
          static_cast<std::int64_t>(std::floor(point[i] / voxel_size_));
    }
    Cell& cell = cells_[voxel];
    cell.sum += point;
    cell.count += 1.0;
  }
}

void VoxelMap::Crop(const Eigen::Vector3d& center, double radius) {
  std::erase_if(cells_, [&](const auto& entry) {
    const Cell& cell = entry.second;
    return (cell.sum / cell.count - center).squaredNorm() > radius * radius;
  });
}

Points VoxelMap::Means() const {
  Points means(3, size());
  Eigen::Index i = 0;
  for (const auto& [voxel, cell] : cells_)
    means.col(i++) = cell.sum / cell.count;
  return means;
}

}  // namespace quatro
