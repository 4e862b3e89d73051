// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/verdict/false_alarms.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "robust/estimators/distinct_matches.h"
#include "tests/support/matched_problems.h"
#include "tests/support/random_problems.h"

namespace quatro::false_alarms_test {
namespace {

constexpr double kNoiseBound = 0.3;  // [m]

FalseAlarms OfTruth(const KnownProblem& problem) {
  return PoseFalseAlarms(problem.source,
                         problem.target,
                         problem.true_target_from_source,
                         kNoiseBound);
}

// The tail summed term by term, with Pascal's triangle.
double BinomialTail(int n, int k, double p) {
  double tail = 0.0;
  for (int i = std::max(k, 0); i <= n; ++i) {
    double choose = 1.0;
    for (int j = 0; j < i; ++j) choose = choose * (n - j) / (j + 1);
    tail += choose * std::pow(p, i) * std::pow(1.0 - p, n - i);
  }
  return tail;
}

TEST(Log10BinomialTail, IsTheSumOfItsTermsForSmallNumbers) {
  for (const int n : {0, 1, 2, 5, 12, 30}) {
    for (int k = -1; k <= n; ++k) {
      for (const double p : {1e-6, 0.01, 0.3, 0.5, 0.9, 0.999}) {
        EXPECT_NEAR(Log10BinomialTail(n, k, p),
                    std::log10(BinomialTail(n, k, p)),
                    1e-11)
            << "n " << n << ", k " << k << ", p " << p;
      }
    }
  }
}

TEST(Log10BinomialTail, OfAllIsThePower) {
  EXPECT_NEAR(Log10BinomialTail(1000, 1000, 0.01), -2000.0, 1e-9);
  EXPECT_NEAR(Log10BinomialTail(100000, 100000, 0.1), -100000.0, 1e-6);
}

TEST(Log10BinomialTail, OfLargeNumbersDoesNotUnderOrOverflow) {
  // P[B(1000, 1/2) >= 600] = 1.3642e-10, and about 1/2 at the middle.
  EXPECT_NEAR(Log10BinomialTail(1000, 600, 0.5), -9.865, 1e-3);
  EXPECT_NEAR(Log10BinomialTail(10001, 5001, 0.5), std::log10(0.5), 1e-9);
  EXPECT_NEAR(Log10BinomialTail(1000000, 10, 0.9), 0.0, 1e-12);
  // The first term, C(10000, 500) 1e-4^500, dominates.
  EXPECT_NEAR(Log10BinomialTail(10000, 500, 1e-4),
              (std::lgamma(10001.0) - std::lgamma(501.0) - std::lgamma(9501.0) +
               500.0 * std::log(1e-4) + 9500.0 * std::log1p(-1e-4)) /
                  std::log(10.0),
              1e-2);
}

// std::lgamma writes to the global `signgam`, a race between two threads.
TEST(Log10BinomialTail, WritesNoGlobal) {
  signgam = 7;
  Log10BinomialTail(1000, 600, 0.5);
  EXPECT_EQ(signgam, 7);
}

TEST(Log10BinomialTail, OfTheImpossibleAndTheCertain) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(Log10BinomialTail(10, 11, 0.5), -infinity);
  EXPECT_EQ(Log10BinomialTail(10, 1, 0.0), -infinity);
  EXPECT_EQ(Log10BinomialTail(10, 10, 1.0), 0.0);
  EXPECT_EQ(Log10BinomialTail(10, 0, 0.5), 0.0);
  EXPECT_EQ(Log10BinomialTail(-2, -2, 0.5), 0.0);
}

TEST(Log10BinomialTail, FallsWithTheCountAndRisesWithTheChance) {
  for (Eigen::Index k = 1; k <= 200; ++k) {
    ASSERT_LT(Log10BinomialTail(200, k, 0.05),
              Log10BinomialTail(200, k - 1, 0.05) + 1e-15)
        << "k " << k;
    ASSERT_LE(Log10BinomialTail(200, k, 0.05), Log10BinomialTail(200, k, 0.06))
        << "k " << k;
  }
}

TEST(PoseFalseAlarms, AreEquationOne) {
  const FalseAlarms alarms =
      OfTruth(MakeMatchedProblem({.num_inliers = 30}, /*seed=*/2));
  const double n = 70.0;
  EXPECT_NEAR(alarms.log10_false_alarms,
              std::log10(n * (n - 1.0) / 2.0) +
                  Log10BinomialTail(68, alarms.num_inliers - 2, alarms.chance),
              1e-12);
}

TEST(PoseFalseAlarms, ChanceIsTheShareOfAgreementAmongOtherPairings) {
  const KnownProblem problem = MakeMatchedProblem(
      {.num_outliers = 60, .half_widths = {3.0, 3.0, 1.0}}, /*seed=*/3);
  const Points moved = problem.true_target_from_source.Apply(problem.source);
  int num_inliers = 0;
  for (Eigen::Index i = 0; i < 100; ++i) {
    for (Eigen::Index j = 0; j < 100; ++j) {
      const double worst =
          (problem.target.col(j) - moved.col(i)).cwiseAbs().maxCoeff();
      num_inliers += i != j && worst <= kNoiseBound;
    }
  }
  EXPECT_GT(num_inliers, 20);
  EXPECT_NEAR(
      OfTruth(problem).chance, (num_inliers + 1) / (100.0 * 99.0), 1e-12);
}

std::optional<FalseAlarms> OfClique(const KnownProblem& problem,
                                    const std::vector<Eigen::Index>& columns) {
  return CliqueFalseAlarms(problem.source,
                           problem.target,
                           Columns(problem.source, columns),
                           Columns(problem.target, columns),
                           kNoiseBound);
}

TEST(CliqueFalseAlarms, ChanceIsTheSquareOfTheShareOfConsistentPairs) {
  const KnownProblem problem =
      MakeMatchedProblem({.num_inliers = 20, .num_outliers = 60}, /*seed=*/1);
  const auto alarms = OfClique(problem, problem.inliers);
  ASSERT_TRUE(alarms);
  // All pairs of one difference of sources and one of targets.
  double num_consistent = 0.0;
  double num_pairs = 0.0;
  std::vector<double> sources;
  std::vector<double> targets;
  for (Eigen::Index i = 0; i < 80; ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      sources.push_back((problem.source.col(i) - problem.source.col(j)).norm());
      targets.push_back((problem.target.col(i) - problem.target.col(j)).norm());
    }
  }
  for (const double a : sources) {
    for (const double b : targets) {
      num_consistent += std::abs(a - b) <= 2.0 * kNoiseBound;
      num_pairs += 1.0;
    }
  }
  // 20,000 draws with a share of about 2 %: a tolerance of a quarter is five
  // standard deviations.
  const double e = num_consistent / num_pairs;
  EXPECT_NEAR(std::sqrt(alarms->chance), e, 0.25 * e);
  EXPECT_NEAR(alarms->log10_false_alarms,
              std::log10(80.0 * 79.0 / 2.0) + 0.5 * std::log10(alarms->chance) +
                  Log10BinomialTail(78, 18, alarms->chance),
              1e-9);
}

