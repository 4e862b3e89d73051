// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/estimators/consensus_pose.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

#include "experiments/simulator/synthetic.h"

namespace quatro::consensus_pose_test {
namespace {

using ::testing::HasSubstr;

class ConsensusPoseSeed : public ::testing::TestWithParam<int> {
 protected:
  MatchedProblem MakeProblem(Eigen::Index num_matches,
                             double outlier_ratio) const {
    return MakeOutlierProblem(num_matches,
                              outlier_ratio,
                              0.05,
                              static_cast<std::uint64_t>(GetParam()));
  }
};

TEST_P(ConsensusPoseSeed, FindsThePoseAmongOutliers) {
  const MatchedProblem problem = MakeProblem(1000, 0.97);
  const PoseSummary summary =
      SolveConsensusPose(problem.source, problem.target, {});
  ASSERT_TRUE(summary.IsUsable()) << summary.message;
  const Rigid3& pose = *summary.target_from_source;
  EXPECT_LT(
      AngleBetween(pose.rotation, problem.true_target_from_source.rotation),
      0.02);
  EXPECT_LT(
      (pose.translation - problem.true_target_from_source.translation).norm(),
      0.2);
  EXPECT_EQ(summary.model, PoseModel::kYawTranslation);
  // Every inlier is within the bound in x and y.
  const ConsensusPoseOptions options;
  for (const Eigen::Index i : summary.consistent) {
    const Eigen::Vector3d p = problem.source.col(i);
    const Eigen::Vector3d error = problem.target.col(i) - pose * p;
    EXPECT_LE(error.head<2>().norm(), options.noise_bound + 1e-4) << i;
  }
  EXPECT_GE(summary.num_consistent, 25);
  // The noise of the true matches is far below the bound on each axis.
  EXPECT_GE(summary.num_translation_inliers, 25);
}

// The order of the matches and copies of them change nothing.
TEST_P(ConsensusPoseSeed, OrderAndCopiesChangeNothing) {
  const MatchedProblem problem = MakeProblem(300, 0.9);
  std::vector<Eigen::Index> order(300);
  std::iota(order.begin(), order.end(), 0);
  std::reverse(order.begin(), order.end());
  order.push_back(7);
  order.push_back(7);
  const PoseSummary given =
      SolveConsensusPose(problem.source, problem.target, {});
  const PoseSummary changed =
      SolveConsensusPose(Points(problem.source(Eigen::all, order)),
                         Points(problem.target(Eigen::all, order)),
                         {});
  ASSERT_TRUE(given.IsUsable() && changed.IsUsable());
  EXPECT_EQ(given.target_from_source->ToMatrix(),
            changed.target_from_source->ToMatrix());
  EXPECT_EQ(given.num_consistent, changed.num_consistent);
  EXPECT_EQ(changed.num_matches, 300);
}

TEST_P(ConsensusPoseSeed, ThreadsChangeNothing) {
  const MatchedProblem problem = MakeProblem(300, 0.9);
  ConsensusPoseOptions options;
  const PoseSummary one =
      SolveConsensusPose(problem.source, problem.target, options);
  options.num_threads = 3;
  const PoseSummary three =
      SolveConsensusPose(problem.source, problem.target, options);
  ASSERT_TRUE(one.IsUsable() && three.IsUsable());
  EXPECT_EQ(one.target_from_source->ToMatrix(),
            three.target_from_source->ToMatrix());
  EXPECT_EQ(one.consistent, three.consistent);
}

INSTANTIATE_TEST_SUITE_P(Seeds, ConsensusPoseSeed, ::testing::Range(1, 6));

TEST(ConsensusPose, SaysWhyThereIsNoPose) {
  const Points one = Points::Ones(3, 1);
  const PoseSummary few = SolveConsensusPose(one, one, {});
  EXPECT_EQ(few.termination, PoseTermination::kInsufficient);
  EXPECT_THAT(few.message, HasSubstr("no three of 1 matches"));
  ConsensusPoseOptions options;
  options.noise_bound = 0.0;
  const PoseSummary invalid = SolveConsensusPose(one, one, options);
  EXPECT_EQ(invalid.termination, PoseTermination::kInvalidInput);
  EXPECT_THAT(invalid.message, HasSubstr("noise_bound = 0"));
}

}  // namespace
}  // namespace quatro::consensus_pose_test
