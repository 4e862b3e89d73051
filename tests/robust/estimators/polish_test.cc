// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/estimators/polish.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "features/base/degree.h"
#include "robust/estimators/consensus.h"
#include "robust/estimators/quatro.h"
#include "tests/support/matched_problems.h"
#include "tests/support/random_problems.h"

namespace quatro::polish_test {
namespace {

using ::testing::HasSubstr;

constexpr double kNoiseBound = 0.3;  // [m]

// A problem whose true pose is tilted by `tilt` [rad] about a horizontal axis.
KnownProblem TiltedProblem(const MatchedProblemOptions& options,
                           double tilt,
                           std::uint64_t seed) {
  KnownProblem problem = MakeMatchedProblem(options, seed);
  const double direction = static_cast<double>(seed);
  const Eigen::Vector3d axis(std::cos(direction), std::sin(direction), 0.0);
  const Rigid3 lean{Eigen::AngleAxisd(tilt, axis).toRotationMatrix(),
                    Eigen::Vector3d::Zero()};
  problem.true_target_from_source = lean * problem.true_target_from_source;
  for (const Eigen::Index i : problem.inliers) {
    problem.target.col(i) = lean * Eigen::Vector3d(problem.target.col(i));
  }
  return problem;
}

// The yaw-only pose.
Rigid3 Upright(const KnownProblem& problem) {
  return {RotationZ(Yaw(problem.true_target_from_source.rotation)),
          problem.true_target_from_source.translation};
}

PolishSummary Polished(const KnownProblem& problem,
                       const PolishOptions& options = {}) {
  return Polish(problem.source,
                problem.target,
                problem.inliers,
                Upright(problem),
                options);
}

double Cost(const KnownProblem& problem, const Rigid3& pose) {
  return ConsensusCost(problem.source, problem.target, pose, kNoiseBound);
}

double RotationError(const KnownProblem& problem, const Rigid3& pose) {
  return AngleBetween(pose.rotation, problem.true_target_from_source.rotation);
}

void ExpectRefused(const PolishSummary& summary, const Rigid3& given) {
  EXPECT_FALSE(summary.is_polished);
  EXPECT_EQ(summary.target_from_source.ToMatrix(), given.ToMatrix());
  EXPECT_THAT(summary.message, ::testing::Not(HasSubstr("polished")));
  EXPECT_FALSE(summary.message.empty());
}

TEST(Polish, FindsATiltOfTwoDegrees) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const KnownProblem problem =
        TiltedProblem({.num_inliers = 100, .num_outliers = 300, .noise = 0.1},
                      2.0 * kDegree,
                      seed);
    EXPECT_GT(RotationError(problem, Upright(problem)), 1.9 * kDegree);
    const PolishSummary summary = Polished(problem);
    EXPECT_TRUE(summary.is_polished) << summary.message;
    EXPECT_LT(RotationError(problem, summary.target_from_source), 0.1 * kDegree)
        << "seed " << seed;
    EXPECT_LT(RotationError(problem, summary.target_from_source),
              6.0 * summary.rotation_std)
        << "seed " << seed;
    EXPECT_EQ(summary.message, "polished");
  }
}

TEST(Polish, FindsElevenDegreesFromTheConsistentSet) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const KnownProblem problem =
        TiltedProblem({.num_inliers = 100, .num_outliers = 300, .noise = 0.1},
                      11.0 * kDegree,
                      seed);
    const PolishSummary summary = Polished(problem);
    EXPECT_TRUE(summary.is_polished) << "seed " << seed << summary.message;
    EXPECT_LT(RotationError(problem, summary.target_from_source), 0.1 * kDegree)
        << "seed " << seed;
  }
}

