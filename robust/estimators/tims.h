// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Translation-invariant measurements (TIMs): differences of matched points,
//
//   alpha_k = p_a - p_b,   beta_k = q_a - q_b,   beta_k = R alpha_k + noise,
//
// which depend on the rotation but not on the translation. The layout defines
// the pairs (a, b).

#ifndef QUATRO_ROBUST_ESTIMATORS_TIMS_H_
#define QUATRO_ROBUST_ESTIMATORS_TIMS_H_

#include <Eigen/Core>
#include <cstdint>
#include <utility>
#include <vector>

#include "features/base/types.h"

namespace quatro {

// The pairs of points whose differences are used.
enum class TimLayout {
  kRing,      // Each point with the previous one, cyclically: N pairs.
  kComplete,  // All N (N - 1) / 2 pairs.
  kRandom,    // num_random pairs a != b, drawn with replacement.
};

// Columns (a, b) of the two points; the difference is a minus b.
using TimPair = std::pair<Eigen::Index, Eigen::Index>;

// The pairs (a, b) among `num_points`. In a ring, two points give one pair, not
// the same pair twice. Fewer than two points give none. Only kRandom uses
// `num_random` and `seed`.
std::vector<TimPair> MakeTimPairs(Eigen::Index num_points,
                                  TimLayout layout,
                                  Eigen::Index num_random,
                                  std::uint64_t seed);

// The differences, one column for each pair.
Points ComputeTims(const PointsRef& points, const std::vector<TimPair>& pairs);

// For each of `num_points`, the largest weight of the pairs that it is part of,
// or 0 if there are none. `weights` has one weight in [0, 1] for each pair.
std::vector<double> WeighPoints(const std::vector<TimPair>& pairs,
                                const Eigen::VectorXd& weights,
                                Eigen::Index num_points);

}  // namespace quatro

#endif  // QUATRO_ROBUST_ESTIMATORS_TIMS_H_
