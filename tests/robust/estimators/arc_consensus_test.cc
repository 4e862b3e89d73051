// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/estimators/arc_consensus.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "features/base/degree.h"
#include "tests/support/matched_problems.h"
#include "tests/support/matchers.h"
#include "tests/support/random_problems.h"

namespace quatro::arc_consensus_test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsSupersetOf;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

PoseSummary Solve(const KnownProblem& problem,
                  const ArcConsensusOptions& options = {}) {
  return SolveArcConsensus(problem.source, problem.target, options);
}

void ExpectRight(const PoseSummary& summary,
                 const KnownProblem& problem,
                 const std::string& which) {
  ASSERT_TRUE(summary.IsUsable()) << which << ": " << summary.message;
  EXPECT_LE(AngleBetween(summary.target_from_source->rotation,
                         problem.true_target_from_source.rotation),
            1.0 * kDegree)
      << which;
  EXPECT_LE(LargestDisplacement(*summary.target_from_source,
                                problem.true_target_from_source,
                                problem.source),
            0.3)
      << which;
}

void ExpectNoAnswer(const PoseSummary& summary, PoseTermination termination) {
  EXPECT_EQ(summary.termination, termination) << summary.message;
  EXPECT_FALSE(summary.IsUsable());
  EXPECT_TRUE(summary.translation_inliers.empty());
  EXPECT_FALSE(summary.message.empty());
}

void ExpectSameBits(const PoseSummary& a, const PoseSummary& b) {
  ASSERT_TRUE(a.IsUsable()) << a.message;
  ASSERT_TRUE(b.IsUsable()) << b.message;
  EXPECT_EQ(a.target_from_source->ToMatrix(), b.target_from_source->ToMatrix());
  EXPECT_EQ(a.num_tims, b.num_tims);
  EXPECT_EQ(a.num_consistent, b.num_consistent);
  EXPECT_EQ(a.num_rotation_inliers, b.num_rotation_inliers);
  EXPECT_EQ(a.num_translation_inliers, b.num_translation_inliers);
}

KnownProblem WithOutliers(Eigen::Index num_matches,
                          double ratio,
                          std::uint64_t seed) {
  const auto num_outliers = static_cast<Eigen::Index>(
      std::llround(ratio * static_cast<double>(num_matches)));
  return MakeMatchedProblem({.num_inliers = num_matches - num_outliers,
                             .num_outliers = num_outliers,
                             .noise = 0.1,
                             .yaw = 1.5 * static_cast<double>(seed) - 3.0},
                            seed);
}

// More pairs than are drawn, so that the result depends on the draw.
class ArcConsensusTest : public ::testing::Test {
 protected:
  const KnownProblem problem_ = WithOutliers(2000, 0.9, /*seed=*/1);
};

TEST_F(ArcConsensusTest, RecoversThePoseUnder95To99PercentOutliers) {
  for (const Eigen::Index num_matches : {1000, 5000, 20000}) {
    for (const double ratio : {0.95, 0.98, 0.99}) {
      for (std::uint64_t seed = 0; seed < 3; ++seed) {
        const KnownProblem problem = WithOutliers(num_matches, ratio, seed);
        const PoseSummary summary = Solve(problem);
        ExpectRight(summary,
                    problem,
                    std::to_string(num_matches) + " matches, " +
                        std::to_string(ratio) + ", seed " +
                        std::to_string(seed));
        EXPECT_GE(summary.num_translation_inliers,
                  static_cast<Eigen::Index>(problem.inliers.size()) / 2);
      }
    }
  }
}

TEST_F(ArcConsensusTest, FindsAllOfTheTrueMatches) {
  const PoseSummary summary = Solve(problem_);
  ASSERT_TRUE(summary.IsUsable()) << summary.message;
  EXPECT_THAT(summary.translation_inliers, IsSupersetOf(problem_.inliers));
}

TEST_F(ArcConsensusTest, SummaryCountsWhatItLists) {
  const PoseSummary summary = Solve(problem_);
  EXPECT_EQ(summary.termination, PoseTermination::kSolved);
  EXPECT_EQ(summary.num_needed, 2);
  EXPECT_EQ(summary.num_matches, 2000);
  EXPECT_EQ(summary.num_consistent,
            static_cast<Eigen::Index>(summary.consistent.size()));
  EXPECT_EQ(summary.num_translation_inliers,
            static_cast<Eigen::Index>(summary.translation_inliers.size()));
  EXPECT_TRUE(std::ranges::is_sorted(summary.consistent));
  EXPECT_TRUE(std::ranges::is_sorted(summary.translation_inliers));
  EXPECT_LE(summary.num_rotation_inliers, summary.num_tims);
  const Points error =
      problem_.target - summary.target_from_source->Apply(problem_.source);
  EXPECT_GE(summary.translation_inliers.size(), 10u);
  for (const Eigen::Index i : summary.translation_inliers) {
    EXPECT_LE(error.col(i).cwiseAbs().maxCoeff(), 0.3 + 1e-9) << "match " << i;
  }
}