TEST(Polish, NeverTurnsFartherThanAllowed) {
  int num_refused = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const double tilt = 0.5 * kDegree * static_cast<double>(seed % 20);
    const KnownProblem problem = TiltedProblem(
        {.num_inliers = 100, .num_outliers = 300, .noise = 0.1}, tilt, seed);
    PolishOptions options;
    options.max_tilt = 4.0 * kDegree;
    const PolishSummary summary = Polished(problem, options);
    EXPECT_LE(AngleBetween(summary.target_from_source.rotation,
                           Upright(problem).rotation),
              options.max_tilt)
        << "seed " << seed;
    EXPECT_EQ(summary.is_polished, summary.message == "polished")
        << "seed " << seed << ": " << summary.message;
    if (tilt > 5.0 * kDegree) {
      EXPECT_GT(RotationError(problem, summary.target_from_source), kDegree);
      num_refused += !summary.is_polished;
      if (!summary.is_polished) {
        EXPECT_THAT(summary.message, HasSubstr("rotated too far"));
      }
    }
  }
  EXPECT_GT(num_refused, 0);
}

TEST(Polish, NeverCostsMoreThanThePoseGiven) {
  int num_polished = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const auto num_inliers = static_cast<Eigen::Index>(seed % 25);
    const KnownProblem problem = TiltedProblem(
        {.num_inliers = num_inliers, .num_outliers = 100, .noise = 0.2},
        0.01 * static_cast<double>(seed % 7),
        seed);
    Rigid3 given = Upright(problem);
    given.translation += 0.2 * RandomDirection(seed);
    // Half of the problems use an inconsistent set and check only the cost.
    std::vector<Eigen::Index> consistent = problem.inliers;
    PolishOptions options;
    if (seed % 2 == 1) {
      consistent = {0, 1, 2, 3, 4, 5};
      options.max_tilt = M_PI;
      options.max_rotation_std = 1e9;
    }
    const PolishSummary summary =
        Polish(problem.source, problem.target, consistent, given, options);
    EXPECT_LE(Cost(problem, summary.target_from_source), Cost(problem, given))
        << "seed " << seed;
    num_polished += summary.is_polished;
  }
  EXPECT_GT(num_polished, 20);
  EXPECT_LT(num_polished, 100);
}

// Two groups of matches with one motion each; the second is tilted by a quarter
// of a radian. Returns the columns of the second.
std::vector<Eigen::Index> AddGroup(Eigen::Index size,
                                   std::uint64_t seed,
                                   KnownProblem* problem) {
  const KnownProblem other = TiltedProblem(
      {.num_inliers = size, .num_outliers = 0, .yaw = 2.1}, 0.25, seed + 1000);
  const Eigen::Index n = problem->source.cols();
  problem->source.conservativeResize(3, n + size);
  problem->target.conservativeResize(3, n + size);
  problem->source.rightCols(size) = other.source;
  problem->target.rightCols(size) = other.target;
  std::vector<Eigen::Index> columns;
  for (Eigen::Index i = 0; i < size; ++i) columns.push_back(n + i);
  return columns;
}

TEST(Polish, ASmallerGroupThatIsConsistentDoesNotWin) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    KnownProblem problem = TiltedProblem(
        {.num_inliers = 40, .num_outliers = 0}, 0.5 * kDegree, seed);
    const auto smaller = AddGroup(12, seed, &problem);
    PolishOptions options;
    options.max_tilt = M_PI;
    const PolishSummary summary = Polish(
        problem.source, problem.target, smaller, Upright(problem), options);
    EXPECT_LT(RotationError(problem, summary.target_from_source), kDegree)
        << "seed " << seed;
  }
}

TEST(Polish, IsSaidToBePolishedWhereOnlyAnotherPoseIsRefused) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    KnownProblem problem = TiltedProblem(
        {.num_inliers = 40, .num_outliers = 0}, 0.5 * kDegree, seed);
    const auto larger = AddGroup(80, seed, &problem);
    PolishOptions options;
    options.max_tilt = 0.1;
    const PolishSummary summary = Polish(
        problem.source, problem.target, larger, Upright(problem), options);
    EXPECT_TRUE(summary.is_polished) << "seed " << seed;
    EXPECT_EQ(summary.message, "polished") << "seed " << seed;
    EXPECT_LT(RotationError(problem, summary.target_from_source), 0.2 * kDegree)
        << "seed " << seed;
  }
}

