// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/estimators/recovery.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "experiments/simulator/synthetic.h"
#include "robust/estimators/consensus.h"
#include "robust/estimators/quatro.h"
#include "tests/support/random_problems.h"

namespace quatro::recovery_test {
namespace {

// Starts from the true rotation and an incorrect translation.
Rigid3 Displaced(const Rigid3& pose, const Eigen::Vector3d& by) {
  return {pose.rotation, pose.translation + by};
}

double TranslationError(const Rigid3& pose, const MatchedProblem& problem) {
  return (pose.translation - problem.true_target_from_source.translation)
      .norm();
}

TEST(Recovery, NeverCostsMoreThanThePoseGiven) {
  int num_better = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const double ratio = 0.1 * static_cast<double>(seed % 10);
    const MatchedProblem problem = MakeOutlierProblem(100, ratio, 0.1, seed);
    // From small to arbitrary translation errors, and with rotation errors too.
    const double far = std::pow(10.0, static_cast<double>(seed / 10 % 5) - 2.0);
    Rigid3 given =
        Displaced(problem.true_target_from_source, far * RandomDirection(seed));
    if (seed % 3 == 0) given.rotation = RandomRotation(seed);
    const Rigid3 recovered =
        RecoverTranslation(problem.source, problem.target, given, 0.3);
    const double before =
        ConsensusCost(problem.source, problem.target, given, 0.3);
    const double after =
        ConsensusCost(problem.source, problem.target, recovered, 0.3);
    EXPECT_LE(after, before) << "seed " << seed;
    EXPECT_EQ(recovered.rotation, given.rotation) << "seed " << seed;
    num_better += after < before;
  }
  EXPECT_GT(num_better, 100);
}

TEST(Recovery, FindsTheTranslationFromAnywhere) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const MatchedProblem problem = MakeOutlierProblem(400, 0.8, 0.05, seed);
    const Rigid3 recovered = RecoverTranslation(
        problem.source,
        problem.target,
        Displaced(problem.true_target_from_source, {30.0, -40.0, 5.0}),
        0.3);
    EXPECT_LT(TranslationError(recovered, problem), 0.1) << "seed " << seed;
  }
}

TEST(Recovery, FindsTheHeightOfATranslationThatIsRightInThePlane) {
  // With few inliers the best x and y over all matches are not the true ones.
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const MatchedProblem problem = MakeOutlierProblem(400, 0.99, 0.05, seed);
    const Rigid3 recovered = RecoverTranslation(
        problem.source,
        problem.target,
        Displaced(problem.true_target_from_source, {0.0, 0.0, 2.0}),
        0.3);
    EXPECT_LT(TranslationError(recovered, problem), 0.15) << "seed " << seed;
  }
}

TEST(Recovery, KeepsWhatNothingBeats) {
  MatchedProblem problem = MakeOutlierProblem(50, 0.0, 0.0, /*seed=*/1);
  const Rigid3 recovered = RecoverTranslation(
      problem.source, problem.target, problem.true_target_from_source, 0.3);
  EXPECT_LT(TranslationError(recovered, problem), 1e-12);

  const Rigid3 given{RotationZ(1.0), {1.0, 2.0, 3.0}};
  const Rigid3 without =
      RecoverTranslation(Points(3, 0), Points(3, 0), given, 0.3);
  EXPECT_EQ(without.ToMatrix(), given.ToMatrix());
}

TEST(Recovery, QuasiInliersLoseTheirHold) {
  // 20 inliers, and 180 matches that are inliers in x and y but not in z and
  // mislead the clique.
  constexpr double kBound = 0.1;
  int num_right_without = 0;
  int num_right = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const MatchedProblem problem =
        MakeQuasiInlierProblem(500, 20, 180, kBound / 3.0, seed);
    QuatroOptions options;
    options.noise_bound = kBound;
    options.polish = false;
    const auto recovered = SolveQuatro(problem.source, problem.target, options);
    options.recover_translation = false;
    const auto without = SolveQuatro(problem.source, problem.target, options);
    ASSERT_TRUE(recovered.IsUsable() && without.IsUsable()) << "seed " << seed;
    num_right +=
        TranslationError(*recovered.target_from_source, problem) <= 0.3;
    num_right_without +=
        TranslationError(*without.target_from_source, problem) <= 0.3;
    EXPECT_LE(AngleBetween(recovered.target_from_source->rotation,
                           problem.true_target_from_source.rotation),
              M_PI / 180.0)
        << "seed " << seed;
  }
  EXPECT_GE(num_right, 18);
  EXPECT_LT(num_right_without, num_right);
  RecordProperty("right_without_recovery", num_right_without);
}

}  // namespace
}  // namespace quatro::recovery_test
