// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/verdict/match_rival.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "features/base/degree.h"
#include "tests/support/matched_problems.h"
#include "tests/support/random_problems.h"

namespace quatro::match_rival_test {
namespace {

using ::testing::HasSubstr;

constexpr double kBound = 0.3;  // [m]
std::optional<MatchRival> Find(const KnownProblem& problem,
                               const MatchRivalOptions& options = {}) {
  return FindMatchRival(problem.source,
                        problem.target,
                        problem.true_target_from_source,
                        kBound,
                        options);
}

// A problem whose first `num_twins` inliers are matched as at the pose of the
// twin.
KnownProblem MakeTwins(const Rigid3& twin,
                       Eigen::Index num_inliers,
                       Eigen::Index num_twins,
                       std::uint64_t seed) {
  KnownProblem problem = MakeMatchedProblem(
      {.num_inliers = num_inliers + num_twins, .num_outliers = 200}, seed);
  for (Eigen::Index k = 0; k < num_twins; ++k) {
    const Eigen::Index i = problem.inliers[static_cast<std::size_t>(k)];
    problem.target.col(i) = twin * Eigen::Vector3d(problem.target.col(i));
  }
  return problem;
}

TEST(MatchRival, IsTheTwinOfTheWholePlace) {
  for (const auto& [yaw_deg, shift] :
       {std::pair{180.0, Eigen::Vector3d(3.0, 1.0, 0.0)},
        std::pair{90.0, Eigen::Vector3d(0.0, 0.0, 0.0)},
        std::pair{0.0, Eigen::Vector3d(5.0, 0.0, 0.2)},
        std::pair{0.0, Eigen::Vector3d(-2.5, 1.0, 0.0)}}) {
    const Rigid3 twin{RotationZ(yaw_deg * kDegree), shift};
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      const KnownProblem problem = MakeTwins(twin, 40, 30, seed);
      const auto rival = Find(problem);
      ASSERT_TRUE(rival) << yaw_deg << " deg, seed " << seed;
      const Rigid3 expected = twin * problem.true_target_from_source;
      EXPECT_LE(LargestDisplacement(
                    rival->target_from_source, expected, problem.source),
                2.0 * kBound)
          << yaw_deg << " deg, seed " << seed;
      EXPECT_GE(rival->num_inliers, 30);
      EXPECT_LE(rival->num_inliers, 33);
      EXPECT_FALSE(rival->has_same_matches);
    }
  }
}

TEST(MatchRival, OfMatchesOnOnePoleAndALuckyOneIsATurnAboutThePole) {
  Random random(7);
  KnownProblem problem = MakeMatchedProblem(
      {.num_inliers = 20, .num_outliers = 0, .half_widths = {0.1, 0.1, 3.0}},
      /*seed=*/7);
  const Eigen::Vector3d lucky(12.0, -7.0, 0.0);
  problem.source.conservativeResize(3, 21);
  problem.target.conservativeResize(3, 21);
  problem.source.col(20) = lucky;
  problem.target.col(20) = problem.true_target_from_source * lucky;
  const auto rival = Find(problem);
  ASSERT_TRUE(rival);
  EXPECT_TRUE(rival->has_same_matches);
  EXPECT_EQ(rival->num_inliers, 20);
  EXPECT_NEAR(rival->margin, 1.0 / std::sqrt(41.0), 1e-12);
}

TEST(MatchRival, OfAGoodConsensusIsFarBehind) {
  int num_rivals = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const KnownProblem problem =
        MakeMatchedProblem({.num_inliers = 40, .num_outliers = 400}, seed);
    const auto rival = Find(problem);
    if (!rival) continue;
    ++num_rivals;
    EXPECT_LE(rival->num_inliers, 8) << "seed " << seed;
    EXPECT_GE(rival->margin, 4.0) << "seed " << seed;
  }
  EXPECT_GE(num_rivals, 5);
}

TEST(MatchRival, IsNeverThePoseItself) {
  int num_rivals = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const KnownProblem problem = MakeMatchedProblem(
        {.num_inliers = 60, .num_outliers = 100, .noise = 0.5}, seed);
    const auto rival = Find(problem);
    if (!rival) continue;
    ++num_rivals;
    const Rigid3 step =
        rival->target_from_source * Inverse(problem.true_target_from_source);
    const auto agreeing = problem.true_target_from_source.translation;
    EXPECT_TRUE(AngleBetween(step.rotation, Eigen::Matrix3d::Identity()) >
                    9.9 * kDegree ||
                (step * agreeing - agreeing).norm() > kBound)
        << "seed " << seed;
  }
  EXPECT_GE(num_rivals, 20);
}

