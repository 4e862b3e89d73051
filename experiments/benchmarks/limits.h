// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// What a machine can do at best, to measure stages against in the same run.
//
// PairTestLimit: the length test of every pair of matches, once each and into
// bits, as a loop can do it that has nothing else to do,
//
//   | |p_i - p_j| - |q_i - q_j| | <= bound,   j < i,                       (1)
//
// in single precision and, with a^2, b^2 the squared lengths and c the bound,
// without roots:
//
//   s |s| <= 4 a^2 b^2,   s = a^2 + b^2 - c^2.                             (2)
//
// Memory is allocated and written to before: what a graph costs beyond this is
// its allocation, the other half of its rows, and how well it is written.

#ifndef QUATRO_EXPERIMENTS_BENCHMARKS_LIMITS_H_
#define QUATRO_EXPERIMENTS_BENCHMARKS_LIMITS_H_

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "features/base/lanes.h"
#include "features/base/simd.h"
#include "features/base/types.h"

namespace quatro {

class PairTestLimit {
 public:
  // `bound` [m]. Sizes must agree.
  PairTestLimit(const PointsRef& source, const PointsRef& target, double bound);

  // `level` no more than BestSimdLevel().
  void Run(SimdLevel level);

  // Of the last run; j < i.
  bool IsConsistent(Eigen::Index i, Eigen::Index j) const;

  // Of all rows, both halves: what a graph of bits needs.
  std::size_t num_bytes() const { return bits_.size() * sizeof(bits_[0]); }

  struct Coordinates {
    FloatRow p[3], q[3];
  };

 private:
  std::vector<Coordinates> rows_;    // 16 matches each; NaN beyond the last.
  std::size_t words_per_match_ = 0;  // Of 32 bits, even.
  std::vector<std::uint32_t> bits_;
  float squared_bound_ = 0.0f;
};

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_BENCHMARKS_LIMITS_H_
