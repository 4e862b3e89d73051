// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/verdict/structure_grid.h"

#include <algorithm>
#include <cmath>

namespace quatro {
namespace {

constexpr int kNumSectors = 7;
constexpr std::uint8_t kInRange = 1 << kNumSectors;

// The ratio of max_distance to the cell size. Cells are larger if there would
// be more than kMaxNumCells.
constexpr double kCellsPerDistance = 5.0 / 3.0;
constexpr double kMaxNumCells = 1 << 23;

// Azimuth of the normal in sectors, in [0, kNumSectors). Opposite normals have
// the same azimuth.
double SectorOf(const Eigen::Vector3d& normal) {
  const double turns = std::atan2(static_cast<float>(normal.y()),
                                  static_cast<float>(normal.x())) /
                       M_PI;
  return (turns - std::floor(turns)) * kNumSectors;
}

std::uint8_t SectorBit(int sector) {
  return static_cast<std::uint8_t>(1 << ((sector + kNumSectors) % kNumSectors));
}

}  // namespace

StructureSample SampleStructure(const DescribedCloud& cloud,
                                Eigen::Index num_wanted) {
  std::vector<Eigen::Index> all;
  for (Eigen::Index i = 0; i < cloud.normals.cols(); ++i) {
    if (IsStructure(cloud.normals.col(i))) all.push_back(i);
  }
  const auto num_all = static_cast<Eigen::Index>(all.size());
  const Eigen::Index num = std::min(num_all, num_wanted);
  StructureSample sample{Points(3, num), Points(3, num)};
  for (Eigen::Index k = 0; k < num; ++k) {
    const Eigen::Index i = all[static_cast<std::size_t>(k * num_all / num)];
    sample.points.col(k) = cloud.points().col(i);
    sample.normals.col(k) = cloud.normals.col(i);
  }
  return sample;
}

StructureGrid::StructureGrid(const DescribedCloud& cloud, double max_distance)
    : sensor_(cloud.sensor), max_range_(UsefulRange(cloud)) {
  const Points& points = cloud.points();
  std::vector<Eigen::Index> structure;
  Eigen::Array3d low = Eigen::Array3d::Zero();
  Eigen::Array3d high = Eigen::Array3d::Zero();
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Eigen::Array3d point = points.col(i) - sensor_;
    if (point.matrix().norm() > max_range_ ||
        !IsStructure(cloud.normals.col(i))) {
      continue;
    }
    if (structure.empty()) low = high = point;
    low = low.min(point);
    high = high.max(point);
    structure.push_back(i);
  }
  // The whole useful range in x and y, since points there count even without
  // overlap.
  low.head<2>().setConstant(-max_range_);
  high.head<2>().setConstant(max_range_);
  low -= max_distance;
  high += max_distance;
  cell_size_ = max_distance / kCellsPerDistance;
  const auto num_cells = [&] {
    return ((high - low) / cell_size_ + 1.0).prod();
  };
  if (num_cells() > kMaxNumCells) {
    cell_size_ =
        std::max(cell_size_, std::cbrt((high - low).prod() / kMaxNumCells));
    while (num_cells() > kMaxNumCells) cell_size_ *= 1.1;
  }
  low_ = low;
  size_ = ((high - low) / cell_size_).ceil().cast<int>().max(1);
  cells_ = ZeroedVector<std::uint8_t>(
      static_cast<std::size_t>(size_.cast<double>().prod()));

  const auto column_at = [&](int x, int y) {
    return cells_.data() +
           (static_cast<std::ptrdiff_t>(x) * size_.y() + y) * size_.z();
  };
  for (int x = 0; x < size_.x(); ++x) {
    for (int y = 0; y < size_.y(); ++y) {
      const double dx = low.x() + (x + 0.5) * cell_size_;
      const double dy = low.y() + (y + 0.5) * cell_size_;
      if (std::hypot(dx, dy) > max_range_) continue;
      std::fill_n(column_at(x, y), size_.z(), kInRange);
    }
  }
  const double reach =
      std::max(max_distance, 0.5 * std::sqrt(3.0) * cell_size_);
  for (const Eigen::Index i : structure) {
    const auto bit =
        SectorBit(static_cast<int>(SectorOf(cloud.normals.col(i))));
    const Eigen::Array3d at = (points.col(i) - sensor_).array() - low;
    const Eigen::Array3i first =
        ((at - reach) / cell_size_ - 0.5).ceil().cast<int>().max(0);
    const Eigen::Array3i last =
        ((at + reach) / cell_size_ - 0.5).floor().cast<int>().min(size_ - 1);
    for (int x = first.x(); x <= last.x(); ++x) {
      const double dx = (x + 0.5) * cell_size_ - at.x();
      for (int y = first.y(); y <= last.y(); ++y) {
        const double dy = (y + 0.5) * cell_size_ - at.y();
        std::uint8_t* column = column_at(x, y);
        for (int z = first.z(); z <= last.z(); ++z) {
          const double dz = (z + 0.5) * cell_size_ - at.z();
          if (dx * dx + dy * dy + dz * dz <= reach * reach) column[z] |= bit;
        }
      }
    }
  }
}

TurnedSample StructureGrid::Turn(const StructureSample& sample,
                                 const Rigid3& grid_from_sample) const {
  const Eigen::Vector3d origin = sensor_ + low_;
  TurnedSample turned;
  turned.points =
      ((grid_from_sample.Apply(sample.points).colwise() - origin) / cell_size_)
          .cast<float>();
  const Points normals = grid_from_sample.rotation * sample.normals;
  turned.sectors.reserve(static_cast<std::size_t>(normals.cols()));
  for (const auto normal : normals.colwise()) {
    const int sector = static_cast<int>(SectorOf(normal));
    turned.sectors.push_back(static_cast<std::uint8_t>(
        SectorBit(sector - 1) | SectorBit(sector) | SectorBit(sector + 1)));
  }
  return turned;
}

OverlapCount StructureGrid::Count(const TurnedSample& sample,
                                  const Eigen::Vector3d& shift) const {
  const Eigen::Array3f cells = (shift / cell_size_).cast<float>();
  const Eigen::Array3f size = size_.cast<float>();
  OverlapCount count;
  for (Eigen::Index i = 0; i < sample.points.cols(); ++i) {
    const Eigen::Array3f at = sample.points.col(i).array() + cells;
    if (!(at.x() >= 0.0f && at.y() >= 0.0f && at.x() < size.x() &&
          at.y() < size.y())) {
      continue;
    }
    const std::ptrdiff_t column =
        (static_cast<std::ptrdiff_t>(at.x()) * size_.y() +
         static_cast<std::ptrdiff_t>(at.y())) *
        size_.z();
    // Above and below the structure only the useful range matters.
    const bool has_cell = at.z() >= 0.0f && at.z() < size.z();
    const std::uint8_t cell = cells_[static_cast<std::size_t>(
        column + (has_cell ? static_cast<std::ptrdiff_t>(at.z()) : 0))];
    count.num_in_range += (cell & kInRange) != 0;
    count.num_overlapping +=
        has_cell && (cell & kInRange) != 0 &&
        (cell & sample.sectors[static_cast<std::size_t>(i)]) != 0;
  }
  return count;
}

}  // namespace quatro
