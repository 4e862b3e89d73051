// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A prior on the pose in every method that works on matches.

#include <gtest/gtest.h>

#include <string>

#include "experiments/programs/methods.h"
#include "tests/support/two_poses.h"

namespace quatro::bounded_methods_test {
namespace {

class BoundedMethods : public ::testing::TestWithParam<std::string> {
 protected:
  PoseSummary Solve(const TwoPoses& problem, const PoseBounds& bounds) {
    RegistrationOptions options;
    if (NeedsIns(GetParam())) options.ins.mode = InsMode::kLeveled;
    options.bounds = bounds;
    std::string error;
    const MatchSolver solve = FindMatchSolver(GetParam(), {}, &error);
    EXPECT_TRUE(solve) << error;
    const RegistrationSummary summary =
        solve({problem.source, problem.target}, options);
    EXPECT_EQ(summary.error, "");
    return summary.solution;
  }
};

double Difference(const PoseSummary& summary, const Rigid3& pose) {
  return (summary.target_from_source->ToMatrix() - pose.ToMatrix()).norm();
}

TEST_P(BoundedMethods, TheBoundsDecideBetweenTwoPoses) {
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    const TwoPoses problem = MakeTwoPoses(seed);
    // FGR descends from no motion, and finds the pose that is nearer.
    const PoseSummary free = Solve(problem, PoseBounds());
    ASSERT_TRUE(free.IsUsable()) << free.message;
    EXPECT_LT(
        Difference(free, GetParam() == "fgr" ? problem.few : problem.many),
        0.3);
    for (const Rigid3& pose : {problem.few, problem.many}) {
      const Rigid3 off{RotationZ(-0.2), {-1.5, -1.5, 0.2}};
      PoseBounds bounds;
      bounds.guess = {off.rotation * pose.rotation,
                      pose.translation + off.translation};
      bounds.max_translation = 4.0;
      bounds.max_yaw = 0.35;
      const PoseSummary bounded = Solve(problem, bounds);
      ASSERT_TRUE(bounded.IsUsable()) << bounded.message;
      EXPECT_LT(Difference(bounded, pose), 0.3);
    }
  }
}

TEST_P(BoundedMethods, WithoutBoundsNothingChanges) {
  const TwoPoses problem = MakeTwoPoses(7);
  // The estimator itself; level, it is the same with an INS.
  RegistrationOptions options;
  std::string error;
  const Method* method = FindMethod(GetParam(), &error);
  if (!method) GTEST_SKIP() << "a peer";
  if (method->adjust) method->adjust(&options);
  const PoseSummary free =
      method->make(WithSharedValues(options))(problem.source, problem.target);
  PoseBounds only_a_guess;
  only_a_guess.guess = problem.few;
  const PoseSummary guessed = Solve(problem, only_a_guess);
  ASSERT_TRUE(free.IsUsable() && guessed.IsUsable());
  EXPECT_EQ(free.target_from_source->ToMatrix(),
            guessed.target_from_source->ToMatrix());
  EXPECT_EQ(free.translation_inliers, guessed.translation_inliers);
}

INSTANTIATE_TEST_SUITE_P(
    Registry,
    BoundedMethods,
    ::testing::ValuesIn(ExperimentMethodNames(MethodInput::kMatches)),
    [](const auto& method) { return method.param; });

}  // namespace
}  // namespace quatro::bounded_methods_test
