// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/descriptor_index.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

namespace quatro {
namespace {

constexpr int kNumAxes = DescriptorAxes::kNumAxes;
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr std::int32_t kNone = NearestDescriptor{}.index;

using Tile = DescriptorIndex::Tile;
using Boxes = DescriptorIndex::Boxes;
using Coordinates = Eigen::Matrix<float, kNumAxes, Eigen::Dynamic>;
using Corner = Eigen::Array<float, kNumAxes, 1>;

bool IsDescriptor(const Fpfh& descriptors, Eigen::Index i) {
  // A positive, finite sum means that all numbers are finite and not all are
  // zero.
  const float sum = descriptors.col(i).cwiseAbs().sum();
  if (sum > 0.0f && std::isfinite(sum)) return true;
  return !descriptors.col(i).isZero(0.0f) && descriptors.col(i).allFinite();
}

// Sorts [begin, end) by recursive halving along the widest axis, down to tiles.
// All tiles have 16 descriptors, and all boxes 16 tiles, except the last.
void SplitInHalves(const Coordinates& along,
                   std::int32_t* begin,
                   std::int32_t* end) {
  const std::ptrdiff_t size = end - begin;
  if (size <= kLanes) return;
  Corner low = along.col(*begin);
  Corner high = low;
  for (const std::int32_t* i = begin + 1; i < end; ++i) {
    low = low.min(along.col(*i).array());
    high = high.max(along.col(*i).array());
  }
  int axis = 0;
  (high - low).maxCoeff(&axis);
  constexpr std::ptrdiff_t kBoxSize = kLanes * kLanes;
  const std::ptrdiff_t unit = size > kBoxSize ? kBoxSize : kLanes;
  std::int32_t* middle = begin + (size / 2 + unit - 1) / unit * unit;
  std::nth_element(begin, middle, end, [&](std::int32_t i, std::int32_t j) {
    return along(axis, i) < along(axis, j);
  });
  SplitInHalves(along, begin, middle);
  SplitInHalves(along, middle, end);
}

void SetBox(std::size_t at,
            const Corner& low,
            const Corner& high,
            std::vector<Boxes>* boxes) {
  for (int axis = 0; axis < kNumAxes; ++axis) {
    (*boxes)[at / kLanes].low[axis].lane[at % kLanes] = low[axis];
    (*boxes)[at / kLanes].high[axis].lane[at % kLanes] = high[axis];
  }
}

// Boxes at infinity, which no search visits.
std::vector<Boxes> EmptyBoxes(std::size_t num) {
  Boxes empty;
  for (int axis = 0; axis < kNumAxes; ++axis) {
    std::fill_n(empty.low[axis].lane, kLanes, kInfinity);
    std::fill_n(empty.high[axis].lane, kLanes, kInfinity);
  }
  return std::vector<Boxes>((num + kLanes - 1) / kLanes, empty);
}

// One search with registers of kBytes.
template <int kBytes>
class Search {
 public:
  // Searches the nearest box, starting with its nearest tile.
  QUATRO_SIMD_INLINE void Start(const DescriptorIndex::Parts& parts,
                                const DescriptorQuery& query,
                                bool any) {
    descriptor_ = query.descriptor;
    coordinates_ = query.coordinates;
    start_ = query.best;
    any_ = any;
    squared_length_ = 0.0f;
    for (int axis = 0; axis < kNumAxes; ++axis) {
      squared_length_ += coordinates_[axis] * coordinates_[axis];
    }
    for (int piece = 0; piece < kNumPieces; ++piece) {
      best_[piece] = Float{} + start_.squared_distance;
      best_index_[piece] = Int{} + start_.index;
    }
    SetLeast(parts, start_.squared_distance);

    // The nearest box comes first, so that most others can be skipped.
    nearest_box_ = 0;
    float nearest = kInfinity;
    Float sum[kNumPieces];
    for (std::size_t k = 0; k < parts.large_boxes.size(); ++k) {
      ToBoxes(parts.large_boxes[k], sum);
      const float least = LeastOf(sum);
      if (!(least < nearest)) continue;
      nearest = least;
      nearest_box_ = k * kLanes + FirstOf(BitsNotAbove<kBytes>(sum, least));
    }
    is_done_ = nearest == kInfinity;
    if (is_done_) return;
    ToBoxes(parts.tile_boxes[nearest_box_], sum);
    const std::size_t nearest_tile =
        FirstOf(BitsNotAbove<kBytes>(sum, LeastOf(sum)));
    LookAt(parts.tiles[nearest_box_ * kLanes + nearest_tile]);
    SetLeast(parts, std::min(least_, LeastOf(best_)));
    is_done_ = LookInto(parts, nearest_box_);
  }

