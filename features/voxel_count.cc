// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/voxel_count.h"

#include <algorithm>
#include <cstddef>

#include "features/base/key_numbers.h"
#include "features/base/random.h"

namespace quatro {
namespace {

constexpr int kCellBits = 21;
constexpr std::size_t kManyPoints = 50'000;

}  // namespace

VoxelCounter::VoxelCounter(const PointsRef& points) {
  Eigen::Vector3d low = points.col(0);
  Eigen::Vector3d high = low;
  for (Eigen::Index i = 1; i < points.cols(); ++i) {
    low = low.cwiseMin(points.col(i));
    high = high.cwiseMax(points.col(i));
  }
  width_ = (high - low).maxCoeff();
  const double divisor = width_ > 0.0 ? width_ : 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<float>& row = coordinates_[static_cast<std::size_t>(axis)];
    row.resize(static_cast<std::size_t>(points.cols()));
    for (std::size_t i = 0; i < row.size(); ++i) {
      const double offset =
          points(axis, static_cast<Eigen::Index>(i)) - low[axis];
      row[i] = static_cast<float>(offset / divisor);
    }
  }
}

double VoxelCounter::min_voxel_size() const {
  return width_ / ((1 << kCellBits) - 1);
}

template <typename Use>
void VoxelCounter::ForEachKey(double voxel_size, const Use& use) const {
  const auto cells_per_width = static_cast<float>(width_ / voxel_size);
  const std::size_t n = num_points();
  constexpr std::size_t kBlock = 256;
  std::array<std::array<std::int32_t, kBlock>, 3> cell;
  for (std::size_t begin = 0; begin < n; begin += kBlock) {
    const std::size_t size = std::min(kBlock, n - begin);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float* row = coordinates_[axis].data() + begin;
      for (std::size_t k = 0; k < size; ++k) {
        cell[axis][k] = static_cast<std::int32_t>(row[k] * cells_per_width);
      }
    }
    for (std::size_t k = 0; k < size; ++k) {
      std::uint64_t key = 0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        key = key << kCellBits | static_cast<std::uint64_t>(cell[axis][k]);
      }
      use(key, begin + k);
    }
  }
}

double VoxelCounter::Estimate(double voxel_size) const {
  KeyNumbers cells;
  const bool are_many = num_points() > kManyPoints;
  ForEachKey(voxel_size, [&](std::uint64_t key, std::size_t) {
    if (!are_many || Mix(key) >> 62 == 0) cells.Add(key);
  });
  return (are_many ? 4.0 : 1.0) * static_cast<double>(cells.size());
}

std::vector<Eigen::Index> VoxelCounter::FirstPoints(double voxel_size) const {
  KeyNumbers cells;
  std::vector<Eigen::Index> first;
  ForEachKey(voxel_size, [&](std::uint64_t key, std::size_t i) {
    if (cells.Add(key) == first.size()) {
      first.push_back(static_cast<Eigen::Index>(i));
    }
  });
  return first;
}

}  // namespace quatro
