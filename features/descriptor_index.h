// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The nearest of many descriptors, exactly. Distances are those of
//
//   |x - y|^2 = ((x_1 - y_1)^2 + (x_2 - y_2)^2) + ...  in single precision, (1)
//
// term by term in this order; of equal ones the lower index is nearer.
//
// Descriptors of surfaces fill little of their space: along kNumAxes directions
// of most spread V, lengths are no longer, and hardly shorter,
//
//   |V x - V y| <= |x - y|.                                                (2)
//
// They are split in halves by V x down to tiles of 16, each within a box, 16 of
// which are in a larger box. What is looked at are boxes, then tiles by (2),
// then by (1). Passed over is what is farther away than the best so far by more
// than rounding,
//
//   |V x - V y| > (1 + 1e-5) best + 4e-5 max |x|,                          (3)
//
// where 33 products in single precision, for x and y along 16 axes, are off by
// less than 1.6e-5 max |x| together, and the sum (1) by less than 2.1e-6 of it.
// Tiles are looked at by
//
//   |V x|^2 + |V y|^2 - 2 V x . V y,                                       (4)
//
// half the work. Its sums and the limit are off by less than a hundred
// roundings of max |x|^2, 6e-6 of it.

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

// Directions to tell descriptors apart by, and what they are good for.
struct DescriptorAxes {
  static constexpr int kNumAxes = 16;

  // V: unit rows, at right angles. Zero tells nothing apart, which costs time
  // and nothing else.
  Eigen::Matrix<float, kNumAxes, kFpfhSize> directions =
      Eigen::Matrix<float, kNumAxes, kFpfhSize>::Zero();
  float margin = 0.0f;          // Last term of (3).
  float squared_margin = 0.0f;  // Of (4).
};

// Of most spread among a sample of both; for descriptors of both and no others.
DescriptorAxes FindAxes(const Fpfh& a, const Fpfh& b);

// In the order of (1), then index.
struct NearestDescriptor {
  float squared_distance = std::numeric_limits<float>::infinity();
  std::int32_t index = std::numeric_limits<std::int32_t>::max();  // Of none.
};

// Whose nearest is looked for, and the nearest so far.
struct DescriptorQuery {
  const float* descriptor;
  const float* coordinates;  // Along the axes of the index.
  NearestDescriptor best;
};

// Descriptors in boxes of (2), to be searched by bounds before distances.
class DescriptorIndex {
 public:
  // All-zero descriptors, and those not finite, are left out.
  DescriptorIndex(const Fpfh& descriptors, const DescriptorAxes& axes);

  // Those that are in it, neighbours next to each other.
  const std::vector<std::int32_t>& order() const { return order_; }

  // Along the axes.
  const Eigen::Matrix<float, DescriptorAxes::kNumAxes, Eigen::Dynamic>&
  coordinates() const {
    return coordinates_;
  }

  // Replaces the `best` of each by the nearest, if that is nearer. Where `any`
  // will do, by the first nearer one that comes up. Fastest for queries that
  // are near each other. `level` no more than BestSimdLevel().
  void FindNearer(bool any,
                  SimdLevel level,
                  std::span<DescriptorQuery> queries) const;

  // Sixteen descriptors, side by side.
  struct Tile {
    FloatRow bins[kFpfhSize];
    IntRow index;
  };

  // The same along the axes.
  struct TileAlong {
    FloatRow axis[DescriptorAxes::kNumAxes];
    FloatRow squared_length;
  };

  // The bounds of as many groups.
  struct Boxes {  // Sixteen, their corners along the axes.
    FloatRow low[DescriptorAxes::kNumAxes];
    FloatRow high[DescriptorAxes::kNumAxes];
  };

  // All of them, and their boxes at two levels.
  struct Parts {
    float margin = 0.0f;
    float squared_margin = 0.0f;
    ZeroedVector<Tile> tiles;
    ZeroedVector<TileAlong> tiles_along;
    std::vector<Boxes> tile_boxes;
    std::vector<Boxes> large_boxes;  // Of 16 tiles each.
  };

 private:
  std::vector<std::int32_t> order_;
  Eigen::Matrix<float, DescriptorAxes::kNumAxes, Eigen::Dynamic> coordinates_;
  Parts parts_;
};

}  // namespace quatro

#endif  // QUATRO_FEATURES_DESCRIPTOR_INDEX_H_
