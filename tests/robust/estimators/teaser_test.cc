// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/estimators/teaser.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>

#include "features/base/degree.h"
#include "tests/support/matched_problems.h"
#include "tests/support/pose_problems.h"
#include "tests/support/random_problems.h"

namespace quatro::teaser_test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsSupersetOf;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TeaserSummary Solve(const KnownProblem& problem,
                    const TeaserOptions& options = {}) {
  return SolveTeaser(problem.source, problem.target, options);
}

void ExpectSameBits(const TeaserSummary& a, const TeaserSummary& b) {
  ASSERT_TRUE(a.IsUsable()) << a.message;
  ASSERT_TRUE(b.IsUsable()) << b.message;
  EXPECT_EQ(a.target_from_source->ToMatrix(), b.target_from_source->ToMatrix());
  EXPECT_EQ(a.scale, b.scale);
  EXPECT_EQ(a.num_consistent, b.num_consistent);
  EXPECT_EQ(a.num_rotation_inliers, b.num_rotation_inliers);
  EXPECT_EQ(a.num_translation_inliers, b.num_translation_inliers);
}

TEST(Teaser, RecoversAnyRotationFromNoneTo95PercentOutliers) {
  constexpr Eigen::Index kNumMatches = 600;
  for (const Eigen::Index num_inliers : {600, 300, 120, 60, 30}) {
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      const KnownProblem problem =
          TurnedProblem(num_inliers, kNumMatches - num_inliers, seed);
      const TeaserSummary summary = Solve(problem);
      ASSERT_TRUE(summary.IsUsable()) << summary.message;
      EXPECT_LE(AngleBetween(summary.target_from_source->rotation,
                             problem.true_target_from_source.rotation),
                0.5 * kDegree)
          << num_inliers << " inliers, seed " << seed;
      EXPECT_LE(PoseError(summary, problem), 0.3)
          << num_inliers << " inliers, seed " << seed;
      EXPECT_THAT(summary.translation_inliers, IsSupersetOf(problem.inliers))
          << num_inliers << " inliers, seed " << seed;
      EXPECT_EQ(summary.scale, 1.0);
      EXPECT_EQ(summary.num_needed, 3);
    }
  }
}

TEST(Teaser, EstimatesTheScaleAmongOutliers) {
  TeaserOptions options;
  options.estimate_scale = true;
  for (const double scale : {0.5, 1.0, 2.0}) {
    for (const Eigen::Index num_outliers : {0, 60, 180}) {
      for (std::uint64_t seed = 0; seed < 3; ++seed) {
        KnownProblem problem = TurnedProblem(60, num_outliers, seed);
        problem.source /= scale;
        const TeaserSummary summary = Solve(problem, options);
        ASSERT_TRUE(summary.IsUsable()) << summary.message;
        EXPECT_NEAR(summary.scale, scale, 0.005 * scale)
            << num_outliers << " outliers, seed " << seed;
        problem.source *= scale;
        EXPECT_LE(PoseError(summary, problem), 0.3)
            << "scale " << scale << ", " << num_outliers << " outliers, seed "
            << seed;
      }
    }
  }
}

TEST(Teaser, FewerThanThreeMatchesAreNoAnswer) {
  const KnownProblem problem = TurnedProblem(10, 0, 1);
  for (const Eigen::Index n : {0, 1, 2}) {
    const TeaserSummary summary =
        SolveTeaser(problem.source.leftCols(n), problem.target.leftCols(n), {});
    ExpectNoAnswer(summary, PoseTermination::kInsufficient);
    EXPECT_EQ(summary.num_consistent, n);
    EXPECT_THAT(summary.message, HasSubstr("three consistent matches"));
    TeaserOptions options;
    options.estimate_scale = true;
    ExpectNoAnswer(
        SolveTeaser(
            problem.source.leftCols(n), problem.target.leftCols(n), options),
        PoseTermination::kInsufficient);
  }
  EXPECT_TRUE(
      SolveTeaser(problem.source.leftCols(3), problem.target.leftCols(3), {})
          .IsUsable());
}

TEST(Teaser, MatchesOnALineAreDegenerate) {
  Random random(1);
  const Points source =
      RandomPointsInBox(50, Eigen::Vector3d(40.0, 0.0, 0.0), &random);
  const Rigid3 motion{RandomRotation(1), {1.0, 2.0, 3.0}};
  for (const Rigid3& pose : {Rigid3(), motion}) {
    const TeaserSummary summary = SolveTeaser(source, pose.Apply(source), {});
    ExpectNoAnswer(summary, PoseTermination::kDegenerate);
    EXPECT_THAT(summary.message, HasSubstr("on one line"));
  }
}

TEST(Teaser, SwappingSourceAndTargetInvertsThePose) {
  const KnownProblem problem = TurnedProblem(60, 120, 1);
  const TeaserSummary forward = Solve(problem);
  const TeaserSummary backward =
      SolveTeaser(problem.target, problem.source, {});
  ASSERT_TRUE(forward.IsUsable() && backward.IsUsable());
  EXPECT_EQ(backward.consistent, forward.consistent);
  // The translation is optimal on each axis, and the axes of the two frames
  // differ by a rotation.
  EXPECT_LE(LargestDisplacement(Inverse(*backward.target_from_source),
                                *forward.target_from_source,
                                problem.source),
            0.15);
}

