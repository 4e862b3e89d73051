// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The tests of a consistency graph on 64 x 64 pairs at once, without roots. In
// units of the bound, with a and b the lengths of the two offsets,
//
//   |a - b| <= 1   <=>   (a^2 - b^2)^2 <= (a + b)^2
//                  <=>   t <= 2 a b,   t = (a^2 - b^2)^2 - (a^2 + b^2)
//                  <=>   t |t| <= 4 a^2 b^2.                               (1)
//
// The difference of squares is off by rounding as much as that of the lengths
// is, 1e-7 of them: nothing is lost to the powers. So with the heights,
//
//   h <= max(a, b) sin(tilt)   <=>   h |h| <= max(a^2, b^2) sin^2(tilt),   (2)
//
// h = |a_z - b_z| - 1.

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

// So many matches, coordinate by coordinate, in units of the bound.
struct alignas(64) PairBlock {
  float p[3][kPairBlockSize];
  float q[3][kPairBlockSize];
};

// Those of all matches. What fills the last block passes no test.
std::vector<PairBlock> MakePairBlocks(const Eigen::Matrix3Xf& source,
                                      const Eigen::Matrix3Xf& target);

// Bit k of word i: whether match i of `rows` and match k of `columns` pass. The
// same at every `level`, no more than BestSimdLevel(). `sin_tilt` is for
// kPlanarAndHeight.
struct PairBits {
  std::uint64_t row[kPairBlockSize];
};
PairBits TestPairBlocks(ConsistencyTest test,
                        const PairBlock& rows,
                        const PairBlock& columns,
                        float sin_tilt,
                        SimdLevel level);

// Bit k of word i becomes bit i of word k.
PairBits Transposed(const PairBits& bits);

}  // namespace quatro

#endif  // QUATRO_ROBUST_GRAPH_PAIR_TESTS_H_