TEST(MatchRival, MarginIsEquationOneAndNegativeWhereTheRivalIsBetter) {
  const Rigid3 twin{RotationZ(M_PI), Eigen::Vector3d::Zero()};
  const KnownProblem problem = MakeTwins(twin, 20, 60, /*seed=*/3);
  const auto rival = Find(problem);
  ASSERT_TRUE(rival);
  EXPECT_GE(rival->num_inliers, 60);
  EXPECT_LT(rival->margin, -3.0);
}

TEST(MatchRival, MovesWithTheFramesAndKeepsItsCount) {
  const Rigid3 twin{RotationZ(M_PI), Eigen::Vector3d(1.0, 2.0, 0.0)};
  const KnownProblem problem = MakeTwins(twin, 40, 30, /*seed=*/4);
  const Rigid3 turn{RotationZ(0.7), Eigen::Vector3d(100.0, -50.0, 3.0)};
  const auto rival = Find(problem);
  const auto moved = FindMatchRival(problem.source,
                                    turn.Apply(problem.target),
                                    turn * problem.true_target_from_source,
                                    kBound,
                                    {});
  ASSERT_TRUE(rival && moved);
  EXPECT_LE(LargestDisplacement(moved->target_from_source,
                                turn * rival->target_from_source,
                                problem.source),
            kBound);
  EXPECT_EQ(moved->num_inliers, rival->num_inliers);
}

TEST(MatchRival, IsWithinTheBounds) {
  const Rigid3 twin{RotationZ(M_PI), Eigen::Vector3d(1.0, 2.0, 0.0)};
  const KnownProblem problem = MakeTwins(twin, 40, 30, /*seed=*/4);
  MatchRivalOptions options;
  options.bounds.guess = problem.true_target_from_source;
  options.bounds.max_yaw = 1.0;
  const auto rival = Find(problem, options);
  EXPECT_GE(Find(problem)->num_inliers, 30);
  EXPECT_LT(rival ? rival->num_inliers : 0, 10);
}

TEST(MatchRival, DoesNotDependOnTheNumberOfThreads) {
  const Rigid3 twin{RotationZ(M_PI), Eigen::Vector3d(1.0, 2.0, 0.0)};
  const KnownProblem problem = MakeTwins(twin, 40, 30, /*seed=*/5);
  MatchRivalOptions options;
  const auto one = Find(problem, options);
  options.num_threads = 4;
  const auto four = Find(problem, options);
  ASSERT_TRUE(one && four);
  EXPECT_EQ(one->target_from_source.ToMatrix(),
            four->target_from_source.ToMatrix());
  EXPECT_EQ(one->num_inliers, four->num_inliers);
}

TEST(MatchRival, OfTooFewMatchesIsNone) {
  for (const Eigen::Index n : {0, 1}) {
    EXPECT_FALSE(Find(
        MakeMatchedProblem({.num_inliers = n, .num_outliers = 0}, /*seed=*/6)));
  }
}

TEST(MatchRival, OfTwoMatchesHasNoMarginToSpeakOf) {
  const auto rival = Find(
      MakeMatchedProblem({.num_inliers = 2, .num_outliers = 100}, /*seed=*/8));
  ASSERT_TRUE(rival);
  EXPECT_LE(rival->margin, 0.5);
}

TEST(MatchRivalOptions, ErrorNamesTheFieldThatIsOutOfRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::string error;
  EXPECT_TRUE(MatchRivalOptions().IsValid(&error)) << error;
  const auto expect_error = [&](const auto& change, const char* name) {
    MatchRivalOptions options;
    change(&options);
    EXPECT_FALSE(options.IsValid(&error)) << name;
    EXPECT_THAT(error, HasSubstr(name));
  };
  using Options = MatchRivalOptions*;
  expect_error([&](Options o) { o->min_rotation = nan; }, "min_rotation");
  expect_error([](Options o) { o->min_shift_factor = 1.0; },
               "min_shift_factor");
  expect_error([](Options o) { o->num_pairs = 0; }, "num_pairs");
  expect_error([](Options o) { o->max_num_matches = 1; }, "max_num_matches");
  expect_error([&](Options o) { o->bounds.max_yaw = nan; }, "max_yaw");
  expect_error([](Options o) { o->num_threads = -1; }, "num_threads");
}

}  // namespace
}  // namespace quatro::match_rival_test
