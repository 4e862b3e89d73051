// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/verdict/free_space.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace quatro {
namespace {

// A column is 0.45 to 0.9 deg wide, a row 0.9 deg high near the horizon.
constexpr int kNumColumns = 512;
constexpr int kNumRows = 128;
constexpr double kCell = 2.0 / kNumRows;  // [rad], about.

// How many cells to either side a point makes known, and how many it blocks.
struct Reach {
  int sees;
  int blocks;
};

// The reach of a point that extends `angle` [rad] to either side, in cells of
// width `cell` [rad]. It is limited, since a point next to the sensor would
// otherwise block half of all directions.
Reach ReachOf(double angle, double cell) {
  constexpr double kMaxReach = 16.0;
  // Rounded down, so that cells farther away do not become known.
  const int sees = static_cast<int>(std::min(kMaxReach, angle / cell));
  const int blocks =
      static_cast<int>(std::min(kMaxReach, (angle + kCell) / cell));
  return {sees, std::max(sees + 1, blocks)};
}

}  // namespace

std::size_t RangeImage::At(int row, int column) const {
  // Columns are periodic.
  return static_cast<std::size_t>(row) * kNumColumns +
         static_cast<std::size_t>(column & (kNumColumns - 1));
}

RangeImage::Cell RangeImage::CellOf(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d ray = point - sensor_;
  const double range = ray.norm();
  if (!(range > 0.0)) return {0, 0, 0.0};
  const double sum = std::abs(ray.x()) + std::abs(ray.y());
  // In [0, 4) over a full turn.
  double diamond = sum > 0.0 ? ray.y() / sum : 0.0;
  if (ray.x() < 0.0) {
    diamond = 2.0 - diamond;
  } else if (diamond < 0.0) {
    diamond += 4.0;
  }
  const int row = static_cast<int>((ray.z() / range + 1.0) * (0.5 * kNumRows));
  return {std::clamp(row, 0, kNumRows - 1),
          static_cast<int>(diamond * (0.25 * kNumColumns)),
          range};
}

RangeImage::RangeImage(const PointsRef& points,
                       const Eigen::Vector3d& sensor,
                       double voxel_size)
    : sensor_(sensor),
      min_range_(std::numeric_limits<double>::infinity()),
      free_(kNumRows * kNumColumns, std::numeric_limits<float>::infinity()),
      is_known_(kNumRows * kNumColumns, 0) {
  const double half_diagonal = 0.5 * std::sqrt(3.0) * voxel_size;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Cell cell = CellOf(points.col(i));
    if (cell.range == 0.0) continue;
    min_range_ = std::min(min_range_, cell.range);
    // Angular width and height of this cell at the sensor, and the reach of
    // half the diagonal. A full turn is 4 units of diamond angle; one unit is
    // (|x| + |y|)^2 / (x^2 + y^2) rad.
    const Eigen::Vector3d ray = points.col(i) - sensor;
    const double across = std::max(ray.head<2>().norm(), 1e-3 * cell.range);
    const double sum = std::max(ray.head<2>().lpNorm<1>(), across);
    const double width = 4.0 / kNumColumns * (sum / across) * (sum / across);
    const double height = kCell * cell.range / across;
    const Reach rows = ReachOf(half_diagonal / cell.range, height);
    const Reach columns = ReachOf(half_diagonal / across, width);
    const auto range = static_cast<float>(cell.range);
    const int last_row = std::min(kNumRows - 1, cell.row + rows.blocks);
    for (int row = std::max(0, cell.row - rows.blocks); row <= last_row;
         ++row) {
      const bool row_is_seen = std::abs(row - cell.row) <= rows.sees;
      for (int step = -columns.blocks; step <= columns.blocks; ++step) {
        const std::size_t at = At(row, cell.column + step);
        free_[at] = std::min(free_[at], range);
        if (row_is_seen && std::abs(step) <= columns.sees) is_known_[at] = 1;
      }
    }
  }
}

RangeImage::Sight RangeImage::At(const Eigen::Vector3d& point,
                                 double margin) const {
  const Cell cell = CellOf(point);
  const std::size_t at = At(cell.row, cell.column);
  if (cell.range < min_range_ || !is_known_[at]) return Sight::kUnknown;
  return cell.range < free_[at] - margin - kCell * cell.range ? Sight::kFree
                                                              : Sight::kNotFree;
}

}  // namespace quatro
