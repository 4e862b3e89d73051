// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/voxel_grid.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <sstream>

#include "features/base/radix_sort.h"
#include "features/base/zeroed_allocator.h"

namespace quatro {
namespace {

constexpr int kBitsPerAxis = 21;
constexpr double kMaxCells = 1 << kBitsPerAxis;
constexpr double kFixedPoint = 0x1p32;

using Fixed3 = Eigen::Matrix<std::int64_t, 3, 1>;

// The cells of a cloud, by keys in the order of (x, y, z).
struct Grid {
  double voxel_size = 1.0;
  Eigen::Vector3d first_cell = Eigen::Vector3d::Zero();
  int bits[3] = {};  // Of an index along each axis.

  std::uint64_t KeyOf(const Eigen::Vector3d& point) const {
    std::uint64_t key = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double cell =
          std::floor(point[axis] / voxel_size) - first_cell[axis];
      key = key << bits[axis] | static_cast<std::uint64_t>(cell);
    }
    return key;
  }
};

std::optional<Grid> MakeGrid(const PointsRef& points,
                             double voxel_size,
                             std::string* error) {
  std::ostringstream problem;
  if (!(voxel_size > 0.0 && std::isfinite(voxel_size))) {
    problem << "voxel_size = " << voxel_size << ", must be > 0 and finite";
    *error = problem.str();
    return std::nullopt;
  }
  if (points.cols() == 0) return Grid();
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    if (points.col(i).allFinite()) continue;
    problem << "point " << i << " is not finite";
    *error = problem.str();
    return std::nullopt;
  }

  const double width =
      (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).maxCoeff();
  if (width > 0.0 && width < kMinCloudWidth) {
    problem << "the cloud is " << width
            << " m wide, must be at least 1e-100 m; convert its coordinates to "
               "meters";
    *error = problem.str();
    return std::nullopt;
  }

  const Eigen::Vector3d first_cell =
      (points.rowwise().minCoeff() / voxel_size).array().floor();
  const Eigen::Vector3d last_cell =
      (points.rowwise().maxCoeff() / voxel_size).array().floor();
  // Each axis is checked, because a maximum may drop a NaN that comes from
  // infinite cells.
  if (!((last_cell - first_cell).array() < kMaxCells).all()) {
    problem << "the cloud is "
            << (last_cell - first_cell).maxCoeff() * voxel_size
            << " m wide, which is more than 2^21 voxels of " << voxel_size
            << " m; remove stray points or use a larger voxel_size. The file "
               "may also have another layout or unit";
    *error = problem.str();
    return std::nullopt;
  }

  Grid grid{voxel_size, first_cell, {}};
  for (int axis = 0; axis < 3; ++axis) {
    grid.bits[axis] = static_cast<int>(std::bit_width(
        static_cast<std::uint64_t>(last_cell[axis] - first_cell[axis])));
  }
  return grid;
}

}  // namespace

std::optional<Points> SampleVoxels(const PointsRef& points,
                                   double voxel_size,
                                   std::string* error) {
  const std::optional<Grid> grid = MakeGrid(points, voxel_size, error);
  if (!grid) return std::nullopt;
  if (points.cols() == 0) return Points(3, 0);
  ZeroedVector<KeyedIndex> keyed(static_cast<std::size_t>(points.cols()));
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    keyed[static_cast<std::size_t>(i)] = {grid->KeyOf(points.col(i)),
                                          static_cast<std::int32_t>(i)};
  }
  RadixSort(grid->bits[0] + grid->bits[1] + grid->bits[2], &keyed);

  Eigen::Index num_cells = 1;
  for (std::size_t k = 1; k < keyed.size(); ++k) {
    num_cells += keyed[k].key != keyed[k - 1].key;
  }
  Points samples(3, num_cells);
  Eigen::Index num_samples = 0;
  for (auto begin = keyed.begin(); begin != keyed.end();) {
    // Offsets from the cell's corner are in [0, 1), in units of cells.
    const Eigen::Vector3d corner =
        (points.col(begin->index) / voxel_size).array().floor();
    Fixed3 sum = Fixed3::Zero();
    auto end = begin;
    for (; end != keyed.end() && end->key == begin->key; ++end) {
      const Eigen::Vector3d offset =
          points.col(end->index) / voxel_size - corner;
      sum += (offset * kFixedPoint).cast<std::int64_t>();
    }
    const double scale = 1.0 / (kFixedPoint * static_cast<double>(end - begin));
    samples.col(num_samples++) =
        (corner + sum.cast<double>() * scale) * voxel_size;
    begin = end;
  }
  return samples;
}

}  // namespace quatro
