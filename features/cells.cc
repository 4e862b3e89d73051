// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/cells.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "features/base/radix_sort.h"

namespace quatro {
namespace {

// With at most this many cells per axis, rounding cannot break (1) if cells are
// wider than the radius by one part in a million.
constexpr double kMaxNumCells = 1 << 20;
constexpr double kWider = 1.0 + 1e-6;

}  // namespace

std::optional<Cells> Cells::Make(const Points& points, double radius) {
  Cells result;
  const Eigen::Index n = points.cols();
  if (n == 0) return result;
  result.low_ = points.rowwise().minCoeff();
  const Eigen::Vector3d extents = points.rowwise().maxCoeff() - result.low_;
  const double extent = extents.maxCoeff();
  result.width_ = radius * kWider;
  // There are no cells if the extent overflows, or if extent and radius are
  // zero.
  if (!(extent < kMaxNumCells * result.width_ && std::isfinite(extent))) {
    return std::nullopt;
  }
  // Cells are numbered from 1, so that one empty cell lies below the first cell
  // and one above the last.
  result.num_cells_ = (extents / result.width_).array().floor() + 3.0;
  int bits[3];
  for (int axis = 0; axis < 3; ++axis) {
    bits[axis] = static_cast<int>(std::bit_width(
        static_cast<std::uint64_t>(result.num_cells_[axis] - 1.0)));
  }
  result.y_shift_ = bits[2];
  result.x_shift_ = bits[2] + bits[1];
  result.num_key_bits_ = bits[2] + bits[1] + bits[0];
  ZeroedVector<KeyedIndex> keyed(static_cast<std::size_t>(n));
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Vector3d cell =
        (points.col(i) - result.low_) / result.width_ + Eigen::Vector3d::Ones();
    keyed[static_cast<std::size_t>(i)] = {result.KeyAt(cell),
                                          static_cast<std::int32_t>(i)};
  }
  RadixSort(result.num_key_bits_, &keyed);
  result.order_.reserve(keyed.size());
  for (const auto& [key, i] : keyed) {
    const std::size_t at = result.order_.size();
    if (result.cells_.empty() || result.cells_.back().key != key) {
      result.cells_.push_back({key, at, at});
    }
    result.order_.push_back(i);
    result.cells_.back().end = at + 1;
  }
  return result;
}

std::optional<Cells::Key> Cells::KeyOf(const Eigen::Vector3d& place) const {
  const Eigen::Vector3d cell =
      (place - low_) / width_ + Eigen::Vector3d::Ones();
  if (!((cell.array() >= 0.0).all() &&
        (cell.array() < num_cells_.array()).all())) {
    return std::nullopt;
  }
  return KeyAt(cell);
}

Cells::Key Cells::KeyAt(const Eigen::Vector3d& cell) const {
  return static_cast<Key>(cell.x()) << x_shift_ |
         static_cast<Key>(cell.y()) << y_shift_ | static_cast<Key>(cell.z());
}

void Cells::Walk::FindNear(Key key, std::vector<std::int32_t>* near) {
  const std::vector<Cell>& cells = cells_.cells_;
  near->clear();
  const Key x_step = Key{1} << cells_.x_shift_;
  const Key y_step = Key{1} << cells_.y_shift_;
  // If `key` is at the start of an axis, `corner` is a cell at the end of
  // another row. Cells at an end are always empty.
  const Key corner = key - x_step - y_step - 1;
  for (std::size_t column = 0; column < at_.size(); ++column) {
    const Key first = corner + column / 3 * x_step + column % 3 * y_step;
    std::size_t& at = at_[column];
    if (at > 0 && cells[at - 1].key >= first) at = 0;
    const auto is_before = [&](std::size_t i) {
      return i < cells.size() && cells[i].key < first;
    };
    for (int step = 0; step < 8 && is_before(at); ++step) ++at;
    if (is_before(at)) {
      const auto from = cells.begin() + static_cast<std::ptrdiff_t>(at);
      const auto found = std::lower_bound(
          from, cells.end(), first, [](const Cell& cell, Key wanted) {
            return cell.key < wanted;
          });
      at = static_cast<std::size_t>(found - cells.begin());
    }
    std::size_t end = at;
    while (end < cells.size() && cells[end].key - first <= 2) ++end;
    if (end == at) continue;
    near->insert(near->end(),
                 cells_.order_.data() + cells[at].begin,
                 cells_.order_.data() + cells[end - 1].end);
  }
}

}  // namespace quatro
