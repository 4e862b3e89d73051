// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/estimators/quatro.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "tests/support/matched_problems.h"
#include "tests/support/matchers.h"
#include "tests/support/random_problems.h"

namespace quatro::quatro_test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsSupersetOf;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The four stages of the paper only.
QuatroOptions PaperStages() {
  QuatroOptions options;
  options.replace_missed_optimum = false;
  options.recover_translation = false;
  options.polish = false;
  return options;
}

QuatroSummary Solve(const KnownProblem& problem, const QuatroOptions& options) {
  return SolveQuatro(problem.source, problem.target, options);
}

// Expects no pose and no values that could be mistaken for one.
void ExpectNoAnswer(const QuatroSummary& summary, PoseTermination termination) {
  EXPECT_EQ(summary.termination, termination) << summary.message;
  EXPECT_FALSE(summary.IsUsable());
  EXPECT_FALSE(summary.target_from_source.has_value());
  EXPECT_TRUE(summary.translation_inliers.empty());
  EXPECT_FALSE(summary.message.empty());
}

void ExpectSameBits(const QuatroSummary& a, const QuatroSummary& b) {
  ASSERT_TRUE(a.IsUsable()) << a.message;
  ASSERT_TRUE(b.IsUsable()) << b.message;
  EXPECT_EQ(a.target_from_source->ToMatrix(), b.target_from_source->ToMatrix());
  EXPECT_EQ(a.yaw, b.yaw);
  EXPECT_EQ(a.num_consistent, b.num_consistent);
  EXPECT_EQ(a.num_rotation_inliers, b.num_rotation_inliers);
  EXPECT_EQ(a.num_translation_inliers, b.num_translation_inliers);
}

// The largest error of the pose at the points [m].
double PoseError(const QuatroSummary& summary, const KnownProblem& problem) {
  return LargestDisplacement(*summary.target_from_source,
                             problem.true_target_from_source,
                             problem.source);
}

// The tests below run with the stages of the paper only, and with all stages.
class QuatroTest : public ::testing::TestWithParam<bool> {
 protected:
  const QuatroOptions options_ = GetParam() ? QuatroOptions() : PaperStages();
  const KnownProblem problem_ =
      MakeMatchedProblem({.num_inliers = 40, .num_outliers = 160}, /*seed=*/1);
};

INSTANTIATE_TEST_SUITE_P(
    , QuatroTest, ::testing::Values(false, true), [](const auto& parameter) {
      return parameter.param ? "WithExtensions" : "PaperStages";
    });

TEST_P(QuatroTest, RecoversThePoseFromNoneTo95PercentOutliers) {
  constexpr Eigen::Index kNumMatches = 600;
  for (const Eigen::Index num_inliers : {600, 300, 120, 60, 30}) {
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      const KnownProblem problem =
          MakeMatchedProblem({.num_inliers = num_inliers,
                              .num_outliers = kNumMatches - num_inliers,
                              .yaw = 1.5 * static_cast<double>(seed) - 3.0},
                             seed);
      const QuatroSummary summary = Solve(problem, options_);
      ASSERT_TRUE(summary.IsUsable()) << summary.message;
      EXPECT_THAT(
          summary.yaw,
          IsAngleNear(Yaw(problem.true_target_from_source.rotation), 5e-3))
          << num_inliers << " inliers, seed " << seed;
      EXPECT_LE(PoseError(summary, problem), 0.3)
          << num_inliers << " inliers, seed " << seed;
      EXPECT_THAT(summary.translation_inliers, IsSupersetOf(problem.inliers))
          << num_inliers << " inliers, seed " << seed;
    }
  }
}

