// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The best performance of the machine, for comparison with the stages of the
// same run.
//
// PairTestLimit applies the length test to every pair of matches once and
// stores the results as bits, in a loop that does nothing else:
//
//   | |p_i - p_j| - |q_i - q_j| | <= bound,   j < i,                       (1)
//
// in single precision. With the squared lengths a^2, b^2 and the bound c, it
// needs no square roots:
//
//   s |s| <= 4 a^2 b^2,   s = a^2 + b^2 - c^2.                             (2)
//
// Memory is allocated and written to before the measurement. A graph costs more
// than this because of its allocation, the other half of its rows, and its
// implementation.

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
  // `bound` [m]. Source and target must have the same size.
  PairTestLimit(const PointsRef& source, const PointsRef& target, double bound);

  // `level` must not exceed BestSimdLevel().
  void Run(SimdLevel level);

  // The result of the last run; j < i.
  bool IsConsistent(Eigen::Index i, Eigen::Index j) const;

  // The size of all rows of both halves, which a graph stored as bits needs.
  std::size_t num_bytes() const { return bits_.size() * sizeof(bits_[0]); }

  struct Coordinates {
    FloatRow p[3], q[3];
  };

 private:
  std::vector<Coordinates> rows_;    // 16 matches each, padded with NaN.
  std::size_t words_per_match_ = 0;  // Words of 32 bits; even.
  std::vector<std::uint32_t> bits_;
  float squared_bound_ = 0.0f;
};

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_BENCHMARKS_LIMITS_H_
