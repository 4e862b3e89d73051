// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/registration/ins.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "features/base/degree.h"
#include "features/base/rigid3.h"
#include "robust/estimators/arc_consensus.h"
#include "robust/estimators/teaser.h"
#include "solvers/ceres/ins_refinement.h"
#include "solvers/closed_form/gravity.h"
#include "tests/support/ins_solutions.h"
#include "tests/support/matched_problems.h"
#include "tests/support/matchers.h"
#include "tests/support/random_problems.h"

namespace quatro::ins_test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsSupersetOf;

QuatroOptions WithoutPolish() {
  QuatroOptions options;
  options.polish = false;
  return options;
}

// Two scans of one place from two attitudes, and what a perfect INS says.
struct SlopeProblem {
  Points source;
  Points target;
  Rigid3 true_target_from_source;
  std::vector<Eigen::Index> inliers;
  InsOptions ins;
};

// The target stands on a slope of 4 deg, the vertical of the source is `tilt`
// [rad] off that. `noise` [m].
SlopeProblem MakeSlope(double tilt, std::uint64_t seed, double noise = 0.0) {
  const double yaw = 0.7 * static_cast<double>(seed) - 2.0;
  const KnownProblem level = MakeMatchedProblem(
      {.num_inliers = 60, .num_outliers = 60, .noise = noise, .yaw = yaw},
      seed);
  Random random(seed + 100);
  const double heading = 2.0 * M_PI * random.Uniform();
  SlopeProblem problem;
  problem.ins.target_attitude = {0.05, -0.05, 0.4};
  const Eigen::Matrix3d slope =
      WorldFromBody({0.05, -0.05, 0.4}) *
      Eigen::AngleAxisd(
          tilt, Eigen::Vector3d(std::cos(heading), std::sin(heading), 0.0))
          .toRotationMatrix() *
      RotationZ(2.2);  // World from the source's body.
  problem.ins.source_attitude = AttitudeOf(slope);
  EXPECT_LE((WorldFromBody(problem.ins.source_attitude) - slope).norm(), 1e-12);

  // The level problem's source is in the world. So is its target, but for the
  // translation, once its yaw is taken back: one world for both attitudes.
  problem.inliers = level.inliers;
  const Rigid3 source_from_world{slope.transpose(), Eigen::Vector3d::Zero()};
  const Rigid3 target_from_world{
      WorldFromBody(problem.ins.target_attitude).transpose(), {3.0, 1.0, -2.0}};
  const Rigid3 unturn{RotationZ(-Yaw(level.true_target_from_source.rotation)),
                      Eigen::Vector3d::Zero()};
  problem.source = source_from_world.Apply(level.source);
  problem.target = (target_from_world * unturn).Apply(level.target);
  problem.true_target_from_source = target_from_world * unturn *
                                    level.true_target_from_source *
                                    Inverse(source_from_world);
  return problem;
}

PoseSummary Solve(const SlopeProblem& problem,
                  InsMode mode,
                  const QuatroOptions& options = WithoutPolish()) {
  InsOptions ins = problem.ins;
  ins.mode = mode;
  return SolveQuatroWithIns(problem.source, problem.target, options, ins);
}

// [deg]; a half turn if there is no answer.
double RotationErrorDeg(const PoseSummary& summary,
                        const SlopeProblem& problem) {
  EXPECT_TRUE(summary.IsUsable()) << summary.message;
  if (!summary.IsUsable()) return 180.0;
  return AngleBetween(summary.target_from_source->rotation,
                      problem.true_target_from_source.rotation) /
         kDegree;
}

// Each roll and pitch by `std` [rad], which the INS says of itself.
void Disturb(double std, Random* random, InsOptions* ins) {
  for (Attitude* attitude : {&ins->source_attitude, &ins->target_attitude}) {
    attitude->roll += std * RandomNormal(*random);
    attitude->pitch += std * RandomNormal(*random);
  }
  ins->attitude_std = std;
}

class InsModeTest : public ::testing::TestWithParam<InsMode> {};

std::string ModeName(const ::testing::TestParamInfo<InsMode>& mode) {
  const char* names[] = {"None", "Relative", "Leveled", "Fused"};
  return names[static_cast<int>(mode.param)];
}

