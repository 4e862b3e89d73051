// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The tests of a consistency graph on 64 x 64 pairs at once, without square
// roots. In units of the bound, with a and b the lengths of the two offsets,
//
//   |a - b| <= 1   <=>   (a^2 - b^2)^2 <= (a + b)^2
//                  <=>   t <= 2 a b,   t = (a^2 - b^2)^2 - (a^2 + b^2)
//                  <=>   t |t| <= 4 a^2 b^2.                               (1)
//
// Squaring costs no accuracy: the difference of squares has about the same
// relative rounding error as the difference of lengths. The test of the heights
// is
//
//   h <= max(a, b) sin(tilt)   <=>   h |h| <= max(a^2, b^2) sin^2(tilt),   (2)
//
// with h = |a_z - b_z| - 1.

#ifndef QUATRO_ROBUST_GRAPH_PAIR_TESTS_H_
#define QUATRO_ROBUST_GRAPH_PAIR_TESTS_H_

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "features/base/simd.h"
#include "robust/graph/consistency_test.h"

namespace quatro {

constexpr std::size_t kPairBlockSize = 64;

// A block of matches, coordinate by coordinate, in units of the bound.
struct alignas(64) PairBlock {
  float p[3][kPairBlockSize];
  float q[3][kPairBlockSize];
};

// The blocks of all matches. The padding of the last block passes no test.
std::vector<PairBlock> MakePairBlocks(const Eigen::Matrix3Xf& source,
                                      const Eigen::Matrix3Xf& target);

// Bit k of word i: whether match i of `rows` and match k of `columns` are
// consistent. The result is the same at every `level`, which must be at most
// BestSimdLevel(). `sin_tilt` is used only by kPlanarAndHeight.
struct PairBits {
  std::uint64_t row[kPairBlockSize];
};
PairBits TestPairBlocks(ConsistencyTest test,
                        const PairBlock& rows,
                        const PairBlock& columns,
                        float sin_tilt,
                        SimdLevel level);

// The transposed block: bit k of word i becomes bit i of word k.
PairBits Transposed(const PairBits& bits);

}  // namespace quatro

#endif  // QUATRO_ROBUST_GRAPH_PAIR_TESTS_H_
