// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The certificate of Quatro (its gap to the optimum), and the degeneracy that
// the paper describes.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "experiments/simulator/synthetic.h"
#include "features/base/degree.h"
#include "robust/estimators/quatro.h"
#include "robust/estimators/teaser.h"
#include "tests/support/matchers.h"

namespace quatro::quatro_certificate_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

QuatroSummary Solve(const MatchedProblem& problem,
                    const QuatroOptions& options) {
  return SolveQuatro(problem.source, problem.target, options);
}

TEST(QuatroCertificate, EveryAnswerHasOneAndItsGapIsNotNegative) {
  int num_answers = 0;
  int num_gaps = 0;
  for (const TimLayout layout :
       {TimLayout::kRing, TimLayout::kComplete, TimLayout::kRandom}) {
    for (const Pruning pruning : {Pruning::kCliqueHeuristic, Pruning::kNone}) {
      for (const SurrogateType surrogate :
           {SurrogateType::kTruncatedLeastSquares,
            SurrogateType::kGemanMcClure,
            SurrogateType::kWelsch}) {
        for (std::uint64_t seed = 0; seed < 10; ++seed) {
          const double ratio = 0.1 * static_cast<double>(seed);
          const MatchedProblem problem =
              MakeOutlierProblem(100, ratio, 0.1, seed);
          QuatroOptions options;
          options.tim_layout = layout;
          options.pruning = pruning;
          options.surrogate = surrogate;
          const QuatroSummary summary = Solve(problem, options);
          if (!summary.IsUsable()) continue;
          ++num_answers;
          ASSERT_TRUE(summary.certificate.has_value()) << "seed " << seed;
          EXPECT_GE(summary.certificate->optimal_cost, 0.0);
          EXPECT_LE(summary.certificate->optimal_cost,
                    static_cast<double>(summary.num_tims));
          EXPECT_EQ(summary.certificate->gnc_cost.has_value(),
                    summary.gnc.IsUsable());
          if (!summary.certificate->gap) continue;
          ++num_gaps;
          EXPECT_GE(*summary.certificate->gap,
                    -1e-9 * (1.0 + summary.certificate->optimal_cost))
              << "seed " << seed;
          EXPECT_EQ(*summary.certificate->gap,
                    *summary.certificate->gnc_cost -
                        summary.certificate->optimal_cost);
          EXPECT_EQ(summary.is_yaw_exact, *summary.certificate->gap > 1e-6);
        }
      }
    }
  }
  EXPECT_GT(num_answers, 150);
  EXPECT_GT(num_gaps, 150);
}

// Without pruning, less than 1 % of the TIMs are inliers, because only the
// square root of that, 6 or 8 %, of the matches are.
class MissedOptimumTest : public ::testing::TestWithParam<TimLayout> {
 protected:
  MissedOptimumTest() {
    options_.tim_layout = GetParam();
    options_.pruning = Pruning::kNone;
    options_.recover_translation = false;
    options_.polish = false;
  }

  MatchedProblem ProblemOf(std::uint64_t seed) const {
    return GetParam() == TimLayout::kRing
               ? MakeOutlierProblem(2000, 0.92, 0.1, seed)
               : MakeOutlierProblem(300, 0.94, 0.1, seed);
  }

  QuatroOptions options_;
};

INSTANTIATE_TEST_SUITE_P(,
                         MissedOptimumTest,
                         ::testing::Values(TimLayout::kRing,
                                           TimLayout::kRandom),
                         [](const auto& parameter) {
                           return parameter.param == TimLayout::kRing
                                      ? "Ring"
                                      : "Random";
                         });