  // A bit mask of the boxes, out of 16, that may contain a nearer descriptor.
  QUATRO_SIMD_INLINE std::uint32_t Choose(const DescriptorIndex::Parts& parts,
                                          std::size_t k) const {
    if (is_done_) return 0;
    Float sum[kNumPieces];
    ToBoxes(parts.large_boxes[k], sum);
    std::uint32_t bits = BitsNotAbove<kBytes>(sum, limit_);
    if (nearest_box_ / kLanes == k) bits &= ~(1u << nearest_box_ % kLanes);
    return bits;
  }

  QUATRO_SIMD_INLINE void GoOn(const DescriptorIndex::Parts& parts,
                               std::size_t box) {
    if (!is_done_) is_done_ = LookInto(parts, box);
  }

  QUATRO_SIMD_INLINE NearestDescriptor Result() const {
    std::int32_t index = kNone;
    for (int piece = 0; piece < kNumPieces; ++piece) {
      for (int lane = 0; lane < Lanes<kBytes>::kPieceLanes; ++lane) {
        if (best_[piece][lane] == least_) {
          index = std::min<std::int32_t>(index, best_index_[piece][lane]);
        }
      }
    }
    return {least_, index};
  }

 private:
  using Float = typename Lanes<kBytes>::Float;
  using Int = typename Lanes<kBytes>::Int;
  static constexpr int kNumPieces = Lanes<kBytes>::kNumPieces;

  QUATRO_SIMD_INLINE static std::size_t FirstOf(std::uint32_t bits) {
    return static_cast<std::size_t>(std::countr_zero(bits));
  }

  // Nonnegative numbers have the same order as their bits.
  QUATRO_SIMD_INLINE static float LeastOf(const Float (&x)[kNumPieces]) {
    Int least = reinterpret_cast<Int>(x[0]);
    for (int piece = 1; piece < kNumPieces; ++piece) {
      const Int bits = reinterpret_cast<Int>(x[piece]);
      least = bits < least ? bits : least;
    }
    return std::bit_cast<float>(MinOf<kBytes>(least));
  }

  QUATRO_SIMD_INLINE void SetLeast(const DescriptorIndex::Parts& parts,
                                   float squared_distance) {
    least_ = squared_distance;
    const float distance =
        std::sqrt(least_) * (1.0f + 1e-5f) + parts.margin;  // Equation (3).
    // Squares may be rounded down to 0, and padding is at infinity.
    limit_ = std::min(distance * distance + 1e-35f,
                      std::numeric_limits<float>::max());
  }

  // Squared distances from the query to the boxes.
  QUATRO_SIMD_INLINE void ToBoxes(const Boxes& boxes,
                                  Float (&sum)[kNumPieces]) const {
    const Float zero = {};
    for (int piece = 0; piece < kNumPieces; ++piece) {
      sum[piece] = zero;
      for (int axis = 0; axis < kNumAxes; ++axis) {
        const Float below =
            Piece<kBytes>(boxes.low[axis], piece) - coordinates_[axis];
        const Float above =
            coordinates_[axis] - Piece<kBytes>(boxes.high[axis], piece);
        Float outside;
        Instructions<kBytes>::Max(below, above, &outside);
        Instructions<kBytes>::Max(outside, zero, &outside);
        Instructions<kBytes>::AddProduct(outside, outside, &sum[piece]);
      }
    }
  }

  // Equation (4) without the query's own length.
  QUATRO_SIMD_INLINE static void ToTileAlong(
      const DescriptorIndex::TileAlong& tile,
      const Float (&minus_twice)[kNumAxes],
      Float (&sum)[kNumPieces]) {
    for (int piece = 0; piece < kNumPieces; ++piece) {
      sum[piece] = Piece<kBytes>(tile.squared_length, piece);
      // Unrolled, so that several tiles are computed at once.
#pragma GCC unroll 16
      for (int axis = 0; axis < kNumAxes; ++axis) {
        Instructions<kBytes>::AddProduct(Piece<kBytes>(tile.axis[axis], piece),
                                         minus_twice[axis],
                                         &sum[piece]);
      }
    }
  }