TEST(Polish, ExactMatchesStayExact) {
  for (const double tilt : {0.0, 0.03}) {
    const KnownProblem problem = TiltedProblem(
        {.num_inliers = 50, .num_outliers = 50, .noise = 0.0}, tilt, 1);
    const PolishSummary summary = Polished(problem);
    EXPECT_LT(LargestDisplacement(summary.target_from_source,
                                  problem.true_target_from_source,
                                  problem.source),
              1e-12)
        << "tilt " << tilt;
  }
}

TEST(Polish, TwoMatchesHoldNoTilt) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const KnownProblem problem =
        TiltedProblem({.num_inliers = 2, .num_outliers = 0, .noise = 0.2},
                      0.5 * kDegree,
                      seed);
    const PolishSummary summary = Polished(problem);
    ExpectRefused(summary, Upright(problem));
    EXPECT_THAT(summary.message, HasSubstr("do not constrain roll and pitch"));
  }
}

TEST(Polish, MatchesOnALineHoldNoTilt) {
  for (const double off_line : {0.0, 1e-9, 0.01}) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      Random random(seed);
      KnownProblem problem;
      problem.true_target_from_source = {RotationZ(1.0), {3.0, 4.0, 0.5}};
      problem.source = RandomPointsInBox(
          30, Eigen::Vector3d(40.0, off_line, off_line), &random);
      problem.target =
          problem.true_target_from_source.Apply(problem.source) +
          RandomPointsInBox(30, Eigen::Vector3d::Constant(0.1), &random);
      for (Eigen::Index i = 0; i < 30; ++i) problem.inliers.push_back(i);
      const PolishSummary summary = Polished(problem);
      ExpectRefused(summary, Upright(problem));
      // Points nearly on a line determine a pose, but with an arbitrary
      // rotation about the line.
      if (off_line == 0.01) continue;
      EXPECT_THAT(summary.message, HasSubstr("do not constrain roll and pitch"))
          << off_line << " m, seed " << seed;
    }
  }
}

TEST(Polish, NoMatchesKeepThePoseGiven) {
  const Rigid3 given{RotationZ(1.0), {1.0, 2.0, 3.0}};
  ExpectRefused(Polish(Points(3, 0), Points(3, 0), {}, given, PolishOptions()),
                given);
}

TEST(Polish, IsWhatQuatroFallsBackFrom) {
  // With two matches the yaw-only pose is kept, and the note says why.
  const KnownProblem problem = MakeInconsistentProblem(
      {.num_inliers = 2, .num_outliers = 30}, 0.6, /*seed=*/1);
  const QuatroSummary summary =
      SolveQuatro(problem.source, problem.target, QuatroOptions());
  ASSERT_TRUE(summary.IsUsable()) << summary.message;
  EXPECT_FALSE(summary.unpolished_target_from_source.has_value());
  EXPECT_EQ(summary.target_from_source->rotation, RotationZ(summary.yaw));
  EXPECT_THAT(summary.Note("polish"),
              HasSubstr("do not constrain roll and pitch"));
}

TEST(PolishOptions, ErrorNamesTheFieldThatIsOutOfRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::string error;
  EXPECT_TRUE(PolishOptions().IsValid(&error)) << error;
  const auto expect_error = [](const PolishOptions& options,
                               const char* field) {
    std::string problem;
    EXPECT_FALSE(options.IsValid(&problem)) << field;
    EXPECT_THAT(problem, HasSubstr(field));
  };
  expect_error({.noise_bound = 0.0}, "noise_bound = 0");
  expect_error({.noise_bound = nan}, "noise_bound = nan");
  expect_error({.max_tilt = 0.0}, "max_tilt = 0");
  expect_error({.max_tilt = 4.0}, "max_tilt = 4");
  expect_error({.max_rotation_std = -1.0}, "max_rotation_std = -1");
}

}  // namespace
}  // namespace quatro::polish_test