TEST_F(ArcConsensusTest, OrderOfMatchesDoesNotMatterBitForBit) {
  const PoseSummary expected = Solve(problem_);
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const auto order = RandomPermutation(problem_.source.cols(), seed);
    ExpectSameBits(SolveArcConsensus(Reordered(problem_.source, order),
                                     Reordered(problem_.target, order),
                                     {}),
                   expected);
  }
}

TEST_F(ArcConsensusTest, RepeatedMatchesCountOnceBitForBit) {
  auto order = RandomPermutation(problem_.source.cols(), 1);
  for (int k = 0; k < 700; ++k) order.push_back(k);
  const PoseSummary repeated = SolveArcConsensus(
      Reordered(problem_.source, order), Reordered(problem_.target, order), {});
  ExpectSameBits(repeated, Solve(problem_));
  EXPECT_EQ(repeated.num_matches, 2000);
  EXPECT_GT(static_cast<Eigen::Index>(repeated.translation_inliers.size()),
            repeated.num_translation_inliers);
}

TEST_F(ArcConsensusTest, NumberOfThreadsDoesNotMatterBitForBit) {
  const PoseSummary drawn = Solve(problem_);
  const KnownProblem few = WithOutliers(500, 0.9, 2);
  const PoseSummary all = Solve(few);
  for (const int num_threads : {0, 2, 3, 7}) {
    ArcConsensusOptions options;
    options.num_threads = num_threads;
    ExpectSameBits(Solve(problem_, options), drawn);
    ExpectSameBits(Solve(few, options), all);
  }
}

TEST_F(ArcConsensusTest, SwappingSourceAndTargetInvertsThePose) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const KnownProblem problem = WithOutliers(2000, 0.95, seed);
    const PoseSummary forward = Solve(problem);
    const PoseSummary backward =
        SolveArcConsensus(problem.target, problem.source, {});
    ASSERT_TRUE(forward.IsUsable() && backward.IsUsable());
    EXPECT_LE(LargestDisplacement(Inverse(*backward.target_from_source),
                                  *forward.target_from_source,
                                  problem.source),
              0.3)
        << "seed " << seed;
  }
}

TEST_F(ArcConsensusTest, TurningAndMovingTheTargetDoesTheSameToThePose) {
  const PoseSummary base = Solve(problem_);
  const Rigid3 motion{RotationZ(-2.2), {-30.0, 12.0, 3.0}};
  const PoseSummary moved =
      SolveArcConsensus(problem_.source, motion.Apply(problem_.target), {});
  ASSERT_TRUE(moved.IsUsable()) << moved.message;
  EXPECT_LE(LargestDisplacement(*moved.target_from_source,
                                motion * *base.target_from_source,
                                problem_.source),
            0.1);
}

TEST_F(ArcConsensusTest, CoordinatesOfTenThousandKilometresAreAsGood) {
  KnownProblem moved = problem_;
  const Eigen::Vector3d far(1e7, -2e7, 1e4);  // [m]
  moved.source.colwise() += far;
  moved.target.colwise() += far;
  const PoseSummary summary = Solve(moved);
  ASSERT_TRUE(summary.IsUsable()) << summary.message;
  const Points error =
      summary.target_from_source->Apply(moved.source) - moved.target;
  for (const Eigen::Index i : problem_.inliers) {
    EXPECT_LE(error.col(i).cwiseAbs().maxCoeff(), 0.3) << "match " << i;
  }
}

TEST_F(ArcConsensusTest, AMatchAtTheEndOfTheWorldChangesNothing) {
  for (const double far : {1e7, 1e12}) {
    KnownProblem problem = problem_;
    problem.source.col(7).setConstant(far);
    problem.target.col(7).setConstant(-far);
    const PoseSummary summary = Solve(problem);
    ASSERT_TRUE(summary.IsUsable()) << summary.message;
    EXPECT_THAT(
        Yaw(summary.target_from_source->rotation),
        IsAngleNear(Yaw(problem.true_target_from_source.rotation), kDegree))
        << far << " m";
  }
}

