// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// What no estimator's answer depends on: the unit of length, and points that
// are out of this world.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <string>

#include "experiments/programs/methods.h"
#include "robust/verdict/verdict.h"
#include "tests/support/matched_problems.h"
#include "tests/support/random_problems.h"

namespace quatro::method_invariance_test {
namespace {

constexpr Eigen::Index kNumInliers = 30;
constexpr Eigen::Index kNumMatches = 60;
constexpr Eigen::Index kNumFar = 12;
constexpr double kNoiseBound = 0.3;

// Of the library's methods: peers' programs are their authors'.
RegistrationSummary RunMethod(const std::string& name,
                              const PointsRef& source,
                              const PointsRef& target,
                              double noise_bound) {
  RegistrationOptions options;
  options.method = name;
  options.noise_bound = noise_bound;
  if (NeedsIns(name)) options.ins.mode = InsMode::kFused;  // Level.
  RegistrationSummary summary = RegisterMatches({source, target}, options);
  EXPECT_EQ(summary.error, "");
  return summary;
}

PoseSummary Solve(const std::string& name,
                  const PointsRef& source,
                  const PointsRef& target,
                  double noise_bound) {
  return RunMethod(name, source, target, noise_bound).solution;
}

// Inliers first, so that outliers can be replaced from the end.
KnownProblem MakeProblem(double noise, std::uint64_t seed) {
  KnownProblem problem = MakeMatchedProblem(
      {.num_inliers = kNumMatches, .num_outliers = 0, .noise = noise}, seed);
  problem.target.rightCols(kNumMatches - kNumInliers) =
      RandomPoints(kNumMatches - kNumInliers, 30.0, seed + 1000);
  return problem;
}

double Difference(const Rigid3& a, const Rigid3& b) {
  return (a.ToMatrix() - b.ToMatrix()).norm();
}

class MethodInvariance : public ::testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(
    ,
    MethodInvariance,
    ::testing::ValuesIn(MethodNames(MethodInput::kMatches)),
    [](const auto& method) { return method.param; });

TEST_P(MethodInvariance, TheUnitOfLengthDoesNotMatter) {
  for (const double noise : {0.0, 0.05}) {
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
      const KnownProblem problem = MakeProblem(noise, seed);
      const PoseSummary expected =
          Solve(GetParam(), problem.source, problem.target, kNoiseBound);
      ASSERT_TRUE(expected.IsUsable()) << expected.message;
      for (const double k : {1e-6, 1e-3, 0x1p-7, 1e-2, 1.0, 1e3, 0x1p20}) {
        const PoseSummary summary = Solve(GetParam(),
                                          k * problem.source,
                                          k * problem.target,
                                          k * kNoiseBound);
        ASSERT_TRUE(summary.IsUsable()) << k << ": " << summary.message;
        EXPECT_EQ(summary.translation_inliers, expected.translation_inliers)
            << k;
        // With noise, the yaw is that of differences between neighbors in an
        // order of the matches that their coordinates give.
        if (noise > 0.0) continue;
        Rigid3 pose = *summary.target_from_source;
        pose.translation /= k;
        EXPECT_LE(Difference(pose, *expected.target_from_source), 1e-9) << k;
      }
    }
  }
}

enum class Side { kSource, kTarget, kBoth, kBothAlike };

// The last matches at `far` in directions of their own, or all in the same.
KnownProblem WithFarMatches(KnownProblem problem, Side side, double far) {
  for (Eigen::Index i = kNumMatches - kNumFar; i < kNumMatches; ++i) {
    const auto seed = static_cast<std::uint64_t>(i);
    const Points directions = RandomPoints(2, 1.0, seed);
    const auto at = [&](Eigen::Index k) -> Eigen::Vector3d {
      return far / directions.col(k).cwiseAbs().maxCoeff() * directions.col(k);
    };
    if (side == Side::kSource) problem.source.col(i) = at(0);
    if (side == Side::kTarget) problem.target(1, i) = far;
    if (side == Side::kBoth) problem.source.col(i) = at(0);
    if (side == Side::kBoth) problem.target.col(i) = at(1);
    if (side != Side::kBothAlike) continue;
    problem.source.col(i) += Eigen::Vector3d::Constant(far);
    problem.target.col(i) -= Eigen::Vector3d::Constant(far);
  }
  return problem;
}

TEST_P(MethodInvariance, PointsOutOfThisWorldChangeNothing) {
  const KnownProblem problem = MakeProblem(/*noise=*/0.0, /*seed=*/1);
  const Eigen::Index num_others = kNumMatches - kNumFar;
  const PoseSummary expected = Solve(GetParam(),
                                     problem.source.leftCols(num_others),
                                     problem.target.leftCols(num_others),
                                     kNoiseBound);
  ASSERT_TRUE(expected.IsUsable()) << expected.message;
  ASSERT_EQ(expected.num_translation_inliers, kNumInliers);
  for (const Side side :
       {Side::kSource, Side::kTarget, Side::kBoth, Side::kBothAlike}) {
    for (const double far :
         {1e3, 1e4, 1e6, 1e9, 1e12, 1e15, 1e17, 3.4e38, 1e150, 1e300}) {
      SCOPED_TRACE(testing::Message()
                   << far << " m, side " << static_cast<int>(side));
      const KnownProblem spoiled = WithFarMatches(problem, side, far);
      const PoseSummary summary =
          Solve(GetParam(), spoiled.source, spoiled.target, kNoiseBound);
      ASSERT_TRUE(summary.IsUsable()) << summary.message;
      EXPECT_EQ(summary.translation_inliers, expected.translation_inliers);
      EXPECT_LE(
          Difference(*summary.target_from_source, *expected.target_from_source),
          1e-9);
    }
  }
}

TEST_P(MethodInvariance, NeitherPoseNorVerdictKnowsOfAFltMax) {
  KnownProblem problem = MakeProblem(/*noise=*/0.05, /*seed=*/1);
  const Eigen::Index num_others = kNumMatches - 1;
  const Points source = problem.source.leftCols(num_others);
  const Points target = problem.target.leftCols(num_others);
  const RegistrationSummary registration =
      RunMethod(GetParam(), source, target, kNoiseBound);
  const PoseSummary& expected = registration.solution;
  ASSERT_TRUE(expected.IsUsable()) << expected.message;
  const Verdict& verdict = registration.verdict;

  problem.source(0, num_others) = std::numeric_limits<float>::max();
  const RegistrationSummary spoiled_registration =
      RunMethod(GetParam(), problem.source, problem.target, kNoiseBound);
  const PoseSummary& summary = spoiled_registration.solution;
  ASSERT_TRUE(summary.IsUsable()) << summary.message;
  EXPECT_EQ(summary.num_matches, num_others);
  EXPECT_EQ(summary.translation_inliers, expected.translation_inliers);
  EXPECT_EQ(summary.target_from_source->ToMatrix(),
            expected.target_from_source->ToMatrix());
  const Verdict& spoiled = spoiled_registration.verdict;
  EXPECT_EQ(spoiled.probability, verdict.probability);
  EXPECT_EQ(spoiled.reason, verdict.reason);
}

}  // namespace
}  // namespace quatro::method_invariance_test
