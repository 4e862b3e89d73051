// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// What the tests of estimators in SE(3) share: problems and expectations.

#ifndef QUATRO_TESTS_SUPPORT_POSE_PROBLEMS_H_
#define QUATRO_TESTS_SUPPORT_POSE_PROBLEMS_H_

#include <gtest/gtest.h>

#include <cstdint>

#include "robust/estimators/pose_summary.h"
#include "tests/support/matched_problems.h"
#include "tests/support/random_problems.h"

namespace quatro {

// Turned anyhow, not about z alone.
inline KnownProblem TurnedProblem(Eigen::Index num_inliers,
                                  Eigen::Index num_outliers,
                                  std::uint64_t seed) {
  KnownProblem problem =
      MakeMatchedProblem({.num_inliers = num_inliers,
                          .num_outliers = num_outliers,
                          .half_widths = Eigen::Vector3d::Constant(30.0)},
                         seed);
  const Rigid3 turn{RandomRotation(seed), {1.0, 2.0, 3.0}};
  problem.true_target_from_source = turn * problem.true_target_from_source;
  problem.target = turn.Apply(problem.target);
  return problem;
}

// The farthest that an answer takes a point from where it should be [m].
inline double PoseError(const PoseSummary& summary,
                        const KnownProblem& problem) {
  return LargestDisplacement(*summary.target_from_source,
                             problem.true_target_from_source,
                             problem.source);
}

inline void ExpectNoAnswer(const PoseSummary& summary,
                           PoseTermination termination) {
  EXPECT_EQ(summary.termination, termination) << summary.message;
  EXPECT_FALSE(summary.IsUsable());
  EXPECT_TRUE(summary.translation_inliers.empty());
  EXPECT_FALSE(summary.message.empty());
}

}  // namespace quatro

#endif  // QUATRO_TESTS_SUPPORT_POSE_PROBLEMS_H_
