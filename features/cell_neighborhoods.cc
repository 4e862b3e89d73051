// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/cell_neighborhoods.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "features/base/lanes.h"
#include "features/base/parallel.h"
#include "features/cells.h"

namespace quatro {
namespace {

// Sorts in ascending order. Uses a bit set if the indices are dense, as they
// are in a sampled cloud.
void Sort(std::vector<std::int32_t>* indices,
          std::vector<std::uint64_t>* bits) {
  const auto [least, largest] =
      std::minmax_element(indices->begin(), indices->end());
  const std::int32_t first = *least;
  const auto num_words = static_cast<std::size_t>(*largest - first) / 64 + 1;
  if (num_words > 8 * indices->size()) {
    std::sort(indices->begin(), indices->end());
    return;
  }
  bits->assign(num_words, 0);
  for (const std::int32_t i : *indices) {
    const auto at = static_cast<std::size_t>(i - first);
    (*bits)[at / 64] |= std::uint64_t{1} << (at % 64);
  }
  std::size_t k = 0;
  for (std::size_t w = 0; w < num_words; ++w) {
    for (std::uint64_t word = (*bits)[w]; word != 0; word &= word - 1) {
      (*indices)[k++] =
          first + static_cast<std::int32_t>(w * 64) + std::countr_zero(word);
    }
  }
}

// Sixteen points, one per lane.
struct alignas(64) Block {
  double x[kLanes], y[kLanes], z[kLanes];
  std::int32_t index[kLanes];
};

using Room = NeighborhoodsBuilder::Writer::Room;

// Writes the points of the blocks within the radius of `query` to `room`, which
// has space for all of them. Returns their number.
template <int kBytes>
QUATRO_SIMD_INLINE std::size_t Choose(const std::vector<Block>& blocks,
                                      const double* query,
                                      double squared_radius,
                                      const Room& room) {
  using Double = typename Lanes<kBytes>::Double;
  using Int = typename Lanes<kBytes>::Int;
  constexpr int kDoubles = kBytes / 8;
  std::size_t size = 0;
  for (const Block& block : blocks) {
    alignas(64) double d2[kLanes];
    Int passed = {};
    for (int piece = 0; piece < kLanes / kDoubles; ++piece) {
      const auto load = [piece](const double* from)
                            __attribute__((always_inline))
                                ->const Double& {
        return reinterpret_cast<const Double*>(from)[piece];
      };
      const Double dx = query[0] - load(block.x);
      const Double dy = query[1] - load(block.y);
      const Double dz = query[2] - load(block.z);
      const Double sum = dx * dx + dy * dy + dz * dz;
      reinterpret_cast<Double*>(d2)[piece] = sum;
      typename Lanes<kBytes>::Long weight{};
      for (int lane = 0; lane < kDoubles; ++lane) {
        weight[lane] = 1 << (piece * kDoubles + lane);
      }
      passed |= reinterpret_cast<Int>((sum <= squared_radius) & weight);
    }
    for (auto bits = static_cast<std::uint32_t>(OrOf<kBytes>(passed));
         bits != 0;
         bits &= bits - 1) {
      const int lane = std::countr_zero(bits);
      room.index[size] = block.index[lane];
      room.squared_distance[size] = static_cast<float>(d2[lane]);
      ++size;
    }
  }
  return size;
}

QUATRO_SIMD_AVX512 std::size_t ChooseByAvx512(const std::vector<Block>& blocks,
                                              const double* query,
                                              double squared_radius,
                                              const Room& room) {
  return Choose<64>(blocks, query, squared_radius, room);
}

QUATRO_SIMD_AVX2 std::size_t ChooseByAvx2(const std::vector<Block>& blocks,
                                          const double* query,
                                          double squared_radius,
                                          const Room& room) {
  return Choose<32>(blocks, query, squared_radius, room);
}

std::size_t Choose(const std::vector<Block>& blocks,
                   const double* query,
                   double squared_radius,
                   SimdLevel level,
                   const Room& room) {
  switch (level) {
    case SimdLevel::kAvx512:
      return ChooseByAvx512(blocks, query, squared_radius, room);
    case SimdLevel::kAvx2:
      return ChooseByAvx2(blocks, query, squared_radius, room);
    case SimdLevel::kBaseline:
      break;
  }
  return Choose<16>(blocks, query, squared_radius, room);
}

std::vector<Block> MakeBlocks(const Points& points,
                              const std::vector<std::int32_t>& indices) {
  std::vector<Block> blocks((indices.size() + kLanes - 1) / kLanes);
  for (std::size_t k = 0; k < blocks.size() * kLanes; ++k) {
    Block& block = blocks[k / kLanes];
    const std::size_t lane = k % kLanes;
    // The last block is padded with NaN, which is within no radius.
    block.x[lane] = block.y[lane] = block.z[lane] = std::nan("");
    if (k >= indices.size()) continue;
    block.index[lane] = indices[k];
    block.x[lane] = points(0, indices[k]);
    block.y[lane] = points(1, indices[k]);
    block.z[lane] = points(2, indices[k]);
  }
  return blocks;
}

}  // namespace

std::optional<Neighborhoods> FindNeighborhoodsByCells(const Points& points,
                                                      double radius,
                                                      int num_threads,
                                                      SimdLevel level) {
  const std::optional<Cells> cells = Cells::Make(points, radius);
  if (!cells) return std::nullopt;
  NeighborhoodsBuilder builder(points.cols());
  const auto find = [&](Eigen::Index begin, Eigen::Index end) {
    NeighborhoodsBuilder::Writer writer(&builder);
    Cells::Walk walk(*cells);
    std::vector<std::int32_t> near;
    std::vector<std::uint64_t> bits;
    for (Eigen::Index c = begin; c < end; ++c) {
      const Cells::Cell& cell = cells->cells()[static_cast<std::size_t>(c)];
      walk.FindNear(cell.key, &near);
      Sort(&near, &bits);
      const std::vector<Block> blocks = MakeBlocks(points, near);
      for (std::size_t k = cell.begin; k < cell.end; ++k) {
        const std::int32_t i = cells->order()[k];
        const Room room = writer.MakeRoom(blocks.size() * kLanes);
        writer.Add(
            i,
            Choose(blocks, points.col(i).data(), radius * radius, level, room));
      }
    }
  };
  ParallelFor(
      num_threads, static_cast<Eigen::Index>(cells->cells().size()), 32, find);
  return std::move(builder).Finish();
}

}  // namespace quatro
