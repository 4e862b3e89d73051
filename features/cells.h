// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Points by cubes as wide as a radius, so that
//
//   |p - q| <= radius  =>  |cell(p) - cell(q)| <= 1 on each axis:           (1)
//
// what is near to a place is in the 27 cells around it.

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

// The cells of a cloud that hold a point.
class Cells {
 public:
  // One of them, by number; those of neighbours differ by strides.
  using Key = std::uint64_t;

  // The points of a cell: [begin, end) of order().
  struct Cell {
    Key key;
    std::size_t begin, end;
  };

  // Nullopt if the cloud is wider than 2^20 radii or more than can be computed
  // with.
  static std::optional<Cells> Make(const Points& points, double radius);

  // In ascending order of keys.
  const std::vector<Cell>& cells() const { return cells_; }

  // The points, cell by cell.
  const std::vector<std::int32_t>& order() const { return order_; }

  // Keys are below 2 to this power.
  int num_key_bits() const { return num_key_bits_; }

  // The cell around a place; nullopt where none of (1) holds a point, as for
  // what is not finite.
  std::optional<Key> KeyOf(const Eigen::Vector3d& place) const;

  // Finds what is near to one key after the other; fastest where each is a
  // little above the one before.
  class Walk {
   public:
    // Over cells that outlive it.
    explicit Walk(const Cells& cells) : cells_(cells) {}

    // Puts the points of the 27 cells around it into *near, cell by cell.
    void FindNear(Key key, std::vector<std::int32_t>* near);

   private:
    const Cells& cells_;
    std::array<std::size_t, 9> at_{};  // In each column of three cells.
  };

 private:
  Key KeyAt(const Eigen::Vector3d& cell) const;

  std::vector<std::int32_t> order_;
  std::vector<Cell> cells_;
  Eigen::Vector3d low_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d num_cells_ = Eigen::Vector3d::Zero();
  double width_ = 1.0;
  int y_shift_ = 0, x_shift_ = 0;  // Of these axes in a key, above z.
  int num_key_bits_ = 0;
};

}  // namespace quatro

#endif  // QUATRO_FEATURES_CELLS_H_