TEST_F(ArcConsensusTest, SeedDecidesWhatIsDrawn) {
  ArcConsensusOptions options;
  options.num_pairs = 100'000;
  const PoseSummary first = Solve(problem_, options);
  ExpectSameBits(Solve(problem_, options), first);
  options.seed = 1;
  EXPECT_NE(Solve(problem_, options).num_tims, first.num_tims);
}

TEST_F(ArcConsensusTest, NumberOfPairsIsHonoured) {
  // All matches are inliers, and so is every pair that is long enough.
  const KnownProblem problem = MakeMatchedProblem(
      {.num_inliers = 300, .num_outliers = 0, .noise = 0.0}, /*seed=*/1);
  ArcConsensusOptions options;
  options.min_planar_length_factor = 0.0;
  options.num_pairs = 1234;
  EXPECT_EQ(Solve(problem, options).num_tims, 1234);
  options.num_pairs = 300 * 299 / 2 - 1;
  EXPECT_EQ(Solve(problem, options).num_tims, 300 * 299 / 2 - 1);
  options.num_pairs = 300 * 299 / 2;
  EXPECT_EQ(Solve(problem, options).num_tims, 300 * 299 / 2);
  options.num_pairs = 1'000'000;
  EXPECT_EQ(Solve(problem, options).num_tims, 300 * 299 / 2);
}

TEST_F(ArcConsensusTest, PairsThatAreTooShortAreLeftOut) {
  // On a line, one meter apart.
  Points source = Points::Zero(3, 10);
  source.row(0).setLinSpaced(0.0, 9.0);
  const Rigid3 motion{RotationZ(0.5), {1.0, 2.0, 3.0}};
  ArcConsensusOptions options;
  const auto num_tims = [&](double min_planar_length) {
    options.min_planar_length_factor = min_planar_length / options.noise_bound;
    return SolveArcConsensus(source, motion.Apply(source), options).num_tims;
  };
  EXPECT_EQ(num_tims(0.0), 45);
  EXPECT_EQ(num_tims(1.5), 36);
  EXPECT_EQ(num_tims(8.5), 1);
  EXPECT_EQ(num_tims(9.5), 0);
}

TEST_F(ArcConsensusTest, MinimalLengthIsInNoiseBoundsAndNamedInTheReason) {
  Points source = Points::Zero(3, 2);
  source(0, 1) = 0.5;  // [m]
  ArcConsensusOptions options;
  const PoseSummary summary = SolveArcConsensus(source, source, options);
  ExpectNoAnswer(summary, PoseTermination::kInsufficient);
  EXPECT_THAT(summary.message, HasSubstr("at least 3 m apart"));
  options.noise_bound = 0.04;
  EXPECT_TRUE(SolveArcConsensus(source, source, options).IsUsable());
}

TEST_F(ArcConsensusTest, PairsThatNoDoubleResolvesAreLeftOut) {
  Points source = Points::Zero(3, 2);
  source(0, 1) = 1e16;
  EXPECT_EQ(SolveArcConsensus(source, source, {}).num_tims, 0);
}

TEST_F(ArcConsensusTest, HeightsAreHeldToTheTiltAllowed) {
  // Pairs 10 m long that differ in height by 1.1 m = 0.6 m + 0.05 * 10 m.
  Points source = Points::Zero(3, 2);
  source(0, 1) = 10.0;
  Points target = source;
  target(2, 1) = 1.1;
  ArcConsensusOptions options;
  options.max_tilt = 0.049;
  ExpectNoAnswer(SolveArcConsensus(source, target, options),
                 PoseTermination::kInsufficient);
  options.max_tilt = 0.051;
  EXPECT_TRUE(SolveArcConsensus(source, target, options).IsUsable());
}

TEST_F(ArcConsensusTest, NoMatchesOrOneAreNoAnswer) {
  for (const Eigen::Index n : {0, 1}) {
    const PoseSummary summary = SolveArcConsensus(
        problem_.source.leftCols(n), problem_.target.leftCols(n), {});
    ExpectNoAnswer(summary, PoseTermination::kInsufficient);
    EXPECT_EQ(summary.num_matches, n);
    EXPECT_THAT(summary.message, HasSubstr("needs two consistent matches"));
  }
}