TEST_P(QuatroTest, SummaryCountsWhatItLists) {
  const QuatroSummary summary = Solve(problem_, options_);
  ASSERT_TRUE(summary.IsUsable()) << summary.message;
  EXPECT_EQ(summary.termination, PoseTermination::kSolved);
  EXPECT_EQ(summary.num_needed, 2);
  EXPECT_EQ(summary.num_matches, 200);
  EXPECT_EQ(summary.num_consistent,
            static_cast<Eigen::Index>(summary.consistent.size()));
  EXPECT_EQ(summary.num_translation_inliers,
            static_cast<Eigen::Index>(summary.translation_inliers.size()));
  EXPECT_EQ(summary.num_tims, summary.num_consistent);
  EXPECT_LE(summary.num_rotation_inliers, summary.num_tims);
  EXPECT_TRUE(std::ranges::is_sorted(summary.consistent));
  EXPECT_TRUE(std::ranges::is_sorted(summary.translation_inliers));
}

TEST_P(QuatroTest, TranslationInliersAreWithinTheNoiseBound) {
  const QuatroSummary summary = Solve(problem_, options_);
  ASSERT_TRUE(summary.IsUsable()) << summary.message;
  const Points error =
      problem_.target - summary.target_from_source->Apply(problem_.source);
  EXPECT_GE(summary.translation_inliers.size(), 10u);
  for (const Eigen::Index i : summary.translation_inliers) {
    EXPECT_LE(error.col(i).cwiseAbs().maxCoeff(), options_.noise_bound + 1e-9)
        << "match " << i;
  }
}

// Without pruning, outliers reach the rotation stage.
TEST_P(QuatroTest, WeightsTellRightMatchesFromWrongOnes) {
  QuatroOptions options = options_;
  options.pruning = Pruning::kNone;
  const KnownProblem problem =
      MakeMatchedProblem({.num_inliers = 120, .num_outliers = 40}, 3);
  for (const YawSolver solver : {YawSolver::kGnc, YawSolver::kExact}) {
    options.yaw_solver = solver;
    const QuatroSummary summary = Solve(problem, options);
    ASSERT_EQ(summary.match_weights.size(), summary.consistent.size());
    double right = 0.0, wrong = 0.0;
    for (std::size_t k = 0; k < summary.consistent.size(); ++k) {
      const double weight = summary.match_weights[k];
      ASSERT_GE(weight, 0.0);
      ASSERT_LE(weight, 1.0);
      (std::ranges::binary_search(problem.inliers, summary.consistent[k])
           ? right
           : wrong) += weight;
    }
    EXPECT_GT(right / 120.0, 0.85);
    EXPECT_LT(wrong / 40.0, 0.15);
  }
}

TEST_P(QuatroTest, OrderOfMatchesDoesNotMatterBitForBit) {
  const QuatroSummary expected = Solve(problem_, options_);
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const auto order = RandomPermutation(problem_.source.cols(), seed);
    const QuatroSummary permuted =
        SolveQuatro(Reordered(problem_.source, order),
                    Reordered(problem_.target, order),
                    options_);
    ExpectSameBits(permuted, expected);
    // The same matches, renumbered.
    std::vector<Eigen::Index> inliers;
    for (const Eigen::Index k : permuted.translation_inliers) {
      inliers.push_back(order[static_cast<std::size_t>(k)]);
    }
    std::ranges::sort(inliers);
    EXPECT_EQ(inliers, expected.translation_inliers) << "seed " << seed;
  }
}

TEST_P(QuatroTest, RepeatedMatchesCountOnceBitForBit) {
  const QuatroSummary expected = Solve(problem_, options_);
  const Eigen::Index n = problem_.source.cols();
  auto order = RandomPermutation(n, 1);
  for (int k = 0; k < 100; ++k) order.push_back(k);  // Repeats some matches.
  const QuatroSummary repeated = SolveQuatro(Reordered(problem_.source, order),
                                             Reordered(problem_.target, order),
                                             options_);
  ExpectSameBits(repeated, expected);
  EXPECT_EQ(repeated.num_matches, n);
  // Copies are all included or all excluded.
  std::vector<Eigen::Index> originals;
  for (const Eigen::Index k : repeated.translation_inliers) {
    originals.push_back(order[static_cast<std::size_t>(k)]);
  }
  std::ranges::sort(originals);
  const auto end = std::unique(originals.begin(), originals.end());
  EXPECT_GT(originals.end() - end, 0);
  originals.erase(end, originals.end());
  EXPECT_EQ(originals, expected.translation_inliers);
}

