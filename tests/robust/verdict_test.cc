// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/verdict.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "robust/quatro.h"
#include "tests/support/matched_problems.h"
#include "tests/support/random_problems.h"

namespace quatro {
namespace {

using ::testing::HasSubstr;

constexpr double kNoiseBound = 0.3;  // [m]

Verdict JudgeTruth(const KnownProblem& problem,
                   const VerdictOptions& options = {}) {
  return JudgeConsensus(problem.source,
                        problem.target,
                        problem.true_target_from_source,
                        kNoiseBound,
                        options);
}

// Term by term, from Pascal's triangle.
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
  // P[B(1000, 1/2) >= 600] = 1.3642e-10, and half and half at the middle.
  EXPECT_NEAR(Log10BinomialTail(1000, 600, 0.5), -9.865, 1e-3);
  EXPECT_NEAR(Log10BinomialTail(10001, 5001, 0.5), std::log10(0.5), 1e-9);
  EXPECT_NEAR(Log10BinomialTail(1000000, 10, 0.9), 0.0, 1e-12);
  // The first term rules: C(10000, 500) 1e-4^500, and hardly more.
  EXPECT_NEAR(Log10BinomialTail(10000, 500, 1e-4),
              (std::lgamma(10001.0) - std::lgamma(501.0) - std::lgamma(9501.0) +
               500.0 * std::log(1e-4) + 9500.0 * std::log1p(-1e-4)) /
                  std::log(10.0),
              1e-2);
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

TEST(JudgeConsensus, RegistersAGoodConsensus) {
  for (const Eigen::Index num_inliers : {10, 20, 100}) {
    const KnownProblem problem =
        MakeMatchedProblem({.num_inliers = num_inliers, .num_outliers = 200},
                           /*seed=*/1);
    const Verdict verdict = JudgeTruth(problem);
    EXPECT_TRUE(verdict.IsRegistered()) << verdict.reason;
    EXPECT_EQ(verdict.num_matches, num_inliers + 200);
    EXPECT_GE(verdict.num_agreeing, num_inliers);
    EXPECT_LT(verdict.num_agreeing, num_inliers + 3);
    EXPECT_LE(verdict.log10_false_alarms, -3.0);
  }
}

TEST(JudgeConsensus, FalseAlarmsAreEquationOne) {
  const Verdict verdict =
      JudgeTruth(MakeMatchedProblem({.num_inliers = 30}, /*seed=*/2));
  const double n = 70.0;
  EXPECT_NEAR(
      verdict.log10_false_alarms,
      std::log10(n * (n - 1.0) / 2.0) +
          Log10BinomialTail(
              68, verdict.num_agreeing - 2, verdict.chance_of_agreement),
      1e-12);
}

TEST(JudgeConsensus, ChanceIsTheShareOfAgreementAmongOtherPairings) {
  const KnownProblem problem = MakeMatchedProblem(
      {.num_outliers = 60, .half_widths = {3.0, 3.0, 1.0}}, /*seed=*/3);
  const Points moved = problem.true_target_from_source.Apply(problem.source);
  int num_agreeing = 0;
  for (Eigen::Index i = 0; i < 100; ++i) {
    for (Eigen::Index j = 0; j < 100; ++j) {
      const double worst =
          (problem.target.col(j) - moved.col(i)).cwiseAbs().maxCoeff();
      num_agreeing += i != j && worst <= kNoiseBound;
    }
  }
  EXPECT_GT(num_agreeing, 20);
  EXPECT_NEAR(JudgeTruth(problem).chance_of_agreement,
              (num_agreeing + 1) / (100.0 * 99.0),
              1e-12);
}

TEST(JudgeConsensus, OfTwoMatchesIsAmbiguous) {
  const Verdict verdict = JudgeTruth(
      MakeMatchedProblem({.num_inliers = 2, .num_outliers = 100}, /*seed=*/4));
  EXPECT_EQ(verdict.status, Status::kAmbiguous) << verdict.reason;
  EXPECT_THAT(verdict.reason, HasSubstr("by chance"));
}

TEST(JudgeConsensus, OfACrowdIsAmbiguous) {
  // All within the noise bound: any pose that brings them there will do.
  const Verdict verdict = JudgeTruth(MakeMatchedProblem(
      {.num_inliers = 100, .half_widths = {0.05, 0.05, 0.05}}, /*seed=*/5));
  EXPECT_EQ(verdict.status, Status::kAmbiguous) << verdict.reason;
  EXPECT_GT(verdict.num_agreeing, 50);
}

TEST(JudgeConsensus, OfTooFewMatchesIsAmbiguous) {
  for (const Eigen::Index n : {0, 1, 2}) {
    const Verdict verdict = JudgeTruth(
        MakeMatchedProblem({.num_inliers = n, .num_outliers = 0}, /*seed=*/6));
    EXPECT_EQ(verdict.status, Status::kAmbiguous) << verdict.reason;
    EXPECT_GE(verdict.log10_false_alarms, 0.0) << n << " matches";
  }
}

TEST(JudgeConsensus, CopiesAreNoEvidence) {
  const KnownProblem problem = MakeMatchedProblem({}, /*seed=*/7);
  const Verdict once = JudgeTruth(problem);
  const Verdict twice = JudgeConsensus(problem.source.replicate(1, 2),
                                       problem.target.replicate(1, 2),
                                       problem.true_target_from_source,
                                       kNoiseBound,
                                       {});
  EXPECT_EQ(twice.num_matches, once.num_matches);
  EXPECT_EQ(twice.num_agreeing, once.num_agreeing);
  EXPECT_EQ(twice.log10_false_alarms, once.log10_false_alarms);
}

TEST(JudgeConsensus, ReasonNamesTheNumbers) {
  const Verdict verdict = JudgeTruth(
      MakeMatchedProblem({.num_inliers = 30, .num_outliers = 40}, /*seed=*/8));
  EXPECT_THAT(verdict.reason,
              HasSubstr(std::to_string(verdict.num_agreeing) + " of 70 "));
  EXPECT_THAT(verdict.reason,
              HasSubstr("1e" + std::to_string(static_cast<int>(
                                   -verdict.log10_false_alarms))));
}

TEST(JudgeConsensus, ThresholdIsTheOption) {
  const KnownProblem problem = MakeMatchedProblem({}, /*seed=*/9);
  const double log10_false_alarms = JudgeTruth(problem).log10_false_alarms;
  VerdictOptions options;
  options.max_log10_false_alarms = log10_false_alarms + 0.01;
  EXPECT_TRUE(JudgeTruth(problem, options).IsRegistered());
  options.max_log10_false_alarms = log10_false_alarms - 0.01;
  EXPECT_EQ(JudgeTruth(problem, options).status, Status::kAmbiguous);
}

// Where scans have their matches: near a plane and dense near the sensor.
Points ScanLikePoints(Eigen::Index n, Random* random) {
  Points points(3, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double range = 3.0 * std::pow(20.0, random->Uniform());
    const double azimuth = M_PI * SignedUniform(random);
    points.col(i) << range * std::cos(azimuth), range * std::sin(azimuth),
        random->Below(2) == 0 ? 0.1 * random->Uniform()
                              : 4.0 * random->Uniform();
  }
  return points;
}

TEST(JudgeSummary, DoesNotRegisterMatchesAtRandom) {
  int num_registered = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Random random(seed);
    const Eigen::Index n = 20 + 20 * static_cast<Eigen::Index>(seed % 10);
    const bool scan_like = seed % 2;
    const Eigen::Vector3d box(30.0, 30.0, 3.0);
    const Points source = scan_like ? ScanLikePoints(n, &random)
                                    : RandomPointsInBox(n, box, &random);
    const Points target = scan_like ? ScanLikePoints(n, &random)
                                    : RandomPointsInBox(n, box, &random);
    const QuatroSummary summary = SolveQuatro(source, target, {});
    const Verdict verdict =
        JudgeSummary(source, target, summary, kNoiseBound, {});
    if (verdict.IsRegistered()) {
      ++num_registered;
      RecordProperty("registered_seed", static_cast<int>(seed));
    }
  }
  EXPECT_LE(num_registered, 1) << "of 200";
}

TEST(JudgeSummary, RegistersWhatQuatroFoundAmongOutliers) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const KnownProblem problem =
        MakeMatchedProblem({.num_inliers = 20, .num_outliers = 180}, seed);
    const QuatroSummary summary =
        SolveQuatro(problem.source, problem.target, {});
    const Verdict verdict =
        JudgeSummary(problem.source, problem.target, summary, kNoiseBound, {});
    EXPECT_TRUE(verdict.IsRegistered())
        << "seed " << seed << ": " << verdict.reason;
  }
}