INSTANTIATE_TEST_SUITE_P(,
                         InsModeTest,
                         ::testing::Values(InsMode::kRelative,
                                           InsMode::kLeveled,
                                           InsMode::kFused),
                         ModeName);

TEST_P(InsModeTest, RecoversThePoseOnSlopesWherePlainQuatroCannot) {
  for (const double tilt_deg : {2.0, 5.0, 10.0, 15.0}) {
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      const SlopeProblem problem = MakeSlope(tilt_deg * kDegree, seed);
      const PoseSummary summary = Solve(problem, GetParam());
      EXPECT_LE(RotationErrorDeg(summary, problem), 1e-6) << tilt_deg;
      EXPECT_LE((summary.target_from_source->translation -
                 problem.true_target_from_source.translation)
                    .norm(),
                1e-6);
      EXPECT_THAT(summary.translation_inliers, IsSupersetOf(problem.inliers));
      const PoseSummary plain = Solve(problem, InsMode::kNone);
      if (plain.IsUsable()) {
        EXPECT_GT(RotationErrorDeg(plain, problem), 1.0) << tilt_deg;
      }
    }
  }
}

TEST_P(InsModeTest, NoiseOfTheMatchesLeavesLessThanADegree) {
  for (const double tilt_deg : {2.0, 5.0, 10.0, 15.0}) {
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      const SlopeProblem problem = MakeSlope(tilt_deg * kDegree, seed, 0.1);
      EXPECT_LT(RotationErrorDeg(Solve(problem, GetParam()), problem), 0.3);
      EXPECT_LT(RotationErrorDeg(Solve(problem, GetParam(), {}), problem), 0.3);
    }
  }
}

TEST_P(InsModeTest, AnyAxisMayBeUp) {
  const SlopeProblem problem = MakeSlope(0.15, 3);
  for (const Eigen::Vector3d& up : {Eigen::Vector3d(0.0, -1.0, 0.0),
                                    Eigen::Vector3d(0.0, 0.0, -1.0),
                                    RandomDirection(8)}) {
    // The same clouds in axes with `up` for z.
    const Rigid3 axes{RotationBetween(Eigen::Vector3d::UnitZ(), up),
                      Eigen::Vector3d::Zero()};
    SlopeProblem turned = problem;
    turned.ins.up = up;
    turned.source = axes.Apply(problem.source);
    turned.target = axes.Apply(problem.target);
    turned.true_target_from_source =
        axes * problem.true_target_from_source * Inverse(axes);
    const PoseSummary expected = Solve(problem, GetParam());
    const PoseSummary summary = Solve(turned, GetParam());
    EXPECT_LE(RotationErrorDeg(summary, turned), 1e-6) << up.transpose();
    EXPECT_EQ(summary.translation_inliers, expected.translation_inliers);
  }
}

TEST_P(InsModeTest, SwapGivesTheInverse) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const SlopeProblem problem = MakeSlope(0.15, seed);
    SlopeProblem swapped = problem;
    std::swap(swapped.source, swapped.target);
    std::swap(swapped.ins.source_attitude, swapped.ins.target_attitude);
    const PoseSummary there = Solve(problem, GetParam());
    const PoseSummary back = Solve(swapped, GetParam());
    ASSERT_TRUE(there.IsUsable() && back.IsUsable());
    EXPECT_LE((Inverse(*there.target_from_source).ToMatrix() -
               back.target_from_source->ToMatrix())
                  .norm(),
              1e-6);
  }
}

TEST_P(InsModeTest, TiltIsAppliedOnce) {
  // The source's own tilt, known exactly: neither left out (off by it) nor
  // applied twice (off by it, too, on the other side).
  SlopeProblem problem = MakeSlope(0.0, 1);
  problem.ins.target_attitude = {};
  problem.ins.source_attitude = {0.1, 0.0, 0.0};
  const KnownProblem level = MakeMatchedProblem({.noise = 0.0}, 1);
  const Rigid3 level_from_source{LevelFromBody(0.1, 0.0),
                                 Eigen::Vector3d::Zero()};
  problem.source = Inverse(level_from_source).Apply(level.source);
  problem.target = level.target;
  problem.true_target_from_source =
      level.true_target_from_source * level_from_source;
  const PoseSummary summary = Solve(problem, GetParam());
  EXPECT_LE(RotationErrorDeg(summary, problem), 1e-6);
}