TEST_P(QuatroTest, NumberOfThreadsDoesNotMatterBitForBit) {
  QuatroOptions options = options_;
  const QuatroSummary expected = Solve(problem_, options);
  for (const int num_threads : {0, 2, 3}) {
    options.num_threads = num_threads;
    ExpectSameBits(Solve(problem_, options), expected);
  }
}

TEST_P(QuatroTest, TurningAndMovingTheTargetDoesTheSameToThePose) {
  const QuatroSummary base = Solve(problem_, options_);
  const Rigid3 motion{RotationZ(-2.2), {-30.0, 12.0, 3.0}};
  const QuatroSummary moved =
      SolveQuatro(problem_.source, motion.Apply(problem_.target), options_);
  ASSERT_TRUE(moved.IsUsable()) << moved.message;
  EXPECT_LE(LargestDisplacement(*moved.target_from_source,
                                motion * *base.target_from_source,
                                problem_.source),
            0.05);
}

TEST_P(QuatroTest, SwappingSourceAndTargetInvertsThePose) {
  const QuatroSummary forward = Solve(problem_, options_);
  const QuatroSummary backward =
      SolveQuatro(problem_.target, problem_.source, options_);
  ASSERT_TRUE(backward.IsUsable()) << backward.message;
  EXPECT_EQ(backward.consistent, forward.consistent);
  EXPECT_THAT(backward.yaw, IsAngleNear(-forward.yaw, 1e-6));
  // The translation is optimal on each axis, and the axes of the two frames
  // differ by a rotation.
  EXPECT_LE(LargestDisplacement(Inverse(*backward.target_from_source),
                                *forward.target_from_source,
                                problem_.source),
            0.5 * options_.noise_bound);
}

TEST_P(QuatroTest, CoordinatesOfTenThousandKilometresAreAsGood) {
  const Eigen::Vector3d far(1e7, -2e7, 1e4);  // [m], e.g. UTM.
  KnownProblem moved = problem_;
  moved.source.colwise() += far;
  moved.target.colwise() += far;
  const QuatroSummary summary = Solve(moved, options_);
  ASSERT_TRUE(summary.IsUsable()) << summary.message;
  // The error is small at the points, not necessarily at the distant origin.
  const Points error =
      summary.target_from_source->Apply(moved.source) - moved.target;
  for (const Eigen::Index i : problem_.inliers) {
    EXPECT_LE(error.col(i).cwiseAbs().maxCoeff(), 0.3) << "match " << i;
  }
  EXPECT_THAT(summary.yaw, IsAngleNear(2.0, 5e-3));
}

TEST_P(QuatroTest, AMatchAtTheEndOfTheWorldChangesNothing) {
  KnownProblem problem = problem_;
  const Eigen::Index n = problem.source.cols();
  for (const double far : {1e7, 1e12}) {
    problem.source.conservativeResize(3, n + 1);
    problem.target.conservativeResize(3, n + 1);
    problem.source.col(n).setConstant(far);
    problem.target.col(n).setConstant(-far);
    const QuatroSummary summary = Solve(problem, options_);
    ASSERT_TRUE(summary.IsUsable()) << summary.message;
    EXPECT_THAT(summary.yaw, IsAngleNear(2.0, 5e-3)) << far << " m";
    EXPECT_THAT(summary.translation_inliers, IsSupersetOf(problem.inliers))
        << far << " m";
  }
}

// Cliques of one, two and three inliers among mutually inconsistent outliers.
class SmallCliqueTest : public QuatroTest {
 protected:
  static constexpr double kNoise = 0.02;  // [m]

  KnownProblem ProblemWith(Eigen::Index num_inliers, std::uint64_t seed) const {
    return MakeInconsistentProblem(
        {.num_inliers = num_inliers, .num_outliers = 40, .noise = kNoise},
        2.0 * options_.noise_bound,
        seed);
  }
};

INSTANTIATE_TEST_SUITE_P(,
                         SmallCliqueTest,
                         ::testing::Values(false, true),
                         [](const auto& parameter) {
                           return parameter.param ? "WithExtensions"
                                                  : "PaperStages";
                         });