TEST(JudgeSummary, PassesOnWhyThereIsNoAnswer) {
  const Points none(3, 0);
  QuatroSummary summary = SolveQuatro(none, none, {});
  Verdict verdict = JudgeSummary(none, none, summary, kNoiseBound, {});
  EXPECT_EQ(verdict.status, Status::kInsufficient);
  EXPECT_EQ(verdict.reason, summary.message);

  Points pole = Points::Zero(3, 10);
  pole.row(2).setLinSpaced(10, 0.0, 9.0);
  summary = SolveQuatro(pole, pole, {});
  verdict = JudgeSummary(pole, pole, summary, kNoiseBound, {});
  EXPECT_EQ(verdict.status, Status::kDegenerate);
  EXPECT_EQ(verdict.reason, summary.message);
  EXPECT_EQ(verdict.num_matches, 10);
  EXPECT_FALSE(verdict.IsRegistered());
}

class AddOverlapTest : public ::testing::Test {
 protected:
  Verdict registered_ = JudgeTruth(MakeMatchedProblem({}, /*seed=*/10));
  VerdictOptions options_{.min_structure_overlap = 0.4};
};

TEST_F(AddOverlapTest, TooLittleMakesItAmbiguousAndSaysSo) {
  ASSERT_TRUE(registered_.IsRegistered());
  AddOverlap(0.39, options_, &registered_);
  EXPECT_EQ(registered_.status, Status::kAmbiguous);
  EXPECT_EQ(registered_.structure_overlap, 0.39);
  EXPECT_THAT(registered_.reason, HasSubstr("39 %"));
  EXPECT_THAT(registered_.reason, HasSubstr("at least 40 %"));
}

