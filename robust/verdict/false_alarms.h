// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// How often chance alone would give a consensus as good as the one chosen.
//
// A consensus is doubted until chance is ruled out as its cause: k of n
// candidates agree, where each would do so by accident with probability p, and
// T consensus sets could have been chosen. The number of false alarms,
//
//   NFA = T * P[ Binomial(n, p) >= k ],                                    (1)
//
// bounds the expected number of sets this good among things that have nothing
// to do with each other. At the stages where one is chosen,
//
//                T                  n      k           p
//   clique       N (N - 1) / 2 * e  N - 2  size - 2    e^2
//   rotation     K                  K - 1  inliers - 1 mean arc / circle
//   pose         N (N - 1) / 2      N - 2  inliers - 2 c
//
// since two matches seed a clique and a pose on the ground, and one difference
// a yaw. All rates are measured on the spot: e is the share of pairs of matches
// that are consistent, c that of matches that agree with the pose, once sources
// and targets are matched at random; that accounts for what all scenes share:
// everything lies near one plane, dense near the sensor, and crowded on few
// surfaces. Matches count as independent, which those of neighbouring points
// are not: small numbers are smaller than they should be.
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

// How many consensuses like this one chance would give, at one stage.
struct FalseAlarms {
  std::string stage;             // "clique", "rotation" or "pose".
  Eigen::Index num_tested = 0;   // N or K
  Eigen::Index num_inliers = 0;  // Of these.
  double chance = 0.0;           // p
  double log10_false_alarms = 0.0;
};

// Columns are matches, each there once. `noise_bound` [m].
//
// Nullopt if the `consistent` of them are no clique by the length of their
// differences, |a| and |b| within twice the bound, or fewer than two.
std::optional<FalseAlarms> CliqueFalseAlarms(const PointsRef& source,
                                             const PointsRef& target,
                                             const PointsRef& consistent_source,
                                             const PointsRef& consistent_target,
                                             double noise_bound);

// Of the differences between neighbours in a ring of the consistent matches,
// about the vertical, within twice the bound. Nullopt if no difference depends
// on the yaw.
std::optional<FalseAlarms> RotationFalseAlarms(
    const PointsRef& consistent_source,
    const PointsRef& consistent_target,
    const Rigid3& target_from_source,
    double noise_bound);

// Matches agree with |q_i - (R p_i + t)| <= noise_bound on each axis.
FalseAlarms PoseFalseAlarms(const PointsRef& source,
                            const PointsRef& target,
                            const Rigid3& target_from_source,
                            double noise_bound);

// log10 P[ Binomial(n, p) >= k ].
double Log10BinomialTail(Eigen::Index n, Eigen::Index k, double p);

}  // namespace quatro

#endif  // QUATRO_ROBUST_VERDICT_FALSE_ALARMS_H_
