// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/estimators/match_scorer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <vector>

#include "robust/estimators/consensus.h"
#include "tests/support/matched_problems.h"
#include "tests/support/random_problems.h"

namespace quatro::match_scorer_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kBound = 0.3;

// Half of the matches are inliers of the scored pose. The sizes fill less than
// one block, one block, and several blocks.
TEST(MatchScorer, CostIsTheConsensusCost) {
  for (const Eigen::Index n : {0, 1, 7, 8, 9, 63, 64, 65, 500}) {
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
      const KnownProblem problem = MakeMatchedProblem(
          {.num_inliers = n / 2, .num_outliers = n - n / 2, .noise = 0.2},
          seed);
      const MatchScorer scorer(problem.source, problem.target, kBound);
      EXPECT_EQ(scorer.num_matches(), n);
      for (const Rigid3& pose :
           {problem.true_target_from_source,
            Rigid3{RandomRotation(seed), {1.0, 2.0, 3.0}}}) {
        const double expected =
            ConsensusCost(problem.source, problem.target, pose, kBound);
        EXPECT_NEAR(scorer.Cost(pose, kInfinity),
                    expected,
                    1e-11 * static_cast<double>(n))
            << n << " matches, seed " << seed;
      }
    }
  }
}

TEST(MatchScorer, LimitShortensNoCostBelowIt) {
  const KnownProblem problem =
      MakeMatchedProblem({.num_inliers = 300, .num_outliers = 300}, 1);
  const MatchScorer scorer(problem.source, problem.target, kBound);
  const Rigid3& pose = problem.true_target_from_source;
  const double cost = scorer.Cost(pose, kInfinity);
  EXPECT_GT(cost, 300.0);
  EXPECT_EQ(scorer.Cost(pose, cost), cost);
  EXPECT_EQ(scorer.Cost(pose, cost + 1.0), cost);
  for (const double limit : {0.0, 10.0, 0.5 * cost, cost - 1e-9}) {
    EXPECT_GT(scorer.Cost(pose, limit), limit);
  }
  // The evaluation stops early.
  EXPECT_LT(scorer.Cost(pose, 10.0), 0.5 * cost);
}

TEST(MatchScorer, InliersAreInTheBall) {
  const KnownProblem problem = MakeMatchedProblem(
      {.num_inliers = 100, .num_outliers = 100, .noise = 0.4}, 2);
  const MatchScorer scorer(problem.source, problem.target, kBound);
  const Rigid3& pose = problem.true_target_from_source;
  for (const double factor : {1.0, 2.0}) {
    std::vector<Eigen::Index> expected;
    for (Eigen::Index i = 0; i < problem.source.cols(); ++i) {
      const Eigen::Vector3d moved =
          pose * Eigen::Vector3d(problem.source.col(i));
      if ((problem.target.col(i) - moved).norm() <= factor * kBound) {
        expected.push_back(i);
      }
    }
    EXPECT_FALSE(expected.empty());
    EXPECT_LT(expected.size(), 200u);
    EXPECT_EQ(scorer.Inliers(pose, factor), expected);
  }
}

TEST(MatchScorer, WhatIsNoNumberCostsAsMuchAsAnOutlier) {
  Points source = Points::Zero(3, 10);
  source(0, 3) = 1e300;
  source(1, 3) = 1e300;
  Points target = source;
  target(2, 3) = -1e300;
  const MatchScorer scorer(source, target, kBound);
  EXPECT_EQ(scorer.Cost({}, kInfinity), 1.0);
  const Rigid3 broken{Eigen::Matrix3d::Constant(std::nan("")),
                      Eigen::Vector3d::Zero()};
  EXPECT_EQ(scorer.Cost(broken, kInfinity), 10.0);
  EXPECT_TRUE(scorer.Inliers(broken).empty());
}

}  // namespace
}  // namespace quatro::match_scorer_test
