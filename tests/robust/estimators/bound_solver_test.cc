// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/estimators/bound_solver.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "robust/estimators/distinct_matches.h"
#include "robust/estimators/quatro.h"
#include "robust/registration/registration.h"
#include "robust/verdict/verdict.h"
#include "solvers/closed_form/gravity.h"
#include "tests/support/two_poses.h"

namespace quatro::bound_solver_test {
namespace {

using ::testing::ElementsAreArray;
using ::testing::HasSubstr;

constexpr double kNoiseBound = 0.3;  // [m]

PoseSolver Quatro() {
  return [](const PointsRef& source, const PointsRef& target) {
    return SolveQuatro(source, target, QuatroOptions());
  };
}

// Through the door: leveled, within bounds, and back.
PoseSummary SolveWithin(const PointsRef& source,
                        const PointsRef& target,
                        const InsOptions& ins,
                        const PoseBounds& bounds) {
  RegistrationOptions options;
  options.solver = Quatro();
  options.noise_bound = kNoiseBound;
  options.ins = ins;
  options.bounds = bounds;
  const RegistrationSummary summary =
      RegisterMatches({source, target}, options);
  EXPECT_EQ(summary.error, "");
  return summary.solution;
}

PoseBounds Around(const Rigid3& guess) {
  PoseBounds bounds;
  bounds.guess = guess;
  bounds.max_translation = 3.0;
  bounds.max_yaw = 0.3;
  return bounds;
}

TEST(BoundSolver, ColumnsAreThoseOfAllMatches) {
  const TwoPoses problem = MakeTwoPoses(1);
  const PoseSummary summary =
      BoundSolver(Quatro(), Around(problem.few), kNoiseBound)(problem.source,
                                                              problem.target);
  ASSERT_TRUE(summary.IsUsable()) << summary.message;
  EXPECT_THAT(summary.translation_inliers, ElementsAreArray(problem.of_few));
  EXPECT_THAT(summary.consistent, ElementsAreArray(problem.of_few));
}

TEST(BoundSolver, WithoutBoundsNothingChanges) {
  const TwoPoses problem = MakeTwoPoses(1);
  PoseBounds unbounded;
  unbounded.guess = problem.few;
  const PoseSummary plain = Quatro()(problem.source, problem.target);
  const PoseSummary bounded = BoundSolver(Quatro(), unbounded, kNoiseBound)(
      problem.source, problem.target);
  ASSERT_TRUE(plain.IsUsable());
  EXPECT_EQ(plain.target_from_source->ToMatrix(),
            bounded.target_from_source->ToMatrix());
  EXPECT_EQ(plain.translation_inliers, bounded.translation_inliers);
  EXPECT_EQ(plain.message, bounded.message);
}

TEST(BoundSolver, APoseOutsideIsNoAnswer) {
  const TwoPoses problem = MakeTwoPoses(1);
  const PoseSolver stubborn = [&](const PointsRef&, const PointsRef&) {
    PoseSummary summary;
    summary.termination = PoseTermination::kSolved;
    summary.target_from_source = problem.many;
    return summary;
  };
  const PoseSummary summary =
      BoundSolver(stubborn, Around(problem.few), kNoiseBound)(problem.source,
                                                              problem.target);
  EXPECT_EQ(summary.termination, PoseTermination::kInsufficient);
  EXPECT_FALSE(summary.IsUsable());
  EXPECT_THAT(summary.message,
              HasSubstr("the best pose is outside of the bounds: it is"));
  EXPECT_THAT(summary.message, HasSubstr("the bounds allow 3 m"));
}

// The 90 matches that follow problem.many follow `pose` instead.
TwoPoses WithManyAt(const Rigid3& pose, TwoPoses problem) {
  for (Eigen::Index i = 0; i < problem.source.cols(); ++i) {
    const Eigen::Vector3d p = problem.source.col(i);
    const Eigen::Vector3d noise = problem.target.col(i) - problem.many * p;
    if (noise.norm() < 0.1) problem.target.col(i) = pose * p + noise;
  }
  problem.many = pose;
  return problem;
}

// 60 matches follow a pose within the bounds, 90 one that is 1.8 m outside:
// too near for its matches to be told by themselves.
TEST(BoundSolver, TheConsensusInsideIsFoundBesideALargerOneOutside) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const TwoPoses problem =
        WithManyAt({RotationZ(0.1), {4.8, 0.0, 0.0}}, MakeTwoPoses(seed));
    PoseBounds bounds;
    bounds.max_translation = 3.0;
    bounds.max_yaw = 0.4;
    const auto possible =
        bounds.PossibleInliers(problem.source, problem.target, kNoiseBound);
    ASSERT_GT(possible.size(), problem.of_few.size() + 70);
    const PoseSummary free = Quatro()(problem.source, problem.target);
    ASSERT_TRUE(free.IsUsable());
    ASSERT_FALSE(bounds.Contain(*free.target_from_source, kNoiseBound));

    const PoseSummary summary = BoundSolver(Quatro(), bounds, kNoiseBound)(
        problem.source, problem.target);
    ASSERT_TRUE(summary.IsUsable()) << summary.message;
    EXPECT_LT((summary.target_from_source->ToMatrix() - problem.few.ToMatrix())
                  .norm(),
              0.1);
    // Inliers that it shares with the pose outside are its own, too.
    EXPECT_THAT(summary.translation_inliers,
                ::testing::IsSupersetOf(problem.of_few));
    EXPECT_THAT(summary.Note("bounds"),
                HasSubstr("a pose outside of the bounds has more inliers"));
    EXPECT_EQ(summary.num_matches, static_cast<Eigen::Index>(possible.size()));
  }
}