TEST_F(AddOverlapTest, EnoughLeavesItRegistered) {
  AddOverlap(0.4, options_, &registered_);
  EXPECT_TRUE(registered_.IsRegistered());
  EXPECT_THAT(registered_.reason, HasSubstr("40 %"));
}

TEST_F(AddOverlapTest, NoneToSpeakOfChangesNothing) {
  const std::string reason = registered_.reason;
  AddOverlap(std::nullopt, options_, &registered_);
  EXPECT_TRUE(registered_.IsRegistered());
  EXPECT_EQ(registered_.reason, reason);
}

TEST_F(AddOverlapTest, DoesNotMakeAnAnswerOfNone) {
  Verdict degenerate;
  degenerate.status = Status::kDegenerate;
  AddOverlap(0.9, options_, &degenerate);
  EXPECT_EQ(degenerate.status, Status::kDegenerate);
  AddOverlap(0.0, options_, &degenerate);
  EXPECT_EQ(degenerate.status, Status::kDegenerate);
}

TEST(StatusName, IsTheWord) {
  EXPECT_STREQ(StatusName(Status::kRegistered), "registered");
  EXPECT_STREQ(StatusName(Status::kAmbiguous), "ambiguous");
  EXPECT_STREQ(StatusName(Status::kDegenerate), "degenerate");
  EXPECT_STREQ(StatusName(Status::kInsufficient), "insufficient");
}

TEST(VerdictOptions, ErrorNamesTheFieldThatIsOutOfRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::string error;
  EXPECT_TRUE(VerdictOptions().IsValid(&error)) << error;
  EXPECT_TRUE(error.empty());
  for (const double bad : {0.1, nan}) {
    EXPECT_FALSE(
        (VerdictOptions{.max_log10_false_alarms = bad}.IsValid(&error)));
    EXPECT_THAT(error, HasSubstr("max_log10_false_alarms"));
  }
  for (const double bad : {-0.1, 1.1, nan}) {
    EXPECT_FALSE(
        (VerdictOptions{.min_structure_overlap = bad}.IsValid(&error)));
    EXPECT_THAT(error, HasSubstr("min_structure_overlap"));
  }
}

}  // namespace
}  // namespace quatro