TEST_P(InsModeTest, CopiesOfAMatchCountOnce) {
  const SlopeProblem problem = MakeSlope(0.1, 4, 0.1);
  SlopeProblem twice = problem;
  twice.source = problem.source.replicate(1, 2);
  twice.target = problem.target.replicate(1, 2);
  const PoseSummary once = Solve(problem, GetParam());
  const PoseSummary copied = Solve(twice, GetParam());
  ASSERT_TRUE(once.IsUsable() && copied.IsUsable());
  EXPECT_EQ(copied.num_matches, once.num_matches);
  EXPECT_EQ(copied.num_translation_inliers, once.num_translation_inliers);
  EXPECT_EQ(copied.target_from_source->ToMatrix(),
            once.target_from_source->ToMatrix());
}

TEST_P(InsModeTest, TooFewMatchesAreSaidSo) {
  SlopeProblem problem = MakeSlope(0.1, 4);
  problem.source = problem.source.leftCols(1).eval();
  problem.target = problem.target.leftCols(1).eval();
  const PoseSummary summary = Solve(problem, GetParam());
  EXPECT_EQ(summary.termination, PoseTermination::kInsufficient);
  EXPECT_FALSE(summary.IsUsable());
}

TEST(Ins, ZeroAttitudesArePlainQuatroBitForBit) {
  for (const bool polish : {false, true}) {
    const KnownProblem problem = MakeMatchedProblem({.noise = 0.2}, 6);
    QuatroOptions options;
    options.polish = polish;
    const QuatroSummary plain =
        SolveQuatro(problem.source, problem.target, options);
    for (const InsMode mode :
         {InsMode::kNone, InsMode::kRelative, InsMode::kLeveled}) {
      InsOptions ins;
      ins.mode = mode;
      const PoseSummary summary =
          SolveQuatroWithIns(problem.source, problem.target, options, ins);
      ASSERT_TRUE(plain.IsUsable() && summary.IsUsable());
      EXPECT_EQ(plain.target_from_source->ToMatrix(),
                summary.target_from_source->ToMatrix());
      EXPECT_EQ(plain.consistent, summary.consistent);
      EXPECT_EQ(plain.translation_inliers, summary.translation_inliers);
      ASSERT_EQ(plain.unpolished_target_from_source.has_value(),
                summary.unpolished_target_from_source.has_value());
      if (plain.unpolished_target_from_source) {
        EXPECT_EQ(plain.unpolished_target_from_source->ToMatrix(),
                  summary.unpolished_target_from_source->ToMatrix());
      }
    }
  }
}

TEST(Ins, HalfADegreeOfItIsLeftByLevelingAndTakenOutByFusing) {
  constexpr double kStd = 0.5 * kDegree;
  double leveled_sum = 0.0;
  double fused_sum = 0.0;
  constexpr int kNumProblems = 20;
  for (std::uint64_t seed = 0; seed < kNumProblems; ++seed) {
    SlopeProblem problem = MakeSlope(10.0 * kDegree, seed % 5, 0.1);
    Random random(seed + 1000);
    Disturb(kStd, &random, &problem.ins);
    const PoseSummary fused = Solve(problem, InsMode::kFused);
    leveled_sum += RotationErrorDeg(Solve(problem, InsMode::kLeveled), problem);
    fused_sum += RotationErrorDeg(fused, problem);
    EXPECT_THAT(fused.message, HasSubstr("fused"));
    EXPECT_TRUE(fused.unpolished_target_from_source.has_value());
  }
  // Two axes of two attitudes: 0.5 sqrt(2) sqrt(pi / 2) deg = 0.89 deg.
  const double leveled = leveled_sum / kNumProblems;
  const double fused = fused_sum / kNumProblems;
  RecordProperty("leveled_deg", std::to_string(leveled));
  RecordProperty("fused_deg", std::to_string(fused));
  EXPECT_GT(leveled, 0.5);
  EXPECT_LT(leveled, 1.3);
  EXPECT_LT(fused, 0.2);
}