TEST(Teaser, OrderOfMatchesDoesNotMatterBitForBit) {
  const KnownProblem problem = TurnedProblem(60, 120, 2);
  for (const bool estimate_scale : {false, true}) {
    TeaserOptions options;
    options.estimate_scale = estimate_scale;
    const TeaserSummary expected = Solve(problem, options);
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      const auto order = RandomPermutation(problem.source.cols(), seed);
      ExpectSameBits(SolveTeaser(Reordered(problem.source, order),
                                 Reordered(problem.target, order),
                                 options),
                     expected);
    }
    options.num_threads = 3;
    ExpectSameBits(Solve(problem, options), expected);
  }
}

TEST(Teaser, EveryConsistentMatchHasAWeight) {
  const KnownProblem problem = TurnedProblem(60, 120, 2);
  const TeaserSummary summary = Solve(problem);
  ASSERT_EQ(summary.match_weights.size(), summary.consistent.size());
  for (std::size_t k = 0; k < summary.consistent.size(); ++k) {
    if (std::ranges::binary_search(problem.inliers, summary.consistent[k])) {
      EXPECT_GT(summary.match_weights[k], 0.5) << summary.consistent[k];
    }
  }
}

// The ring of differences changes, since the order depends on the coordinates.
TEST(Teaser, MovingTheTargetMovesThePose) {
  const KnownProblem problem = TurnedProblem(60, 120, 3);
  const TeaserSummary base = Solve(problem);
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const Rigid3 motion{RandomRotation(100 + seed), {-30.0, 12.0, 3.0}};
    const TeaserSummary moved =
        SolveTeaser(problem.source, motion.Apply(problem.target), {});
    ASSERT_TRUE(moved.IsUsable()) << moved.message;
    EXPECT_LE(AngleBetween(moved.target_from_source->rotation,
                           (motion * *base.target_from_source).rotation),
              0.1 * kDegree)
        << "seed " << seed;
    EXPECT_LE(LargestDisplacement(*moved.target_from_source,
                                  motion * *base.target_from_source,
                                  problem.source),
              0.1)
        << "seed " << seed;
  }
}

TEST(Teaser, ExactCliqueIsNoSmallerThanTheHeuristic) {
  TeaserOptions heuristic;
  heuristic.pruning = Pruning::kCliqueHeuristic;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const KnownProblem problem = TurnedProblem(30, 270, seed);
    const TeaserSummary exact = Solve(problem);
    const TeaserSummary greedy = Solve(problem, heuristic);
    ASSERT_TRUE(exact.IsUsable() && greedy.IsUsable());
    EXPECT_GE(exact.num_consistent, greedy.num_consistent) << "seed " << seed;
    EXPECT_LE(PoseError(exact, problem), 0.3) << "seed " << seed;
    EXPECT_LE(PoseError(greedy, problem), 0.3) << "seed " << seed;
  }
}

TEST(Teaser, TimLayoutDecidesHowManyThereAre) {
  const KnownProblem problem = TurnedProblem(40, 60, 1);
  TeaserOptions options;
  const TeaserSummary ring = Solve(problem, options);
  options.tim_layout = TimLayout::kComplete;
  const TeaserSummary complete = Solve(problem, options);
  const Eigen::Index n = ring.num_consistent;
  EXPECT_EQ(ring.num_tims, n);
  EXPECT_EQ(complete.num_tims, n * (n - 1) / 2);
  EXPECT_LE(PoseError(complete, problem), 0.3);
  EXPECT_LE(AngleBetween(complete.target_from_source->rotation,
                         problem.true_target_from_source.rotation),
            0.2 * kDegree);
}

TEST(Teaser, PointsThatAreNotFiniteAreRefused) {
  KnownProblem problem = TurnedProblem(10, 10, 1);
  problem.target(2, 3) = kNaN;
  const TeaserSummary summary = Solve(problem);
  ExpectNoAnswer(summary, PoseTermination::kInvalidInput);
  EXPECT_THAT(summary.message, HasSubstr("not finite"));
}

TEST(TeaserOptions, ErrorNamesTheFieldAndNothingIsTried) {
  std::string none;
  EXPECT_TRUE(TeaserOptions().IsValid(&none)) << none;
  const auto expect_error = [](const auto& change, const char* field) {
    TeaserOptions options;
    change(&options);
    std::string error;
    EXPECT_FALSE(options.IsValid(&error)) << field;
    EXPECT_THAT(error, HasSubstr(field));
    const TeaserSummary summary = Solve(TurnedProblem(10, 0, 1), options);
    ExpectNoAnswer(summary, PoseTermination::kInvalidInput);
    EXPECT_EQ(summary.message, error);
  };
  using Options = TeaserOptions*;
  expect_error([](Options o) { o->noise_bound = 0.0; }, "noise_bound = 0");
  expect_error([](Options o) { o->noise_bound = kNaN; }, "noise_bound = nan");
  expect_error(
      [](Options o) {
        o->noise_bound = std::numeric_limits<double>::infinity();
      },
      "noise_bound = inf");
  expect_error([](Options o) { o->num_scale_tims = 0; }, "num_scale_tims = 0");
  expect_error([](Options o) { o->num_threads = -1; }, "num_threads = -1");
  expect_error([](Options o) { o->clique_time_limit_seconds = -1.0; },
               "time_limit_seconds = -1");
  expect_error([](Options o) { o->gnc.mu_step = 1.0; }, "mu_step = 1");
}

}  // namespace
}  // namespace quatro::teaser_test
