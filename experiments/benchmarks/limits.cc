// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/benchmarks/limits.h"

#include <glog/logging.h>

#include <limits>

namespace quatro {
namespace {

using Coordinates = PairTestLimit::Coordinates;

constexpr std::size_t kWordBits = 32;
constexpr std::size_t kRowsPerWord = kWordBits / kLanes;

// Tests the 16 matches of `row` against matches [32 `word`, 32 `word` + 32) and
// writes one word of bits per match of `row`. The lanes of `row` are processed
// at once, the other matches one by one.
template <int kBytes>
QUATRO_SIMD_INLINE void TestTile(const Coordinates* rows,
                                 std::size_t word,
                                 std::size_t row,
                                 float squared_bound,
                                 std::size_t words_per_match,
                                 std::uint32_t* bits) {
  using Float = typename Lanes<kBytes>::Float;
  using Int = typename Lanes<kBytes>::Int;
  for (int piece = 0; piece < Lanes<kBytes>::kNumPieces; ++piece) {
    Float p[3], q[3];
    for (int axis = 0; axis < 3; ++axis) {
      p[axis] = Piece<kBytes>(rows[row].p[axis], piece);
      q[axis] = Piece<kBytes>(rows[row].q[axis], piece);
    }
    Int found = {};
    for (std::size_t k = 0; k < kWordBits; ++k) {
      const Coordinates& other = rows[word * kRowsPerWord + k / kLanes];
      const std::size_t lane = k % kLanes;
      const Float ax = p[0] - other.p[0].lane[lane];
      const Float ay = p[1] - other.p[1].lane[lane];
      const Float az = p[2] - other.p[2].lane[lane];
      const Float bx = q[0] - other.q[0].lane[lane];
      const Float by = q[1] - other.q[1].lane[lane];
      const Float bz = q[2] - other.q[2].lane[lane];
      const Float a2 = ax * ax + ay * ay + az * az;
      const Float b2 = bx * bx + by * by + bz * bz;
      // Equation (2).
      const Float s = a2 + b2 - squared_bound;
      const Float magnitude = s < 0.0f ? -s : s;
      const Int passes = s * magnitude <= 4.0f * a2 * b2;
      found |= passes & static_cast<std::int32_t>(std::uint32_t{1} << k);
    }
    for (int lane = 0; lane < Lanes<kBytes>::kPieceLanes; ++lane) {
      const auto match =
          row * kLanes +
          static_cast<std::size_t>(piece * Lanes<kBytes>::kPieceLanes + lane);
      bits[match * words_per_match + word] =
          static_cast<std::uint32_t>(found[lane]);
    }
  }
}

template <int kBytes>
QUATRO_SIMD_INLINE void TestPairs(const Coordinates* rows,
                                  std::size_t num_rows,
                                  float squared_bound,
                                  std::size_t words_per_match,
                                  std::uint32_t* bits) {
  for (std::size_t row = 0; row < num_rows; ++row) {
    for (std::size_t word = 0; word <= row / kRowsPerWord; ++word) {
      TestTile<kBytes>(rows, word, row, squared_bound, words_per_match, bits);
    }
  }
}

void TestPairsBaseline(const Coordinates* rows,
                       std::size_t num_rows,
                       float squared_bound,
                       std::size_t words_per_match,
                       std::uint32_t* bits) {
  TestPairs<16>(rows, num_rows, squared_bound, words_per_match, bits);
}

QUATRO_SIMD_AVX2 void TestPairsAvx2(const Coordinates* rows,
                                    std::size_t num_rows,
                                    float squared_bound,
                                    std::size_t words_per_match,
                                    std::uint32_t* bits) {
  TestPairs<32>(rows, num_rows, squared_bound, words_per_match, bits);
}

QUATRO_SIMD_AVX512 void TestPairsAvx512(const Coordinates* rows,
                                        std::size_t num_rows,
                                        float squared_bound,
                                        std::size_t words_per_match,
                                        std::uint32_t* bits) {
  TestPairs<64>(rows, num_rows, squared_bound, words_per_match, bits);
}

}  // namespace

PairTestLimit::PairTestLimit(const PointsRef& source,
                             const PointsRef& target,
                             double bound)
    : squared_bound_(static_cast<float>(bound * bound)) {
  CHECK_EQ(source.cols(), target.cols());
  const auto n = static_cast<std::size_t>(source.cols());
  // An even number, because the rows of a Graph consist of 64-bit words.
  const std::size_t num_words = (n + kWordBits - 1) / kWordBits;
  words_per_match_ = num_words + num_words % 2;
  rows_.resize(num_words * kRowsPerWord);
  bits_.resize(rows_.size() * kLanes * words_per_match_);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t i = 0; i < rows_.size() * kLanes; ++i) {
    Coordinates& row = rows_[i / kLanes];
    const auto column = static_cast<Eigen::Index>(i);
    for (int axis = 0; axis < 3; ++axis) {
      row.p[axis].lane[i % kLanes] =
          i < n ? static_cast<float>(source(axis, column)) : nan;
      row.q[axis].lane[i % kLanes] =
          i < n ? static_cast<float>(target(axis, column)) : nan;
    }
  }
}

void PairTestLimit::Run(SimdLevel level) {
  const auto test = level == SimdLevel::kAvx512 ? TestPairsAvx512
                    : level == SimdLevel::kAvx2 ? TestPairsAvx2
                                                : TestPairsBaseline;
  test(rows_.data(),
       rows_.size(),
       squared_bound_,
       words_per_match_,
       bits_.data());
}

bool PairTestLimit::IsConsistent(Eigen::Index i, Eigen::Index j) const {
  const auto row = static_cast<std::size_t>(i) * words_per_match_;
  const auto bit = static_cast<std::size_t>(j);
  return (bits_[row + bit / kWordBits] >> (bit % kWordBits)) & 1u;
}

}  // namespace quatro
