// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Sorts points into cubic cells whose edge is the radius. Then
//
//   |p - q| <= radius  =>  |cell(p) - cell(q)| <= 1 on each axis,           (1)
//
// so all points within the radius of a place are in the 27 cells around it.

#ifndef QUATRO_FEATURES_CELLS_H_
#define QUATRO_FEATURES_CELLS_H_

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "features/base/types.h"

namespace quatro {

// The occupied cells of a cloud.
class Cells {
 public:
  // The number of a cell. Along an axis, neighbors differ by a fixed stride.
  using Key = std::uint64_t;

  // An occupied cell. Its points are [begin, end) of order().
  struct Cell {
    Key key;
    std::size_t begin, end;
  };

  // The points must be finite. Returns nullopt unless the width of the cloud is
  // finite and less than 2^20 radii [m].
  static std::optional<Cells> Make(const Points& points, double radius);

  // The occupied cells in ascending order of keys.
  const std::vector<Cell>& cells() const { return cells_; }

  // The indices of the points, cell by cell.
  const std::vector<std::int32_t>& order() const { return order_; }

  // All keys are below 2^num_key_bits().
  int num_key_bits() const { return num_key_bits_; }

  // The key of the cell that contains `place` [m]. Returns nullopt for a place
  // outside the grid, where (1) finds no point, and for one that is not finite.
  std::optional<Key> KeyOf(const Eigen::Vector3d& place) const;

  // Finds the points around one key after another. It is fastest if the keys
  // ascend in small steps.
  class Walk {
   public:
    // `cells` must outlive the walk.
    explicit Walk(const Cells& cells) : cells_(cells) {}

    // Writes the indices of the points in the 27 cells around `key` to *near,
    // cell by cell.
    void FindNear(Key key, std::vector<std::int32_t>* near);

   private:
    const Cells& cells_;
    // For each column of three cells, where it begins in cells().
    std::array<std::size_t, 9> at_{};
  };

 private:
  Key KeyAt(const Eigen::Vector3d& cell) const;

  std::vector<std::int32_t> order_;
  std::vector<Cell> cells_;
  Eigen::Vector3d low_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d num_cells_ = Eigen::Vector3d::Zero();
  double width_ = 1.0;
  int y_shift_ = 0, x_shift_ = 0;  // Bits below y and x in a key.
  int num_key_bits_ = 0;
};

}  // namespace quatro

#endif  // QUATRO_FEATURES_CELLS_H_
