// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/graph/pair_tests.h"

#include <limits>

#include "features/base/lanes.h"

namespace quatro {
namespace {

constexpr std::size_t kSize = kPairBlockSize;
constexpr std::size_t kHalf = kSize / 2;

template <int kBytes>
QUATRO_SIMD_INLINE void MakeAbsolute(typename Lanes<kBytes>::Float* x) {
  using Int = typename Lanes<kBytes>::Int;
  Int* bits = reinterpret_cast<Int*>(x);
  *bits &= 0x7fffffff;
}

// Whether pairs with these offsets pass. In each lane all bits are set or none.
template <ConsistencyTest kTest, int kBytes>
QUATRO_SIMD_INLINE void Test(const typename Lanes<kBytes>::Float (&a)[3],
                             const typename Lanes<kBytes>::Float (&b)[3],
                             float squared_sin_tilt,
                             typename Lanes<kBytes>::Int* passes) {
  using Float = typename Lanes<kBytes>::Float;
  Float a2 = a[0] * a[0] + a[1] * a[1];
  Float b2 = b[0] * b[0] + b[1] * b[1];
  if constexpr (kTest == ConsistencyTest::kLength) {
    a2 += a[2] * a[2];
    b2 += b[2] * b[2];
  }
  const Float difference = a2 - b2;
  const Float t = difference * difference - (a2 + b2);
  Float magnitude = t;
  MakeAbsolute<kBytes>(&magnitude);
  // If the powers overflow, only equal lengths pass.
  constexpr float kLargest = std::numeric_limits<float>::max();
  const Float product = 4.0f * (a2 * b2);
  const Float largest = Float{} + kLargest;
  *passes = t * magnitude <= (product < largest ? product : largest);  // (1)
  if constexpr (kTest == ConsistencyTest::kPlanarAndHeight) {
    Float h = a[2] - b[2];
    MakeAbsolute<kBytes>(&h);
    h -= 1.0f;
    magnitude = h;
    MakeAbsolute<kBytes>(&magnitude);
    const Float longer = a2 > b2 ? a2 : b2;
    *passes &= h * magnitude <= longer * squared_sin_tilt;  // (2)
  }
}

// Tests 32 columns from `first` on, one column against all rows at a time.
template <ConsistencyTest kTest, int kBytes>
QUATRO_SIMD_INLINE void TestHalf(const PairBlock& rows,
                                 const PairBlock& columns,
                                 std::size_t first,
                                 float squared_sin_tilt,
                                 std::uint32_t (&bits)[kSize]) {
  using Float = typename Lanes<kBytes>::Float;
  using Int = typename Lanes<kBytes>::Int;
  constexpr std::size_t kNumPieces = kSize * sizeof(float) / kBytes;
  for (std::size_t piece = 0; piece < kNumPieces; ++piece) {
    Float p[3], q[3];
    for (int axis = 0; axis < 3; ++axis) {
      p[axis] = reinterpret_cast<const Float*>(rows.p[axis])[piece];
      q[axis] = reinterpret_cast<const Float*>(rows.q[axis])[piece];
    }
    Int found = {};
    for (std::size_t k = 0; k < kHalf; ++k) {
      Float a[3], b[3];
      for (int axis = 0; axis < 3; ++axis) {
        a[axis] = p[axis] - columns.p[axis][first + k];
        b[axis] = q[axis] - columns.q[axis][first + k];
      }
      Int passes;
      Test<kTest, kBytes>(a, b, squared_sin_tilt, &passes);
      found |= passes & static_cast<std::int32_t>(std::uint32_t{1} << k);
    }
    reinterpret_cast<Int*>(bits)[piece] = found;
  }
}

template <ConsistencyTest kTest, int kBytes>
QUATRO_SIMD_INLINE PairBits TestAll(const PairBlock& rows,
                                    const PairBlock& columns,
                                    float sin_tilt) {
  const float squared_sin_tilt = sin_tilt * sin_tilt;
  alignas(64) std::uint32_t low[kSize];
  alignas(64) std::uint32_t high[kSize];
  TestHalf<kTest, kBytes>(rows, columns, 0, squared_sin_tilt, low);
  TestHalf<kTest, kBytes>(rows, columns, kHalf, squared_sin_tilt, high);
  PairBits bits;
  for (std::size_t i = 0; i < kSize; ++i) {
    bits.row[i] = low[i] | static_cast<std::uint64_t>(high[i]) << kHalf;
  }
  return bits;
}

template <int kBytes>
QUATRO_SIMD_INLINE PairBits TestBlocks(ConsistencyTest test,
                                       const PairBlock& rows,
                                       const PairBlock& columns,
                                       float sin_tilt) {
  switch (test) {
    case ConsistencyTest::kPlanar:
      return TestAll<ConsistencyTest::kPlanar, kBytes>(rows, columns, sin_tilt);
    case ConsistencyTest::kPlanarAndHeight:
      return TestAll<ConsistencyTest::kPlanarAndHeight, kBytes>(
          rows, columns, sin_tilt);
    case ConsistencyTest::kLength:
      break;
  }
  return TestAll<ConsistencyTest::kLength, kBytes>(rows, columns, sin_tilt);
}

QUATRO_SIMD_AVX512 PairBits TestByAvx512(ConsistencyTest test,
                                         const PairBlock& rows,
                                         const PairBlock& columns,
                                         float sin_tilt) {
  return TestBlocks<64>(test, rows, columns, sin_tilt);
}

QUATRO_SIMD_AVX2 PairBits TestByAvx2(ConsistencyTest test,
                                     const PairBlock& rows,
                                     const PairBlock& columns,
                                     float sin_tilt) {
  return TestBlocks<32>(test, rows, columns, sin_tilt);
}

// Swaps the upper right and the lower left quarter of each square of 2 kWidth
// rows and columns.
template <std::size_t kWidth>
void SwapQuarters(std::uint64_t mask, PairBits* bits) {
  for (std::size_t square = 0; square < kSize; square += 2 * kWidth) {
    std::uint64_t* above = bits->row + square;
    std::uint64_t* below = above + kWidth;
    for (std::size_t i = 0; i < kWidth; ++i) {
      const std::uint64_t differ = ((above[i] >> kWidth) ^ below[i]) & mask;
      below[i] ^= differ;
      above[i] ^= differ << kWidth;
    }
  }
}

}  // namespace

std::vector<PairBlock> MakePairBlocks(const Eigen::Matrix3Xf& source,
                                      const Eigen::Matrix3Xf& target) {
  const auto n = static_cast<std::size_t>(source.cols());
  std::vector<PairBlock> blocks((n + kSize - 1) / kSize);
  for (std::size_t i = 0; i < blocks.size() * kSize; ++i) {
    PairBlock& block = blocks[i / kSize];
    const auto column = static_cast<Eigen::Index>(i);
    for (int axis = 0; axis < 3; ++axis) {
      constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
      block.p[axis][i % kSize] = i < n ? source(axis, column) : kNaN;
      block.q[axis][i % kSize] = i < n ? target(axis, column) : kNaN;
    }
  }
  return blocks;
}

PairBits TestPairBlocks(ConsistencyTest test,
                        const PairBlock& rows,
                        const PairBlock& columns,
                        float sin_tilt,
                        SimdLevel level) {
  switch (level) {
    case SimdLevel::kAvx512:
      return TestByAvx512(test, rows, columns, sin_tilt);
    case SimdLevel::kAvx2:
      return TestByAvx2(test, rows, columns, sin_tilt);
    case SimdLevel::kBaseline:
      break;
  }
  return TestBlocks<16>(test, rows, columns, sin_tilt);
}

PairBits Transposed(const PairBits& bits) {
  PairBits transposed = bits;
  SwapQuarters<32>(0x00000000ffffffff, &transposed);
  SwapQuarters<16>(0x0000ffff0000ffff, &transposed);
  SwapQuarters<8>(0x00ff00ff00ff00ff, &transposed);
  SwapQuarters<4>(0x0f0f0f0f0f0f0f0f, &transposed);
  SwapQuarters<2>(0x3333333333333333, &transposed);
  SwapQuarters<1>(0x5555555555555555, &transposed);
  return transposed;
}

}  // namespace quatro