TEST_P(SmallCliqueTest, TwoOrThreeTrueMatchesAreEnoughForTheYaw) {
  for (const Eigen::Index num_inliers : {2, 3}) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      const KnownProblem problem = ProblemWith(num_inliers, seed);
      const QuatroSummary summary = Solve(problem, options_);
      ASSERT_TRUE(summary.IsUsable()) << summary.message;
      EXPECT_EQ(summary.num_tims, num_inliers == 2 ? 1 : 3);
      EXPECT_EQ(summary.consistent, problem.inliers);
      // The largest yaw error: both ends of the longest difference have the
      // largest noise.
      double longest = 0.0;
      for (const Eigen::Index i : problem.inliers) {
        longest = std::max(
            longest,
            (problem.source.col(i) - problem.source.col(0)).head<2>().norm());
      }
      EXPECT_THAT(summary.yaw, IsAngleNear(2.0, 4.0 * kNoise / longest))
          << num_inliers << " inliers, seed " << seed;
      EXPECT_LE((*summary.target_from_source *
                     Eigen::Vector3d(problem.source.col(0)) -
                 problem.target.col(0))
                    .cwiseAbs()
                    .maxCoeff(),
                options_.noise_bound)
          << num_inliers << " inliers, seed " << seed;
    }
  }
}

TEST_P(SmallCliqueTest, OneTrueMatchIsNoAnswer) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const QuatroSummary summary = Solve(ProblemWith(1, seed), options_);
    ExpectNoAnswer(summary, PoseTermination::kInsufficient);
    EXPECT_EQ(summary.num_consistent, 1) << "seed " << seed;
    EXPECT_THAT(summary.message,
                HasSubstr("at most 1 of 41 matches are consistent"));
  }
}

TEST_P(SmallCliqueTest, NeitherIsACoreWithoutEdges) {
  QuatroOptions options = options_;
  options.pruning = Pruning::kMaxCore;
  ExpectNoAnswer(Solve(ProblemWith(1, 0), options),
                 PoseTermination::kInsufficient);
}

TEST_P(SmallCliqueTest, OneDifferenceGivesItsExactYaw) {
  Points source(3, 2);
  source << 1.0, 7.0,  //
      2.0, -3.0,       //
      0.5, 0.8;
  for (const double yaw : {0.0, 1e-6, 1.0, 3.1, -2.0, M_PI}) {
    const Rigid3 motion{RotationZ(yaw), {3.0, 4.0, 5.0}};
    Points target = motion.Apply(source);
    target(2, 1) += 0.1;  // Heights have no influence.
    const QuatroSummary summary = SolveQuatro(source, target, options_);
    ASSERT_TRUE(summary.IsUsable()) << summary.message;
    EXPECT_EQ(summary.num_tims, 1);
    EXPECT_THAT(summary.yaw, IsAngleNear(yaw, 1e-14));
  }
}

TEST_P(QuatroTest, NoMatchesAreNoAnswer) {
  const QuatroSummary summary =
      SolveQuatro(Points(3, 0), Points(3, 0), options_);
  ExpectNoAnswer(summary, PoseTermination::kInsufficient);
  EXPECT_EQ(summary.num_matches, 0);
}

TEST_P(QuatroTest, OneMatchIsNoAnswer) {
  const QuatroSummary summary = SolveQuatro(
      problem_.source.leftCols(1), problem_.target.leftCols(1), options_);
  ExpectNoAnswer(summary, PoseTermination::kInsufficient);
  EXPECT_EQ(summary.num_matches, 1);
}

TEST_P(QuatroTest, CopiesOfOneMatchAreNoAnswer) {
  const QuatroSummary summary =
      SolveQuatro(problem_.source.leftCols(1).replicate(1, 50),
                  problem_.target.leftCols(1).replicate(1, 50),
                  options_);
  ExpectNoAnswer(summary, PoseTermination::kInsufficient);
  EXPECT_EQ(summary.num_matches, 1);
}