// 60 of 120 matches wrong, 0.1 m of noise, an INS that is off by 0.3 deg in
// each angle. The error of a yaw alone is the tilt at least, whatever the
// matches.
TEST(Ins, NoisyOneKeepsAHillBelowADegreeWhereAYawAloneCannot) {
  for (const double tilt_deg : {2.0, 4.0, 6.0, 8.0, 10.0, 12.0, 15.0}) {
    double leveled_sum = 0.0;
    constexpr int kNumProblems = 10;
    for (std::uint64_t seed = 0; seed < kNumProblems; ++seed) {
      SlopeProblem problem = MakeSlope(tilt_deg * kDegree, seed, 0.1);
      Random random(seed + 2000);
      Disturb(0.3 * kDegree, &random, &problem.ins);
      leveled_sum +=
          RotationErrorDeg(Solve(problem, InsMode::kLeveled), problem);
      for (const InsMode mode : {InsMode::kLeveled, InsMode::kFused}) {
        EXPECT_LT(RotationErrorDeg(Solve(problem, mode, {}), problem), 0.3);
      }
      EXPECT_LT(RotationErrorDeg(Solve(problem, InsMode::kFused), problem), 0.3)
          << tilt_deg;
      EXPECT_GE(RotationErrorDeg(Solve(problem, InsMode::kNone), problem),
                tilt_deg - 1e-6);
      // Sixty matches all around hold a tilt without any INS, too.
      EXPECT_LT(RotationErrorDeg(Solve(problem, InsMode::kNone, {}), problem),
                0.3);
    }
    EXPECT_LT(leveled_sum / kNumProblems, 1.0) << tilt_deg;
  }
}

// Both attitudes off by as much in one direction: about 0.7 deg between them,
// and not the 0.3 deg that the INS says of itself.
TEST(Ins, BiasIsLeftByLevelingAndTakenOutByFusing) {
  for (const double tilt_deg : {2.0, 5.0, 10.0, 15.0}) {
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      SlopeProblem problem = MakeSlope(tilt_deg * kDegree, seed, 0.1);
      problem.ins.source_attitude.roll += 0.5 * kDegree;
      problem.ins.source_attitude.pitch += 0.5 * kDegree;
      problem.ins.attitude_std = 0.3 * kDegree;
      const double leveled =
          RotationErrorDeg(Solve(problem, InsMode::kLeveled), problem);
      EXPECT_GT(leveled, 0.5) << tilt_deg;
      EXPECT_LT(leveled, 1.0) << tilt_deg;
      EXPECT_LT(RotationErrorDeg(Solve(problem, InsMode::kFused), problem),
                0.3);
    }
  }
}

// Two true matches among wrong ones hold a yaw and no tilt: no polish helps.
TEST(Ins, TwoTrueMatchesOnAHillNeedIt) {
  for (const double tilt_deg : {2.0, 5.0, 10.0, 15.0}) {
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      const KnownProblem level = MakeInconsistentProblem(
          {.num_inliers = 2, .num_outliers = 20}, 0.3, seed);
      const Rigid3 tilt{LevelFromBody(tilt_deg * kDegree, 0.0),
                        Eigen::Vector3d::Zero()};
      SlopeProblem problem;
      problem.source = Inverse(tilt).Apply(level.source);
      problem.target = level.target;
      problem.true_target_from_source = level.true_target_from_source * tilt;
      problem.ins.source_attitude.roll = tilt_deg * kDegree;
      Random random(seed);
      Disturb(0.1 * kDegree, &random, &problem.ins);
      // If it has an answer at all.
      const PoseSummary plain = Solve(problem, InsMode::kNone, {});
      if (plain.IsUsable()) {
        EXPECT_GE(RotationErrorDeg(plain, problem), tilt_deg - 1e-6);
      }
      for (const InsMode mode : {InsMode::kLeveled, InsMode::kFused}) {
        EXPECT_LT(RotationErrorDeg(Solve(problem, mode, {}), problem), 1.0);
      }
    }
  }
}

