// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// How often chance alone would produce a consensus as large as the one found.
//
// A consensus counts as meaningful only if chance is ruled out as its cause.
// Let k of n candidates be inliers, each by accident with probability p, and
// let T be the number of consensus sets that could have been chosen. The number
// of false alarms,
//
//   NFA = T * P[ Binomial(n, p) >= k ],                                    (1)
//
// bounds the expected number of consensus sets of this size among unrelated
// data. At the stages that choose a consensus,
//
//                T                  n      k           p
//   clique       N (N - 1) / 2 * e  N - 2  size - 2    e^2
//   rotation     K                  K - 1  inliers - 1 mean arc / circle
//   pose         N (N - 1) / 2      N - 2  inliers - 2 c
//
// since two matches determine a seed of a clique or a pose on the ground, and
// one difference a yaw. The probabilities are measured on the data: e is the
// share of pairs of matches that are consistent, and c the share of matches
// that are inliers of the pose, after pairing sources and targets at random.
// This accounts for the structure that all scenes share: points are near one
// plane, dense near the sensor, and concentrated on few surfaces. Matches are
// assumed to be independent, but those of neighboring points are not, so small
// values of NFA are too small.
//
// Source: Desolneux, Moisan and Morel, "From Gestalt Theory to Image Analysis",
// 2008; Moisan and Stival, "A Probabilistic Criterion to Detect Rigid Point
// Matches Between Two Images and Estimate the Fundamental Matrix", IJCV 2004.

#ifndef QUATRO_ROBUST_VERDICT_FALSE_ALARMS_H_
#define QUATRO_ROBUST_VERDICT_FALSE_ALARMS_H_

#include <Eigen/Core>
#include <optional>
#include <string>

#include "features/base/rigid3.h"
#include "features/base/types.h"

namespace quatro {

// The number of false alarms at one stage.
struct FalseAlarms {
  std::string stage;             // "clique", "rotation" or "pose".
  Eigen::Index num_tested = 0;   // N or K
  Eigen::Index num_inliers = 0;  // Among num_tested.
  double chance = 0.0;           // p
  double log10_false_alarms = 0.0;
};

// Columns are matches without duplicates. Differences are consistent if their
// lengths differ by at most 2 * `noise_bound` [m].
//
// Returns nullopt if the `consistent` matches do not form a clique by that
// test, or if there are fewer than two.
std::optional<FalseAlarms> CliqueFalseAlarms(const PointsRef& source,
                                             const PointsRef& target,
                                             const PointsRef& consistent_source,
                                             const PointsRef& consistent_target,
                                             double noise_bound);

// Tests the differences between neighbors in a ring of the consistent matches:
// a difference is an inlier of the yaw if its planar error is at most 2 *
// `noise_bound` [m]. Returns nullopt if no difference depends on the yaw.
std::optional<FalseAlarms> RotationFalseAlarms(
    const PointsRef& consistent_source,
    const PointsRef& consistent_target,
    const Rigid3& target_from_source,
    double noise_bound);

// A match is an inlier if |q_i - (R p_i + t)| <= `noise_bound` on each axis
// (half the edge of a box) [m].
FalseAlarms PoseFalseAlarms(const PointsRef& source,
                            const PointsRef& target,
                            const Rigid3& target_from_source,
                            double noise_bound);

// log10 P[ Binomial(n, p) >= k ].
double Log10BinomialTail(Eigen::Index n, Eigen::Index k, double p);

}  // namespace quatro

#endif  // QUATRO_ROBUST_VERDICT_FALSE_ALARMS_H_