  // Searches the sixteen tiles of a box. Returns true if the search can stop.
  QUATRO_SIMD_INLINE bool LookInto(const DescriptorIndex::Parts& parts,
                                   std::size_t box) {
    Float sum[kNumPieces];
    ToBoxes(parts.tile_boxes[box], sum);
    // This local copy stays in registers.
    Float minus_twice[kNumAxes];
    for (int axis = 0; axis < kNumAxes; ++axis) {
      minus_twice[axis] = Float{} - 2.0f * coordinates_[axis];
    }
    const float limit = limit_ + parts.squared_margin - squared_length_;
    std::size_t chosen[kLanes];
    int num_chosen = 0;
    for (std::uint32_t bits = BitsNotAbove<kBytes>(sum, limit_); bits != 0;
         bits &= bits - 1) {
      const std::size_t tile = box * kLanes + FirstOf(bits);
      ToTileAlong(parts.tiles_along[tile], minus_twice, sum);
      chosen[num_chosen] = tile;
      num_chosen += BitsNotAbove<kBytes>(sum, limit) != 0;
    }
    if (num_chosen == 0) return false;
    for (int k = 0; k < num_chosen; ++k) LookAt(parts.tiles[chosen[k]]);
    const float least = LeastOf(best_);
    if (least < least_) SetLeast(parts, least);
    return any_ &&
           (least_ < start_.squared_distance || Result().index < start_.index);
  }

  QUATRO_SIMD_INLINE void LookAt(const Tile& tile) {
    for (int piece = 0; piece < kNumPieces; ++piece) {
      Float sum = {};  // Equation (1).
#pragma GCC unroll 33
      for (int d = 0; d < kFpfhSize; ++d) {
        const Float difference =
            Piece<kBytes>(tile.bins[d], piece) - descriptor_[d];
        sum += difference * difference;
      }
      const Int index = Piece<kBytes>(tile.index, piece);
      // One comparison per choice, because GCC would compute more of them lane
      // by lane.
      const Int lower = index < best_index_[piece] ? index : best_index_[piece];
      const Int of_equals = sum == best_[piece] ? lower : best_index_[piece];
      best_index_[piece] = sum < best_[piece] ? index : of_equals;
      best_[piece] = sum < best_[piece] ? sum : best_[piece];
    }
  }

  const float* descriptor_;
  const float* coordinates_;
  float squared_length_;  // Squared norm of the query's V x.
  NearestDescriptor start_;
  bool any_;
  bool is_done_;  // The search has ended.
  std::size_t nearest_box_;