// A sure INS moves even the answer that fits its inliers best.
TEST(Ins, HasItsSayAfterThePolish) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    SlopeProblem problem = MakeSlope(10.0 * kDegree, seed, 0.2);
    const auto tilt_error = [&](double attitude_std) {
      problem.ins.attitude_std = attitude_std;
      const PoseSummary summary = Solve(problem, InsMode::kFused, {});
      EXPECT_TRUE(summary.unpolished_target_from_source.has_value());
      const Eigen::Vector3d up =
          WorldFromBody(problem.ins.target_attitude) *
          summary.target_from_source->rotation *
          WorldFromBody(problem.ins.source_attitude).transpose() *
          Eigen::Vector3d::UnitZ();
      return std::hypot(up.x(), up.y());
    };
    EXPECT_LT(tilt_error(1e-6), 1e-6);
    EXPECT_GT(tilt_error(1.0), 1e-5);
  }
}

// The polished answer is the best on its inliers but for the INS.
TEST(Ins, PolishedAnswerIsNotTheLastWord) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SlopeProblem problem = MakeSlope(5.0 * kDegree, seed, 0.28);
    Random random(seed);
    Disturb(0.1 * kDegree, &random, &problem.ins);
    EXPECT_THAT(Solve(problem, InsMode::kFused, {}).message,
                HasSubstr("; fused with the INS"))
        << seed;
  }
}

TEST(Ins, FusesAsTheRefinementOfTheInliers) {
  // Level, without outliers, and an INS that claims otherwise.
  const KnownProblem level =
      MakeMatchedProblem({.num_outliers = 0, .noise = 0.05}, 3);
  InsOptions ins;
  ins.mode = InsMode::kFused;
  ins.source_attitude.roll = 0.005;
  ins.attitude_std = 0.002;
  ins.match_std = 0.2;
  const Eigen::Matrix3d level_from_source = LevelFromBody(0.005, 0.0);
  VerticalPrior prior;
  prior.up_in_source = level_from_source.row(2).transpose();
  prior.angle_std = std::sqrt(0.002 * 0.002 + 0.002 * 0.002);
  const auto expected = RefineWithIns(
      level.source, level.target, 0.2, level.true_target_from_source, prior);
  ASSERT_TRUE(expected.has_value());
  const PoseSummary summary =
      SolveQuatroWithIns(level.source, level.target, WithoutPolish(), ins);
  ASSERT_TRUE(summary.IsUsable()) << summary.message;
  EXPECT_LE((summary.target_from_source->ToMatrix() -
             expected->target_from_source.ToMatrix())
                .norm(),
            1e-6);
}

// By (1) of solvers/ceres/ins_refinement.h only the ratio of the two counts.
TEST(Ins, StandardDeviationOfTheMatchesWeighsThem) {
  SlopeProblem problem = MakeSlope(0.1, 1, 0.2);
  problem.ins.source_attitude.roll += 0.01;
  const auto pose = [&](double match_std, double attitude_std) {
    problem.ins.match_std = match_std;
    problem.ins.attitude_std = attitude_std;
    return Solve(problem, InsMode::kFused).target_from_source->ToMatrix();
  };
  const Eigen::Matrix4d expected = pose(0.1, 0.001);
  EXPECT_EQ(pose(0.0, 0.001), expected);  // A third of 0.3 m.
  EXPECT_LE((pose(1.0, 0.01) - expected).norm(), 1e-6);
  EXPECT_GT((pose(1.0, 0.001) - expected).norm(), 1e-4);
}

TEST(SolveWithIns, ArcConsensusFindsASlope) {
  SlopeProblem problem = MakeSlope(10.0 * kDegree, 1, 0.05);
  const PoseSolver solve = [](const PointsRef& p, const PointsRef& q) {
    return SolveArcConsensus(p, q, {});
  };
  problem.ins.mode = InsMode::kLeveled;
  const PoseSummary summary =
      SolveWithIns(problem.source, problem.target, solve, 0.3, problem.ins);
  ASSERT_TRUE(summary.IsUsable()) << summary.message;
  EXPECT_LT(AngleBetween(summary.target_from_source->rotation,
                         problem.true_target_from_source.rotation),
            0.5 * kDegree);
}