TEST_P(QuatroTest, MatchesOnALevelLineHoldTheYaw) {
  Points source = Points::Zero(3, 30);
  source.row(0).setLinSpaced(30, -20.0, 20.0);
  const QuatroSummary summary = SolveQuatro(
      source, problem_.true_target_from_source.Apply(source), options_);
  ASSERT_TRUE(summary.IsUsable()) << summary.message;
  EXPECT_THAT(summary.yaw, IsAngleNear(2.0, 1e-12));
}

TEST_P(QuatroTest, MatchesOnAPlumbLineHoldNone) {
  Points source = Points::Zero(3, 30);
  source.row(2).setLinSpaced(30, 0.0, 20.0);
  const Points target = source.colwise() + Eigen::Vector3d(4.0, 5.0, 6.0);
  const QuatroSummary summary = SolveQuatro(source, target, options_);
  ExpectNoAnswer(summary, PoseTermination::kDegenerate);
  EXPECT_THAT(summary.message, HasSubstr("not constrain the heading"));
}

TEST_P(QuatroTest, MatchesOnAPlumbLineWithNoiseHoldNone) {
  // The noise of a pole determines some heading, which is not that of the pose.
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    KnownProblem problem =
        MakeMatchedProblem({.num_inliers = 30, .num_outliers = 0}, seed);
    Random random(seed);
    for (const Eigen::Index i : problem.inliers) {
      const Eigen::Vector3d noise =
          RandomPointsInBox(1, Eigen::Vector3d::Constant(0.05), &random);
      problem.source.col(i) << 10.0, 5.0, 8.0 * random.Uniform();
      problem.target.col(i) = problem.true_target_from_source *
                                  Eigen::Vector3d(problem.source.col(i)) +
                              noise;
    }
    ExpectNoAnswer(Solve(problem, options_), PoseTermination::kDegenerate);
  }
}

TEST_P(QuatroTest, PointsThatAreNotFiniteAreRefused) {
  for (const double bad : {kNaN, kInfinity, -kInfinity}) {
    KnownProblem problem = problem_;
    problem.source(1, 17) = bad;
    ExpectNoAnswer(Solve(problem, options_), PoseTermination::kInvalidInput);
    problem = problem_;
    problem.target(2, 3) = bad;
    const QuatroSummary summary = Solve(problem, options_);
    ExpectNoAnswer(summary, PoseTermination::kInvalidInput);
    EXPECT_THAT(summary.message, HasSubstr("not finite"));
  }
}

// Faults of other implementations.
TEST_P(QuatroTest, NoiseBoundOfOneCallDoesNotRuleTheNext) {
  QuatroOptions narrow = options_;
  narrow.noise_bound = 0.03;
  QuatroOptions wide = options_;
  wide.noise_bound = 2.0;
  const QuatroSummary wide_first = Solve(problem_, wide);
  const QuatroSummary narrow_second = Solve(problem_, narrow);
  const QuatroSummary wide_third = Solve(problem_, wide);
  const QuatroSummary narrow_fourth = Solve(problem_, narrow);
  ExpectSameBits(wide_first, wide_third);
  ExpectSameBits(narrow_second, narrow_fourth);
  EXPECT_GT(wide_first.num_consistent, narrow_second.num_consistent);
}

TEST_P(QuatroTest, EachCallDividesByItsOwnNoiseBound) {
  // mu = 1 / (2 max_r2 - 1) gives the largest residual of the plain fit in
  // units of the bound. In meters it must not depend on the bound.
  const auto largest_residual = [&](double noise_bound) {
    QuatroOptions options = options_;
    options.pruning = Pruning::kNone;
    options.noise_bound = noise_bound;
    const double mu = Solve(problem_, options).gnc.iterations.front().mu;
    return std::sqrt(0.5 * (1.0 / mu + 1.0)) * noise_bound;
  };
  const double expected = largest_residual(0.3);
  for (const double noise_bound : {0.15, 1.0, 0.3, 0.6}) {
    EXPECT_NEAR(largest_residual(noise_bound), expected, 1e-9 * expected)
        << "noise bound " << noise_bound << " m";
  }
}