TEST_F(ArcConsensusTest, TwoMatchesAreEnough) {
  for (const double yaw : {0.0, 1.0, 3.1, -2.0}) {
    const KnownProblem problem = MakeMatchedProblem(
        {.num_inliers = 2, .num_outliers = 0, .noise = 0.0, .yaw = yaw}, 1);
    const PoseSummary summary = Solve(problem);
    ASSERT_TRUE(summary.IsUsable()) << summary.message;
    EXPECT_EQ(summary.num_tims, 1);
    EXPECT_LE(LargestDisplacement(*summary.target_from_source,
                                  problem.true_target_from_source,
                                  problem.source),
              1e-12)
        << "yaw " << yaw;
  }
}

TEST_F(ArcConsensusTest, OneMatchManyTimesIsNoAnswer) {
  const PoseSummary summary =
      SolveArcConsensus(problem_.source.col(0).replicate(1, 50),
                        problem_.target.col(0).replicate(1, 50),
                        {});
  ExpectNoAnswer(summary, PoseTermination::kInsufficient);
  EXPECT_EQ(summary.num_matches, 1);
}

TEST_F(ArcConsensusTest, MatchesOnALineHoldTheYaw) {
  Random random(1);
  const Points source =
      RandomPointsInBox(50, Eigen::Vector3d(40.0, 0.0, 0.0), &random);
  const Rigid3 motion{RotationZ(2.0), {1.0, 2.0, 3.0}};
  const PoseSummary summary =
      SolveArcConsensus(source, motion.Apply(source), {});
  ASSERT_TRUE(summary.IsUsable()) << summary.message;
  EXPECT_LE(LargestDisplacement(*summary.target_from_source, motion, source),
            1e-10);
}

TEST_F(ArcConsensusTest, MatchesAboveOneAnotherHoldNone) {
  Random random(1);
  const Points source =
      RandomPointsInBox(50, Eigen::Vector3d(0.0, 0.0, 40.0), &random);
  ExpectNoAnswer(SolveArcConsensus(source, source, {}),
                 PoseTermination::kInsufficient);
}

TEST_F(ArcConsensusTest, NoConsistentPairIsNoAnswer) {
  const KnownProblem problem = MakeInconsistentProblem(
      {.num_inliers = 1, .num_outliers = 40}, 0.6, /*seed=*/1);
  const PoseSummary summary = Solve(problem);
  ExpectNoAnswer(summary, PoseTermination::kInsufficient);
  EXPECT_EQ(summary.num_tims, 0);
  EXPECT_THAT(summary.message, HasSubstr("none were found among 41 matches"));
}

TEST_F(ArcConsensusTest, PointsThatAreNotFiniteAreRefused) {
  for (const double bad : {kNaN, kInfinity, -kInfinity}) {
    KnownProblem problem = problem_;
    problem.source(1, 17) = bad;
    ExpectNoAnswer(Solve(problem), PoseTermination::kInvalidInput);
    problem = problem_;
    problem.target(2, 3) = bad;
    const PoseSummary summary = Solve(problem);
    ExpectNoAnswer(summary, PoseTermination::kInvalidInput);
    EXPECT_THAT(summary.message, HasSubstr("not finite"));
  }
}

TEST(ArcConsensusOptions, ErrorNamesTheFieldAndNothingIsTried) {
  std::string none;
  EXPECT_TRUE(ArcConsensusOptions().IsValid(&none)) << none;
  EXPECT_TRUE(none.empty());
  const auto expect_error = [](const ArcConsensusOptions& options,
                               const char* field) {
    std::string error;
    EXPECT_FALSE(options.IsValid(&error)) << field;
    EXPECT_THAT(error, HasSubstr(field));
    const PoseSummary summary = Solve(MakeMatchedProblem({}, 1), options);
    ExpectNoAnswer(summary, PoseTermination::kInvalidInput);
    EXPECT_EQ(summary.message, error);
  };
  expect_error({.noise_bound = 0.0}, "noise_bound = 0");
  expect_error({.noise_bound = kNaN}, "noise_bound = nan");
  expect_error({.noise_bound = kInfinity}, "noise_bound = inf");
  expect_error({.max_tilt = -0.1}, "max_tilt = -0.1");
  expect_error({.max_tilt = 2.0}, "max_tilt = 2");
  expect_error({.max_tilt = kNaN}, "max_tilt = nan");
  expect_error({.num_pairs = 0}, "num_pairs = 0");
  expect_error({.min_planar_length_factor = -1.0},
               "min_planar_length_factor = -1");
  expect_error({.min_planar_length_factor = kNaN},
               "min_planar_length_factor = nan");
  expect_error({.num_threads = -1}, "num_threads = -1");
}

}  // namespace
}  // namespace quatro::arc_consensus_test
