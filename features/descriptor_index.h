// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Exact nearest-neighbor search among descriptors. Distances are
//
//   |x - y|^2 = ((x_1 - y_1)^2 + (x_2 - y_2)^2) + ...  in single precision, (1)
//
// summed in this order. If two distances are equal, the lower index counts as
// nearer.
//
// Descriptors of surfaces fill little of their space. Let V project onto the
// kNumAxes directions of largest variance. A projected distance never exceeds
// the distance, and is usually little shorter,
//
//   |V x - V y| <= |x - y|.                                                (2)
//
// The index sorts the descriptors by V x into tiles of 16, by recursive
// halving. Each tile has a bounding box, and each group of 16 tiles has a
// larger one. A search visits the boxes, then compares tiles by (2), and
// computes (1) for the tiles that remain. It skips everything whose projected
// distance exceeds the best distance so far by more than rounding,
//
//   |V x - V y| > (1 + 1e-5) best + 4e-5 max |x|.                          (3)
//
// The products V x and V y in single precision, 33 terms on each of 16 axes,
// are off by less than 1.6e-5 max |x| together, and the sum (1) by less than
// 2.1e-6 of itself. Tiles are compared by
//
//   |V x|^2 + |V y|^2 - 2 V x . V y,                                       (4)
//
// which takes half the work. The sums and the limit are off by less than a
// hundred roundings of max |x|^2, which is 6e-6 max |x|^2.

#ifndef QUATRO_FEATURES_DESCRIPTOR_INDEX_H_
#define QUATRO_FEATURES_DESCRIPTOR_INDEX_H_

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "features/base/lanes.h"
#include "features/base/simd.h"
#include "features/base/zeroed_allocator.h"
#include "features/fpfh.h"

namespace quatro {

// The projection V, and the margins that cover its rounding.
struct DescriptorAxes {
  static constexpr int kNumAxes = 16;

  // V: orthonormal rows. If V is zero, nothing is skipped, which costs time but
  // no accuracy.
  Eigen::Matrix<float, kNumAxes, kFpfhSize> directions =
      Eigen::Matrix<float, kNumAxes, kFpfhSize>::Zero();
  float margin = 0.0f;          // The last term of (3).
  float squared_margin = 0.0f;  // The rounding of (4).
};

// The directions of largest variance in a sample of both sets. V is zero if
// there are no descriptors or a squared length is 1e30 or more. The margins are
// valid only for the descriptors of `a` and `b`.
DescriptorAxes FindAxes(const Fpfh& a, const Fpfh& b);

// A descriptor and its distance to a query.
struct NearestDescriptor {
  float squared_distance = std::numeric_limits<float>::infinity();
  std::int32_t index = std::numeric_limits<std::int32_t>::max();  // No match.
};

// A query and the nearest descriptor found so far.
struct DescriptorQuery {
  const float* descriptor;
  const float* coordinates;  // V x of the query, for the V of the index.
  NearestDescriptor best;
};

// A hierarchy of bounding boxes over descriptors, searched by (2) before (1).
class DescriptorIndex {
 public:
  // Ignores descriptors that are all zero or not finite.
  DescriptorIndex(const Fpfh& descriptors, const DescriptorAxes& axes);

  // The indices of the descriptors that were not ignored. Descriptors that are
  // near each other are adjacent.
  const std::vector<std::int32_t>& order() const { return order_; }

  // V x of all descriptors, one per column.
  const Eigen::Matrix<float, DescriptorAxes::kNumAxes, Eigen::Dynamic>&
  coordinates() const {
    return coordinates_;
  }

  // Replaces the `best` of each query by the nearest descriptor if it is
  // nearer. If `any` is set, any nearer descriptor will do. It is fastest if
  // consecutive queries are near each other. `level` must not exceed
  // BestSimdLevel().
  void FindNearer(bool any,
                  SimdLevel level,
                  std::span<DescriptorQuery> queries) const;

  // Sixteen descriptors, one row per bin.
  struct Tile {
    FloatRow bins[kFpfhSize];
    IntRow index;
  };

  // V x of the descriptors of a tile, one row per axis.
  struct TileAlong {
    FloatRow axis[DescriptorAxes::kNumAxes];
    FloatRow squared_length;
  };

  // Sixteen bounding boxes, given by their corners along the axes.
  struct Boxes {
    FloatRow low[DescriptorAxes::kNumAxes];
    FloatRow high[DescriptorAxes::kNumAxes];
  };

  // All tiles, and their boxes on two levels.
  struct Parts {
    float margin = 0.0f;
    float squared_margin = 0.0f;
    ZeroedVector<Tile> tiles;
    ZeroedVector<TileAlong> tiles_along;
    std::vector<Boxes> tile_boxes;
    std::vector<Boxes> large_boxes;  // Around 16 tiles each.
  };

 private:
  std::vector<std::int32_t> order_;
  Eigen::Matrix<float, DescriptorAxes::kNumAxes, Eigen::Dynamic> coordinates_;
  Parts parts_;
};

}  // namespace quatro

#endif  // QUATRO_FEATURES_DESCRIPTOR_INDEX_H_