TEST_P(QuatroTest, SecondCallGivesTheSameBits) {
  QuatroOptions options = options_;
  options.tim_layout = TimLayout::kRandom;
  const QuatroSummary first = Solve(problem_, options);
  Solve(MakeMatchedProblem({}, /*seed=*/99), options_);
  ExpectSameBits(Solve(problem_, options), first);
}

TEST(QuatroYaw, HeightsHaveNoPartInIt) {
  // Matches that are inliers in x and y but have errors of meters in z.
  QuatroOptions options = PaperStages();
  options.consistency_test = ConsistencyTest::kPlanar;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    KnownProblem problem = MakeMatchedProblem(
        {.num_inliers = 40, .num_outliers = 80, .noise = 0.0}, seed);
    Random random(seed);
    for (const Eigen::Index i : problem.inliers) {
      problem.target(2, i) += 5.0 * SignedUniform(&random);
    }
    const QuatroSummary summary = Solve(problem, options);
    ASSERT_TRUE(summary.IsUsable()) << summary.message;
    EXPECT_THAT(summary.yaw, IsAngleNear(2.0, 1e-3)) << "seed " << seed;
    EXPECT_GE(summary.num_consistent, 40) << "seed " << seed;
  }
}

TEST(QuatroExtensions, RecoverTrueMatchesThatTheCliqueLeftOut) {
  // 20 inliers, and 180 matches with errors only in z.
  int num_recovered = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    KnownProblem problem =
        MakeMatchedProblem({.num_inliers = 200, .num_outliers = 0}, seed);
    Random random(seed);
    for (Eigen::Index i = 20; i < 200; ++i) {
      const double sign = random.Below(2) == 0 ? -1.0 : 1.0;
      problem.target(2, i) += sign * (0.5 + 2.5 * random.Uniform());
    }
    QuatroOptions options;
    options.consistency_test = ConsistencyTest::kPlanar;
    options.noise_bound = 0.15;
    options.polish = false;
    const QuatroSummary summary = Solve(problem, options);
    ASSERT_TRUE(summary.IsUsable()) << summary.message;
    EXPECT_THAT(summary.yaw, IsAngleNear(2.0, 1e-3)) << "seed " << seed;
    num_recovered += PoseError(summary, problem) < 0.3;
  }
  EXPECT_GE(num_recovered, 8);
}

// Every option has an effect.
class QuatroOptionTest : public ::testing::Test {
 protected:
  const KnownProblem problem_ =
      MakeMatchedProblem({.num_inliers = 60, .num_outliers = 60}, /*seed=*/1);
  QuatroOptions options_ = PaperStages();

  QuatroSummary Run() const { return Solve(problem_, options_); }
};

TEST_F(QuatroOptionTest, PruningDecidesWhatIsKept) {
  const QuatroSummary clique = Run();
  options_.pruning = Pruning::kExactClique;
  const QuatroSummary exact = Run();
  options_.pruning = Pruning::kMaxCore;
  const QuatroSummary core = Run();
  options_.pruning = Pruning::kNone;
  const QuatroSummary none = Run();
  EXPECT_GE(clique.num_consistent, 60);
  EXPECT_GE(exact.num_consistent, clique.num_consistent);
  EXPECT_GE(core.num_consistent, clique.num_consistent);
  EXPECT_EQ(none.num_consistent, 120);
  EXPECT_LT(clique.num_consistent, 120);
  EXPECT_EQ(none.stage_times.size() + 2, clique.stage_times.size());
}

TEST_F(QuatroOptionTest, TimLayoutDecidesHowManyThereAre) {
  const Eigen::Index n = Run().num_consistent;
  EXPECT_EQ(Run().num_tims, n);
  options_.tim_layout = TimLayout::kComplete;
  EXPECT_EQ(Run().num_tims, n * (n - 1) / 2);
  options_.tim_layout = TimLayout::kRandom;
  options_.num_random_tims = 17;
  const QuatroSummary random = Run();
  EXPECT_EQ(random.num_tims, 17);
  options_.seed = 1;
  EXPECT_NE(Run().yaw, random.yaw);
}