TEST(CliqueFalseAlarms, FallWithTheSizeOfTheClique) {
  double last = 0.0;
  for (const Eigen::Index n : {4, 8, 16, 32}) {
    const KnownProblem problem = MakeMatchedProblem(
        {.num_inliers = n, .num_outliers = 100 - n}, /*seed=*/2);
    const auto alarms = OfClique(problem, problem.inliers);
    ASSERT_TRUE(alarms);
    EXPECT_LT(alarms->log10_false_alarms, last);
    last = alarms->log10_false_alarms;
  }
  EXPECT_LT(last, -40.0);
}

TEST(CliqueFalseAlarms, OfWhatIsNoCliqueAreNone) {
  const KnownProblem problem = MakeMatchedProblem({}, /*seed=*/3);
  std::vector<Eigen::Index> all;
  for (Eigen::Index i = 0; i < problem.source.cols(); ++i) all.push_back(i);
  EXPECT_FALSE(OfClique(problem, all));
  EXPECT_FALSE(OfClique(problem, {}));
  EXPECT_FALSE(OfClique(problem, {0}));
}

TEST(RotationFalseAlarms, ChanceIsTheShareOfRandomYawsThatAgree) {
  const KnownProblem problem = MakeMatchedProblem({}, /*seed=*/4);
  const auto alarms = RotationFalseAlarms(problem.source,
                                          problem.target,
                                          problem.true_target_from_source,
                                          kNoiseBound);
  ASSERT_TRUE(alarms);
  // A randomly rotated target difference is an inlier with this probability.
  // Differences of inconsistent lengths have no arc and are not counted.
  Random random(5);
  const Eigen::Index n = problem.source.cols();
  int num_inliers = 0;
  int num_with_arc = 0;
  constexpr int kNumTurns = 2000;
  for (Eigen::Index k = 0; k < n; ++k) {
    const Eigen::Index other = (k + n - 1) % n;
    const Eigen::Vector2d a =
        (problem.source.col(k) - problem.source.col(other)).head<2>();
    const Eigen::Vector2d b =
        (problem.target.col(k) - problem.target.col(other)).head<2>();
    if (std::abs(a.norm() - b.norm()) >= 2.0 * kNoiseBound) continue;
    ++num_with_arc;
    for (int turn = 0; turn < kNumTurns; ++turn) {
      const Eigen::Rotation2Dd by(2.0 * M_PI * random.Uniform());
      num_inliers += (b - by * a).norm() <= 2.0 * kNoiseBound;
    }
  }
  EXPECT_EQ(alarms->num_tested, num_with_arc);
  EXPECT_NEAR(alarms->chance,
              num_inliers / (1.0 * kNumTurns * num_with_arc),
              0.1 * alarms->chance);
}

TEST(RotationFalseAlarms, OfAPoleAreNone) {
  Points pole = Points::Zero(3, 10);
  pole.row(2).setLinSpaced(10, 0.0, 9.0);
  EXPECT_FALSE(RotationFalseAlarms(pole, pole, Rigid3(), kNoiseBound));
  EXPECT_FALSE(
      RotationFalseAlarms(Points(3, 0), Points(3, 0), Rigid3(), kNoiseBound));
}

}  // namespace
}  // namespace quatro::false_alarms_test