TEST_P(MissedOptimumTest, IsReplacedAndSaidSo) {
  int num_missed = 0;
  int num_gnc_right = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const MatchedProblem problem = ProblemOf(seed);
    const double truth = Yaw(problem.true_target_from_source.rotation);
    options_.replace_missed_optimum = true;
    const QuatroSummary replaced = Solve(problem, options_);
    options_.replace_missed_optimum = false;
    const QuatroSummary kept = Solve(problem, options_);
    options_.yaw_solver = YawSolver::kExact;
    const QuatroSummary exact = Solve(problem, options_);
    options_.yaw_solver = YawSolver::kGnc;

    ASSERT_TRUE(replaced.IsUsable() && exact.IsUsable()) << "seed " << seed;
    EXPECT_THAT(exact.yaw, IsAngleNear(truth, kDegree)) << "seed " << seed;
    EXPECT_THAT(replaced.yaw, IsAngleNear(truth, kDegree)) << "seed " << seed;
    EXPECT_TRUE(exact.is_yaw_exact);
    EXPECT_EQ(exact.message, "solved");
    EXPECT_FALSE(kept.is_yaw_exact);
    if (kept.IsUsable()) {
      EXPECT_EQ(kept.yaw, kept.gnc.estimate->target_from_source);
      EXPECT_THAT(kept.message, Not(HasSubstr("missed the optimum")));
      EXPECT_GE(*kept.certificate->gnc_cost,
                exact.certificate->optimal_cost - 1e-9);
      num_gnc_right +=
          std::abs(std::remainder(kept.yaw - truth, 2.0 * M_PI)) <= kDegree;
    }
    if (!replaced.is_yaw_exact) {
      EXPECT_EQ(replaced.message, "solved");
      EXPECT_EQ(replaced.yaw, kept.yaw) << "seed " << seed;
      continue;
    }
    ++num_missed;
    EXPECT_THAT(replaced.message, HasSubstr("missed the optimum"));
    EXPECT_EQ(replaced.yaw, exact.yaw) << "seed " << seed;
    EXPECT_EQ(replaced.certificate->gap, kept.certificate->gap);
    if (replaced.certificate->gap) {
      EXPECT_GT(*replaced.certificate->gap, options_.certificate_tolerance);
      EXPECT_GT(std::abs(std::remainder(kept.yaw - exact.yaw, 2.0 * M_PI)),
                1e-9);
    }
  }
  EXPECT_GT(num_missed, 0) << "too easy to tell the two apart";
  RecordProperty("missed", num_missed);
  RecordProperty("gnc_right", num_gnc_right);
}

TEST_P(MissedOptimumTest, ToleranceDecidesWhatIsMissed) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    options_.certificate_tolerance = 1e6;
    const QuatroSummary summary = Solve(ProblemOf(seed), options_);
    // Only a missing answer is worse.
    EXPECT_EQ(summary.is_yaw_exact, !summary.gnc.IsUsable()) << "seed " << seed;
  }
}

// 50 matches of which few are inliers and no two outliers are consistent.
class DegenerateTest : public ::testing::TestWithParam<int> {
 protected:
  static constexpr double kNoiseBound = 0.3;  // [m]
  static MatchedProblem ProblemOf(std::uint64_t seed) {
    return MakeDegenerateProblem(
        50, GetParam(), kNoiseBound / 3.0, 2.0 * kNoiseBound, seed);
  }
};

INSTANTIATE_TEST_SUITE_P(TrueMatches,
                         DegenerateTest,
                         ::testing::Values(1, 2, 3, 5),
                         ::testing::PrintToStringParamName());

TEST_P(DegenerateTest, QuatroNeedsTwo) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const MatchedProblem problem = ProblemOf(seed);
    const QuatroSummary summary = Solve(problem, QuatroOptions());
    EXPECT_EQ(summary.num_consistent, GetParam()) << "seed " << seed;
    if (GetParam() < 2) {
      EXPECT_EQ(summary.termination, PoseTermination::kInsufficient);
      EXPECT_FALSE(summary.IsUsable()) << "seed " << seed;
      continue;
    }
    ASSERT_TRUE(summary.IsUsable()) << "seed " << seed << summary.message;
    EXPECT_LE(AngleBetween(summary.target_from_source->rotation,
                           problem.true_target_from_source.rotation),
              5.0 * kDegree)
        << "seed " << seed;
  }
}

TEST_P(DegenerateTest, TeaserNeedsThree) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const MatchedProblem problem = ProblemOf(seed);
    const TeaserSummary summary =
        SolveTeaser(problem.source, problem.target, TeaserOptions());
    if (GetParam() < 3) {
      EXPECT_EQ(summary.termination, PoseTermination::kInsufficient);
      EXPECT_FALSE(summary.IsUsable()) << "seed " << seed;
    } else {
      EXPECT_TRUE(summary.IsUsable()) << "seed " << seed << summary.message;
    }
  }
}

}  // namespace
}  // namespace quatro::quatro_certificate_test