TEST_F(QuatroOptionTest, SurrogateShowsInTheWeights) {
  options_.pruning = Pruning::kNone;
  const Weights truncated = Run().gnc.weights;
  options_.surrogate = SurrogateType::kGemanMcClure;
  const Weights geman_mcclure = Run().gnc.weights;
  const auto num_between = [](const Weights& weights) {
    return ((weights.array() > 1e-6) && (weights.array() < 1.0 - 1e-6)).count();
  };
  EXPECT_EQ(num_between(truncated), 0);
  EXPECT_GT(num_between(geman_mcclure), 20);
}

TEST_F(QuatroOptionTest, GncStartShowsInTheFirstMu) {
  options_.pruning = Pruning::kNone;
  const double plain_fit = Run().gnc.iterations.front().mu;
  options_.gnc.start = GncStart::kIdentity;
  const double identity = Run().gnc.iterations.front().mu;
  EXPECT_GT(std::abs(identity - plain_fit), 1e-3 * plain_fit);
}

TEST_F(QuatroOptionTest, GncIterationsAreLimited) {
  options_.pruning = Pruning::kNone;
  EXPECT_GT(Run().gnc.iterations.size(), 2u);
  options_.gnc.max_num_iterations = 2;
  const QuatroSummary limited = Run();
  EXPECT_EQ(limited.gnc.iterations.size(), 2u);
  EXPECT_EQ(limited.gnc.termination, GncTermination::kMaxNumIterations);
}

TEST_F(QuatroOptionTest, TimBoundFactorWidensTheBoundOfDifferences) {
  options_.pruning = Pruning::kNone;
  options_.noise_bound = 0.04;  // Some noise exceeds it.
  options_.tim_bound_factor = 1.0;
  const QuatroSummary narrow = Run();
  options_.tim_bound_factor = 3.0;
  const QuatroSummary wide = Run();
  EXPECT_GT(wide.num_rotation_inliers, narrow.num_rotation_inliers);
  EXPECT_NEAR(wide.gnc.iterations.front().mu,
              9.0 * narrow.gnc.iterations.front().mu,
              0.01 * wide.gnc.iterations.front().mu);
}

TEST_F(QuatroOptionTest, NoiseBoundDecidesWhoIsAnInlier) {
  const QuatroSummary wide = Run();
  options_.noise_bound = 0.03;  // Less than the noise.
  const QuatroSummary narrow = Run();
  EXPECT_GE(wide.num_translation_inliers, 60);
  EXPECT_LT(narrow.num_translation_inliers, 40);
  EXPECT_GT(narrow.num_translation_inliers, 0);
}

TEST_F(QuatroOptionTest, ConsistencyTestAndTiltDecideWhatAgrees) {
  KnownProblem raised = problem_;
  for (const Eigen::Index i : raised.inliers) {
    raised.target(2, i) += 0.03 * raised.target(0, i);  // A slope.
    raised.target(2, i) *= 1.3;
  }
  options_.consistency_test = ConsistencyTest::kPlanar;
  EXPECT_GE(Solve(raised, options_).num_consistent, 60);
  options_.consistency_test = ConsistencyTest::kPlanarAndHeight;
  options_.max_tilt = 0.0;
  const auto without_tilt = Solve(raised, options_).num_consistent;
  options_.max_tilt = 0.2;
  const auto with_tilt = Solve(raised, options_).num_consistent;
  EXPECT_LT(without_tilt, with_tilt);
  EXPECT_LT(without_tilt, 60);
}

TEST_F(QuatroOptionTest, ExactYawSolverTakesTheSweep) {
  options_.yaw_solver = YawSolver::kExact;
  const QuatroSummary summary = Run();
  ASSERT_TRUE(summary.IsUsable()) << summary.message;
  EXPECT_TRUE(summary.is_yaw_exact);
  EXPECT_TRUE(summary.gnc.iterations.empty());
  EXPECT_THAT(summary.yaw, IsAngleNear(2.0, 5e-3));
}

