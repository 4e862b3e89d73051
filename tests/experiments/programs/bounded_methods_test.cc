// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A prior on the pose in every method that works on matches.

#include <gtest/gtest.h>

#include <string>

#include "experiments/programs/methods.h"
#include "robust/estimators/bound_solver.h"
#include "tests/support/two_poses.h"

namespace quatro {
namespace {

class BoundedMethods : public ::testing::TestWithParam<std::string> {
 protected:
  PoseSummary Solve(const TwoPoses& problem, const PoseBounds& bounds) {
    InsOptions ins;
    if (GetParam() == "quatro_ins") ins.mode = InsMode::kLeveled;
    std::string error;
    const QuatroOptions options;
    const PoseSolver solver = MakeLevelSolver(GetParam(), options, ins, &error);
    EXPECT_TRUE(solver) << error;
    return SolveWithin(problem.source,
                       problem.target,
                       solver,
                       options.noise_bound,
                       ins,
                       bounds);
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
  std::string error;
  InsOptions ins;
  if (GetParam() == "quatro_ins") ins.mode = InsMode::kLeveled;
  const PoseSolver plain = MakeSolver(GetParam(), QuatroOptions(), ins, &error);
  const PoseSummary free = plain(problem.source, problem.target);
  PoseBounds only_a_guess;
  only_a_guess.guess = problem.few;
  const PoseSummary guessed = Solve(problem, only_a_guess);
  ASSERT_TRUE(free.IsUsable() && guessed.IsUsable());
  EXPECT_EQ(free.target_from_source->ToMatrix(),
            guessed.target_from_source->ToMatrix());
  EXPECT_EQ(free.translation_inliers, guessed.translation_inliers);
}

INSTANTIATE_TEST_SUITE_P(Registry,
                         BoundedMethods,
                         ::testing::ValuesIn(MethodNames()),
                         [](const auto& method) { return method.param; });

}  // namespace
}  // namespace quatro