TEST(BoundSolver, TheConsensusInsideIsFoundBesideTwoLargerOnesOutside) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const TwoPoses problem =
        WithManyAt({RotationZ(0.1), {4.8, 0.0, 0.0}}, MakeTwoPoses(seed));
    const TwoPoses other = WithManyAt({RotationZ(-0.1), {-4.8, 0.0, 0.0}},
                                      MakeTwoPoses(seed + 100));
    std::vector<Eigen::Index> of_many;
    for (Eigen::Index i = 0; i < other.source.cols(); ++i) {
      if (!std::binary_search(other.of_few.begin(), other.of_few.end(), i)) {
        of_many.push_back(i);
      }
    }
    Points source(3, 240), target(3, 240);
    source << problem.source, Columns(other.source, of_many);
    target << problem.target, Columns(other.target, of_many);
    PoseBounds bounds;
    bounds.max_translation = 3.0;
    bounds.max_yaw = 0.4;
    const PoseSummary summary =
        BoundSolver(Quatro(), bounds, kNoiseBound)(source, target);
    ASSERT_TRUE(summary.IsUsable()) << summary.message;
    EXPECT_LT((summary.target_from_source->ToMatrix() - problem.few.ToMatrix())
                  .norm(),
              0.1);
  }
}

TEST(BoundSolver, BoundsWithoutAnyMatchSaySo) {
  const TwoPoses problem = MakeTwoPoses(1);
  const PoseSummary summary = BoundSolver(
      Quatro(), Around({RotationZ(0.0), {500.0, 0.0, 0.0}}), kNoiseBound)(
      problem.source, problem.target);
  EXPECT_EQ(summary.termination, PoseTermination::kInsufficient);
  EXPECT_THAT(summary.message, HasSubstr("the bounds leave 0 of 150 matches"));
}

TEST(BoundSolver, BadBoundsAreInvalidInput) {
  PoseBounds bounds = Around({});
  bounds.max_yaw = 7.0;
  const TwoPoses problem = MakeTwoPoses(1);
  const PoseSummary summary = BoundSolver(Quatro(), bounds, kNoiseBound)(
      problem.source, problem.target);
  EXPECT_EQ(summary.termination, PoseTermination::kInvalidInput);
  EXPECT_THAT(summary.message, HasSubstr("bounds.max_yaw"));
}

// Scans of vehicles that stand tilted, with an INS: the guess is a yaw and a
// translation between the points as given, its roll and pitch are the INS'.
TEST(BoundSolver, BoundsAreOfTheGivenFramesWithAnIns) {
  const TwoPoses level = MakeTwoPoses(2);
  InsOptions ins;
  ins.mode = InsMode::kLeveled;
  ins.source_attitude = {0.15, -0.1, 0.0};
  ins.target_attitude = {-0.1, 0.12, 0.0};
  const LevelFrames frames = MakeLevelFrames(ins);
  const Rigid3 source_from_level{frames.level_from_source.transpose(), {}};
  const Rigid3 target_from_level{frames.level_from_target.transpose(), {}};
  const Points source = source_from_level.rotation * level.source;
  const Points target = target_from_level.rotation * level.target;
  Rigid3 truth;
  truth.rotation = target_from_level.rotation * level.few.rotation *
                   frames.level_from_source;
  truth.translation = target_from_level.rotation * level.few.translation;

  const Rigid3 guess{RotationZ(Yaw(truth.rotation)), truth.translation};
  const PoseSummary bounded = SolveWithin(source, target, ins, Around(guess));
  ASSERT_TRUE(bounded.IsUsable()) << bounded.message;
  EXPECT_LT((bounded.target_from_source->ToMatrix() - truth.ToMatrix()).norm(),
            0.1);
  const PoseSummary free = SolveWithin(source, target, ins, PoseBounds());
  ASSERT_TRUE(free.IsUsable());
  EXPECT_GT((free.target_from_source->ToMatrix() - truth.ToMatrix()).norm(),
            1.0);
}

TEST(BoundSolver, GravityAlongAnotherAxisTurnsTheYawWithIt) {
  const TwoPoses level = MakeTwoPoses(3);
  InsOptions ins;
  ins.up = Eigen::Vector3d::UnitX();
  const Eigen::Matrix3d turned =
      RotationBetween(Eigen::Vector3d::UnitZ(), ins.up);
  const Rigid3 few{turned * level.few.rotation * turned.transpose(),
                   turned * level.few.translation};
  const PoseSummary summary = SolveWithin(
      turned * level.source, turned * level.target, ins, Around(few));
  ASSERT_TRUE(summary.IsUsable()) << summary.message;
  EXPECT_LT((summary.target_from_source->ToMatrix() - few.ToMatrix()).norm(),
            0.1);
}

TEST(BoundSolver, ARivalOutsideOfTheBoundsIsNone) {
  const TwoPoses problem = MakeTwoPoses(4);
  const PoseBounds bounds = Around(problem.few);
  const PoseSummary summary = BoundSolver(Quatro(), bounds, kNoiseBound)(
      problem.source, problem.target);
  VerdictOptions options;
  const auto judge = [&] {
    return Judge(problem.source,
                 problem.target,
                 summary,
                 kNoiseBound,
                 std::nullopt,
                 options);
  };
  const Verdict free = judge();
  ASSERT_TRUE(free.rival);
  EXPECT_EQ(free.rival->num_inliers, 90);
  EXPECT_EQ(free.status, Status::kAmbiguous);
  options.rival.bounds = bounds;
  const Verdict bounded = judge();
  EXPECT_TRUE(!bounded.rival || bounded.rival->num_inliers < 10);
  EXPECT_EQ(bounded.status, Status::kRegistered) << bounded.reason;
}

}  // namespace
}  // namespace quatro::bound_solver_test