TEST(SolveWithIns, FusesAPoseWithScale) {
  SlopeProblem problem = MakeSlope(10.0 * kDegree, 1, 0.05);
  constexpr double kScale = 1.5;
  problem.source /= kScale;
  TeaserOptions options;
  options.estimate_scale = true;
  const PoseSolver solve = [&](const PointsRef& p, const PointsRef& q) {
    return SolveTeaser(p, q, options);
  };
  problem.ins.mode = InsMode::kFused;
  const PoseSummary summary = SolveWithIns(
      problem.source, problem.target, solve, options.noise_bound, problem.ins);
  ASSERT_TRUE(summary.IsUsable()) << summary.message;
  EXPECT_THAT(summary.message, HasSubstr("; fused with the INS"));
  EXPECT_NEAR(summary.scale, kScale, 0.01);
  EXPECT_LT(AngleBetween(summary.target_from_source->rotation,
                         problem.true_target_from_source.rotation),
            0.2 * kDegree);
  EXPECT_THAT(summary.translation_inliers, IsSupersetOf(problem.inliers));
}

TEST(Ins, RelativeNeedsTheYawsAndLeveledDoesNot) {
  SlopeProblem problem = MakeSlope(10.0 * kDegree, 2);
  problem.ins.source_attitude.yaw += 0.5;
  EXPECT_LE(RotationErrorDeg(Solve(problem, InsMode::kLeveled), problem), 1e-6);
  EXPECT_LE(RotationErrorDeg(Solve(problem, InsMode::kFused), problem), 1e-6);
  EXPECT_GT(RotationErrorDeg(Solve(problem, InsMode::kRelative), problem), 1.0);
}

TEST(Ins, UpAloneTurnsTheAxisOfPlainQuatro) {
  const KnownProblem level = MakeMatchedProblem({.noise = 0.0}, 2);
  const Rigid3 axes{
      RotationBetween(Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX()),
      Eigen::Vector3d::Zero()};
  InsOptions ins;
  ins.up = Eigen::Vector3d::UnitX();
  const PoseSummary summary = SolveQuatroWithIns(
      axes.Apply(level.source), axes.Apply(level.target), WithoutPolish(), ins);
  ASSERT_TRUE(summary.IsUsable()) << summary.message;
  EXPECT_LE((summary.target_from_source->ToMatrix() -
             (axes * level.true_target_from_source * Inverse(axes)).ToMatrix())
                .norm(),
            1e-9);
}

TEST(Ins, TwoMatchesHoldAPoseOnASlope) {
  SlopeProblem problem = MakeSlope(0.2, 3);
  Points source(3, 2);
  Points target(3, 2);
  for (int k = 0; k < 2; ++k) {
    const Eigen::Index i = problem.inliers[static_cast<std::size_t>(k)];
    source.col(k) = problem.source.col(i);
    target.col(k) = problem.target.col(i);
  }
  problem.source = source;
  problem.target = target;
  for (const InsMode mode : {InsMode::kLeveled, InsMode::kFused}) {
    EXPECT_LE(RotationErrorDeg(Solve(problem, mode), problem), 1e-5);
  }
}

TEST(InsOptions, NamesWhatIsOutOfRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::string error;
  EXPECT_TRUE(InsOptions().IsValid(&error));
  const auto expect_bad = [&](const InsOptions& ins, const std::string& name) {
    EXPECT_FALSE(ins.IsValid(&error));
    EXPECT_THAT(error, HasSubstr(name));
    const PoseSummary summary =
        SolveQuatroWithIns(Points(3, 0), Points(3, 0), {}, ins);
    EXPECT_EQ(summary.termination, PoseTermination::kInvalidInput);
    EXPECT_EQ(summary.message, error);
  };
  InsOptions ins;
  ins.source_attitude.roll = nan;
  expect_bad(ins, "source_attitude");
  ins = {};
  ins.target_attitude.yaw = nan;
  expect_bad(ins, "target_attitude");
  ins = {};
  ins.attitude_std = 0.0;
  expect_bad(ins, "attitude_std = 0");
  ins = {};
  ins.match_std = -0.1;
  expect_bad(ins, "match_std = -0.1");
  ins = {};
  ins.up = {0.0, 0.0, 2.0};
  expect_bad(ins, "up = (0 0 2)");
  ins.up.setConstant(nan);
  expect_bad(ins, "up");
}

}  // namespace
}  // namespace quatro::ins_test
