// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Compares robust/estimators/fgr.h and robust/estimators/ransac.h with
// Open3D's, on the same matches.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#ifdef QUATRO_WITH_OPEN3D

#include <cstdint>
#include <limits>

#include "experiments/peers/open3d.h"
#include "experiments/programs/methods.h"
#include "robust/estimators/fgr.h"
#include "robust/estimators/ransac.h"
#include "tests/support/matched_problems.h"
#include "tests/support/pose_problems.h"
#include "tests/support/random_problems.h"

namespace quatro::peers_open3d_test {
namespace {

constexpr double kBound = 0.3;
constexpr int kNumSeeds = 20;

bool IsRight(const PoseSummary& summary, const KnownProblem& problem) {
  return summary.IsUsable() &&
         LargestDisplacement(*summary.target_from_source,
                             problem.true_target_from_source,
                             problem.source) <= kBound;
}

TEST(Open3dPeer, FgrAgreesWhereAllIsEasy) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const KnownProblem problem = TurnedProblem(200, 20, seed);
    const PoseSummary theirs =
        SolveByOpen3dFgr(problem.source, problem.target, kBound, {});
    const FgrSummary ours = SolveFgr(problem.source, problem.target, {});
    ASSERT_TRUE(theirs.IsUsable() && ours.IsUsable()) << theirs.message;
    EXPECT_LE(LargestDisplacement(*theirs.target_from_source,
                                  *ours.target_from_source,
                                  problem.source),
              0.1)
        << "seed " << seed;
  }
}

TEST(Open3dPeer, OurFgrIsRightAtLeastAsOften) {
  for (const Eigen::Index num_inliers : {100, 60, 40, 20}) {
    int num_ours = 0;
    int num_theirs = 0;
    for (std::uint64_t seed = 0; seed < kNumSeeds; ++seed) {
      const KnownProblem problem =
          TurnedProblem(num_inliers, 200 - num_inliers, seed);
      num_ours +=
          IsRight(SolveFgr(problem.source, problem.target, {}), problem);
      // Without Open3D's tuple test, so that the matches are the same.
      Open3dFgrOptions options;
      options.tuple_test = false;
      num_theirs += IsRight(
          SolveByOpen3dFgr(problem.source, problem.target, kBound, options),
          problem);
    }
    EXPECT_GE(num_ours, num_theirs) << num_inliers << " of 200 right";
  }
}

// Both fail by chance if 10,000 samples are not enough: at 16 inliers of 200,
// in one of 70 runs.
TEST(Open3dPeer, OurRansacIsRightAtLeastAsOften) {
  int num_ours = 0;
  int num_theirs = 0;
  for (const Eigen::Index num_inliers : {100, 40, 16, 10}) {
    for (std::uint64_t seed = 0; seed < kNumSeeds; ++seed) {
      const KnownProblem problem =
          TurnedProblem(num_inliers, 200 - num_inliers, seed);
      num_ours +=
          IsRight(SolveRansac(problem.source, problem.target, {}), problem);
      num_theirs += IsRight(
          SolveByOpen3dRansac(problem.source, problem.target, kBound, {}),
          problem);
    }
  }
  EXPECT_GE(num_ours, num_theirs - 2);
  EXPECT_GE(num_ours, 60);
  RecordProperty("ours", num_ours);
  RecordProperty("theirs", num_theirs);
}

TEST(Open3dPeer, ItsIdentityIsNoAnswer) {
  const KnownProblem problem = MakeInconsistentProblem(
      {.num_inliers = 0, .num_outliers = 30}, kBound, 1);
  for (const Eigen::Index n : {0, 1, 2, 30}) {
    const Points source = problem.source.leftCols(n);
    const Points target = problem.target.leftCols(n);
    for (const PoseSummary& summary :
         {SolveByOpen3dFgr(source, target, kBound, {}),
          SolveByOpen3dRansac(source, target, kBound, {})}) {
      EXPECT_FALSE(summary.IsUsable()) << n;
      EXPECT_EQ(summary.termination, PoseTermination::kInsufficient);
    }
  }
  Points broken = problem.source;
  broken(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(SolveByOpen3dFgr(broken, problem.target, kBound, {}).termination,
            PoseTermination::kInvalidInput);
}

TEST(Open3dPeer, IsInTheRegistry) {
  EXPECT_THAT(ExperimentMethodNames(MethodInput::kMatches),
              ::testing::IsSupersetOf({"open3d_fgr", "open3d_ransac"}));
}

}  // namespace
}  // namespace quatro::peers_open3d_test

#else

TEST(Open3dPeer, OursAreRightAtLeastAsOften) {
  GTEST_SKIP() << "needs a build with -DQUATRO_WITH_OPEN3D=ON";
}

#endif
