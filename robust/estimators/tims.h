// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Translation-invariant measurements: differences of matched points,
//
//   alpha_k = p_a - p_b,   beta_k = q_a - q_b,   beta_k = R alpha_k + noise,
//
// which hold the rotation and not the translation. Which pairs (a, b) are taken
// is the layout.

#ifndef QUATRO_ROBUST_ESTIMATORS_TIMS_H_
#define QUATRO_ROBUST_ESTIMATORS_TIMS_H_

#include <Eigen/Core>
#include <cstdint>
#include <utility>
#include <vector>

#include "features/base/types.h"

namespace quatro {

// Which pairs are taken.
enum class TimLayout {
  kRing,      // Each with the one before it, the first with the last: N.
  kComplete,  // All pairs: N (N - 1) / 2.
  kRandom,    // As many as asked for, a != b, drawn with replacement.
};

// Columns of the two points, the first minus the second.
using TimPair = std::pair<Eigen::Index, Eigen::Index>;

// The pairs (a, b) among `num_points`. Two points give one pair in a ring, not
// the same one twice; fewer give none. `num_random` and `seed` matter to
// kRandom alone.
std::vector<TimPair> MakeTimPairs(Eigen::Index num_points,
                                  TimLayout layout,
                                  Eigen::Index num_random,
                                  std::uint64_t seed);

// One difference per pair and column.
Points ComputeTims(const PointsRef& points, const std::vector<TimPair>& pairs);

// Of each of `num_points`, the largest weight of the pairs that it is part of;
// 0 of none. One weight a pair, in [0, 1].
std::vector<double> WeighPoints(const std::vector<TimPair>& pairs,
                                const Eigen::VectorXd& weights,
                                Eigen::Index num_points);

}  // namespace quatro

#endif  // QUATRO_ROBUST_ESTIMATORS_TIMS_H_