  Float best_[kNumPieces];  // Squared distance per lane.
  Int best_index_[kNumPieces];
  float least_;  // The smallest of best_.
  float limit_;  // The square of the right side of (3).
};

// Searches for up to kLanes queries box by box, so that a box stays in the
// cache.
template <int kBytes>
QUATRO_SIMD_INLINE void Find(const DescriptorIndex::Parts& parts,
                             bool any,
                             std::span<DescriptorQuery> queries) {
  Search<kBytes> searches[kLanes];
  std::uint32_t bits[kLanes];
  for (std::size_t q = 0; q < queries.size(); ++q) {
    searches[q].Start(parts, queries[q], any);
  }
  for (std::size_t k = 0; k < parts.large_boxes.size(); ++k) {
    std::uint32_t any_bits = 0;
    for (std::size_t q = 0; q < queries.size(); ++q) {
      bits[q] = searches[q].Choose(parts, k);
      any_bits |= bits[q];
    }
    for (; any_bits != 0; any_bits &= any_bits - 1) {
      const auto lane = static_cast<std::uint32_t>(std::countr_zero(any_bits));
      for (std::size_t q = 0; q < queries.size(); ++q) {
        if (bits[q] >> lane & 1) searches[q].GoOn(parts, k * kLanes + lane);
      }
    }
  }
  for (std::size_t q = 0; q < queries.size(); ++q) {
    queries[q].best = searches[q].Result();
  }
}

QUATRO_SIMD_AVX512 void FindByAvx512(const DescriptorIndex::Parts& parts,
                                     bool any,
                                     std::span<DescriptorQuery> queries) {
  Find<64>(parts, any, queries);
}

QUATRO_SIMD_AVX2 void FindByAvx2(const DescriptorIndex::Parts& parts,
                                 bool any,
                                 std::span<DescriptorQuery> queries) {
  Find<32>(parts, any, queries);
}

}  // namespace

DescriptorAxes FindAxes(const Fpfh& a, const Fpfh& b) {
  using Matrix = Eigen::Matrix<double, kFpfhSize, kFpfhSize>;
  constexpr Eigen::Index kNumSamples = 1000;  // For each side.
  DescriptorAxes axes;
  Matrix products = Matrix::Zero();
  Eigen::Matrix<double, kFpfhSize, 1> sum =
      Eigen::Matrix<double, kFpfhSize, 1>::Zero();
  float largest = 0.0f;  // The largest squared length.
  int num = 0;
  for (const Fpfh* side : {&a, &b}) {
    const Eigen::Index step =
        std::max<Eigen::Index>(1, side->cols() / kNumSamples);
    for (Eigen::Index i = 0; i < side->cols(); ++i) {
      if (!IsDescriptor(*side, i)) continue;
      largest = std::max(largest, side->col(i).squaredNorm());
      if (i % step != 0) continue;
      const Eigen::Matrix<double, kFpfhSize, 1> x = side->col(i).cast<double>();
      products.selfadjointView<Eigen::Lower>().rankUpdate(x);
      sum += x;
      ++num;
    }
  }
  // Larger squares could overflow. Without directions nothing is skipped, which
  // is still exact.
  if (num == 0 || !(largest < 1e30f)) return axes;
  products.selfadjointView<Eigen::Lower>().rankUpdate(sum, -1.0 / num);
  axes.directions = Eigen::SelfAdjointEigenSolver<Matrix>(products)
                        .eigenvectors()
                        .rightCols<kNumAxes>()
                        .transpose()
                        .cast<float>();
  axes.margin = 4e-5f * std::sqrt(largest);
  axes.squared_margin = 8e-6f * largest;
  return axes;
}

DescriptorIndex::DescriptorIndex(const Fpfh& descriptors,
                                 const DescriptorAxes& axes)
    : coordinates_(axes.directions * descriptors) {
  const Eigen::Index n = descriptors.cols();
  for (Eigen::Index i = 0; i < n; ++i) {
    if (!IsDescriptor(descriptors, i)) continue;
    order_.push_back(static_cast<std::int32_t>(i));
  }
  SplitInHalves(coordinates_, order_.data(), order_.data() + order_.size());

  const std::size_t num_tiles = (order_.size() + kLanes - 1) / kLanes;
  const std::size_t num_boxes = (num_tiles + kLanes - 1) / kLanes;
  parts_.margin = axes.margin;
  parts_.squared_margin = axes.squared_margin;
  parts_.tiles = ZeroedVector<Tile>(num_tiles);
  parts_.tiles_along = ZeroedVector<TileAlong>(num_tiles);
  parts_.tile_boxes = EmptyBoxes(num_tiles);
  parts_.large_boxes = EmptyBoxes(num_boxes);
  for (std::size_t box = 0; box < num_boxes; ++box) {
    Corner box_low = Corner::Constant(kInfinity);
    Corner box_high = -box_low;
    const std::size_t end = std::min(num_tiles, (box + 1) * kLanes);
    for (std::size_t t = box * kLanes; t < end; ++t) {
      Corner low = Corner::Constant(kInfinity);
      Corner high = -low;
      Tile& tile = parts_.tiles[t];
      DescriptorIndex::TileAlong& along = parts_.tiles_along[t];
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const std::size_t at = t * kLanes + lane;
        if (at >= order_.size()) {
          for (FloatRow& row : tile.bins) row.lane[lane] = kInfinity;
          for (FloatRow& row : along.axis) row.lane[lane] = 0.0f;
          along.squared_length.lane[lane] = kInfinity;
          tile.index.lane[lane] = kNone;
          continue;
        }
        const std::int32_t i = order_[at];
        for (int d = 0; d < kFpfhSize; ++d) {
          tile.bins[d].lane[lane] = descriptors(d, i);
        }
        for (int axis = 0; axis < kNumAxes; ++axis) {
          along.axis[axis].lane[lane] = coordinates_(axis, i);
        }
        along.squared_length.lane[lane] = coordinates_.col(i).squaredNorm();
        tile.index.lane[lane] = i;
        low = low.min(coordinates_.col(i).array());
        high = high.max(coordinates_.col(i).array());
      }
      SetBox(t, low, high, &parts_.tile_boxes);
      box_low = box_low.min(low);
      box_high = box_high.max(high);
    }
    SetBox(box, box_low, box_high, &parts_.large_boxes);
  }
}

void DescriptorIndex::FindNearer(bool any,
                                 SimdLevel level,
                                 std::span<DescriptorQuery> queries) const {
  while (!queries.empty()) {
    const auto some =
        queries.first(std::min<std::size_t>(kLanes, queries.size()));
    queries = queries.subspan(some.size());
    switch (level) {
      case SimdLevel::kAvx512:
        FindByAvx512(parts_, any, some);
        break;
      case SimdLevel::kAvx2:
        FindByAvx2(parts_, any, some);
        break;
      case SimdLevel::kBaseline:
        Find<16>(parts_, any, some);
        break;
    }
  }
}

}  // namespace quatro
