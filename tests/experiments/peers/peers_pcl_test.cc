// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Compares robust/estimators/ransac.h with PCL's, on the same matches.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#ifdef QUATRO_WITH_PCL

#include <cstdint>
#include <limits>

#include "experiments/peers/pcl_ransac.h"
#include "experiments/programs/methods.h"
#include "robust/estimators/ransac.h"
#include "tests/support/matched_problems.h"
#include "tests/support/pose_problems.h"
#include "tests/support/random_problems.h"

namespace quatro::peers_pcl_test {
namespace {

constexpr double kBound = 0.3;
constexpr int kNumSeeds = 20;

bool IsRight(const PoseSummary& summary, const KnownProblem& problem) {
  return summary.IsUsable() &&
         LargestDisplacement(*summary.target_from_source,
                             problem.true_target_from_source,
                             problem.source) <= kBound;
}

TEST(PclPeer, OurRansacIsRightAtLeastAsOften) {
  int num_ours = 0;
  int num_theirs = 0;
  for (const Eigen::Index num_inliers : {100, 40, 16, 10}) {
    for (std::uint64_t seed = 0; seed < kNumSeeds; ++seed) {
      const KnownProblem problem =
          TurnedProblem(num_inliers, 200 - num_inliers, seed);
      num_ours +=
          IsRight(SolveRansac(problem.source, problem.target, {}), problem);
      const PoseSummary theirs =
          SolveByPclRansac(problem.source, problem.target, kBound, {});
      num_theirs += IsRight(theirs, problem);
      // If both find most inliers, they find the same ones.
      if (num_inliers == 100) {
        EXPECT_TRUE(IsRight(theirs, problem)) << "seed " << seed;
      }
    }
  }
  EXPECT_GE(num_ours, num_theirs - 2);
  EXPECT_GE(num_theirs, 2 * kNumSeeds);
  RecordProperty("ours", num_ours);
  RecordProperty("theirs", num_theirs);
}

// A sample of three points alone is less accurate.
TEST(PclPeer, RansacEndsWithLeastSquares) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const KnownProblem problem = TurnedProblem(100, 100, seed);
    const PoseSummary summary =
        SolveByPclRansac(problem.source, problem.target, kBound, {});
    ASSERT_TRUE(summary.IsUsable()) << summary.message;
    EXPECT_LE(LargestDisplacement(*summary.target_from_source,
                                  problem.true_target_from_source,
                                  problem.source),
              0.03)
        << "seed " << seed;
  }
}

TEST(PclPeer, RansacDependsOnTheSeedAlone) {
  const KnownProblem problem = TurnedProblem(16, 184, 1);
  PclRansacOptions options;
  options.max_iterations = 50;  // Too few, so that the draws matter.
  const auto solve = [&](std::uint64_t seed) {
    options.seed = seed;
    return SolveByPclRansac(problem.source, problem.target, 5.0, options);
  };
  const PoseSummary one = solve(1);
  ASSERT_TRUE(one.IsUsable()) << one.message;
  EXPECT_EQ(solve(1).target_from_source->ToMatrix(),
            one.target_from_source->ToMatrix());
  EXPECT_NE(solve(2).target_from_source->ToMatrix(),
            one.target_from_source->ToMatrix());
}

TEST(PclPeer, RansacFarFromTheOriginKeepsItsDigits) {
  KnownProblem problem = TurnedProblem(100, 100, 3);
  const Eigen::Vector3d offset(5e6, -3e6, 100.0);
  problem.source.colwise() += offset;
  problem.target.colwise() += offset;
  problem.true_target_from_source.translation +=
      offset - problem.true_target_from_source.rotation * offset;
  EXPECT_TRUE(IsRight(
      SolveByPclRansac(problem.source, problem.target, kBound, {}), problem));
}

TEST(PclPeer, RansacSaysWhenThereIsNoAnswer) {
  const KnownProblem problem = MakeInconsistentProblem(
      {.num_inliers = 0, .num_outliers = 30}, kBound, 1);
  for (const Eigen::Index n : {0, 1, 2}) {
    const PoseSummary summary = SolveByPclRansac(
        problem.source.leftCols(n), problem.target.leftCols(n), kBound, {});
    EXPECT_FALSE(summary.IsUsable()) << n;
    EXPECT_EQ(summary.termination, PoseTermination::kInsufficient);
  }
  const Points same = Points::Ones(3, 10);
  EXPECT_FALSE(SolveByPclRansac(same, same, kBound, {}).IsUsable());
  Points broken = problem.source;
  broken(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(SolveByPclRansac(broken, problem.target, kBound, {}).termination,
            PoseTermination::kInvalidInput);
}

TEST(PclPeer, RansacIsInTheRegistry) {
  EXPECT_THAT(ExperimentMethodNames(MethodInput::kMatches),
              ::testing::Contains("pcl_ransac"));
}

}  // namespace
}  // namespace quatro::peers_pcl_test

#else

TEST(PclPeer, OurRansacIsRightAtLeastAsOften) {
  GTEST_SKIP() << "needs a build with -DQUATRO_WITH_PCL=ON";
}

#endif