TEST_F(QuatroOptionTest, CertificateIsNeverNegativeAndClosesWhereItIsReplaced) {
  options_.pruning = Pruning::kNone;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const KnownProblem problem =
        MakeMatchedProblem({.num_inliers = 20, .num_outliers = 80}, seed);
    const QuatroSummary graduated = Solve(problem, options_);
    ASSERT_TRUE(graduated.certificate.has_value());
    if (graduated.certificate->gap) {
      EXPECT_GE(*graduated.certificate->gap, -1e-9) << "seed " << seed;
    }
    EXPECT_FALSE(graduated.is_yaw_exact);
  }
}

TEST_F(QuatroOptionTest, PolishFindsATilt) {
  KnownProblem tilted = problem_;
  tilted.true_target_from_source.rotation =
      RotationZ(2.0) *
      Eigen::AngleAxisd(0.03, Eigen::Vector3d::UnitX()).toRotationMatrix();
  for (const Eigen::Index i : tilted.inliers) {
    tilted.target.col(i) =
        tilted.true_target_from_source * Eigen::Vector3d(tilted.source.col(i));
  }
  options_.recover_translation = true;
  const QuatroSummary level = Solve(tilted, options_);
  options_.polish = true;
  const QuatroSummary polished = Solve(tilted, options_);
  ASSERT_TRUE(polished.IsUsable()) << polished.message;
  EXPECT_GT(PoseError(level, tilted), 0.5);
  EXPECT_LT(PoseError(polished, tilted), 0.05) << polished.Note("polish");
  EXPECT_FALSE(level.unpolished_target_from_source.has_value());
  EXPECT_TRUE(polished.unpolished_target_from_source.has_value());
}

TEST(QuatroOptions, DefaultsAreValid) {
  std::string error;
  EXPECT_TRUE(QuatroOptions().IsValid(&error)) << error;
  EXPECT_TRUE(error.empty());
}

TEST(QuatroOptions, ErrorNamesTheFieldAndNothingIsTried) {
  const auto expect_error = [](const auto& change, const char* field) {
    QuatroOptions options;
    change(&options);
    std::string error;
    EXPECT_FALSE(options.IsValid(&error)) << field;
    EXPECT_THAT(error, HasSubstr(field));
    const QuatroSummary summary = Solve(MakeMatchedProblem({}, 1), options);
    ExpectNoAnswer(summary, PoseTermination::kInvalidInput);
    EXPECT_EQ(summary.message, error);
    EXPECT_EQ(summary.num_matches, 0);
  };
  using Options = QuatroOptions*;
  expect_error([](Options o) { o->noise_bound = 0.0; }, "noise_bound = 0");
  expect_error([](Options o) { o->noise_bound = -1.0; }, "noise_bound = -1");
  expect_error([](Options o) { o->noise_bound = kNaN; }, "noise_bound = nan");
  expect_error([](Options o) { o->noise_bound = kInfinity; },
               "noise_bound = inf");
  expect_error([](Options o) { o->tim_bound_factor = 0.0; },
               "tim_bound_factor = 0");
  expect_error([](Options o) { o->tim_bound_factor = kInfinity; },
               "tim_bound_factor = inf");
  expect_error([](Options o) { o->max_tilt = -0.1; }, "max_tilt = -0.1");
  expect_error([](Options o) { o->max_tilt = kNaN; }, "max_tilt = nan");
  expect_error([](Options o) { o->num_random_tims = 0; },
               "num_random_tims = 0");
  expect_error([](Options o) { o->num_threads = -1; }, "num_threads = -1");
  expect_error([](Options o) { o->clique_time_limit_seconds = -1.0; },
               "time_limit_seconds = -1");
  expect_error([](Options o) { o->certificate_tolerance = kNaN; },
               "certificate_tolerance = nan");
  expect_error([](Options o) { o->gnc.mu_step = 1.0; }, "mu_step = 1");
}

TEST(QuatroSummary, StartsPessimistic) {
  ExpectNoAnswer(QuatroSummary(), PoseTermination::kInvalidInput);
}

}  // namespace
}  // namespace quatro::quatro_test
