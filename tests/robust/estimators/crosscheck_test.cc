// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/estimators/crosscheck.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <optional>

#include "experiments/simulator/synthetic.h"
#include "robust/estimators/quatro.h"
#include "robust/estimators/teaser.h"
#include "robust/gnc/gnc.h"
#include "robust/gnc/surrogate.h"
#include "tests/support/random_problems.h"

namespace quatro::crosscheck_test {
namespace {

constexpr double kTolerance = 1e-8;  // [rad], [m]
constexpr double kOff = 1e-3;        // Error of a mutant [rad].

void ExpectAgreement(const PoseSummary& summary, std::uint64_t seed) {
  ASSERT_TRUE(summary.crosscheck.has_value()) << "seed " << seed;
  EXPECT_GT(summary.crosscheck->num_subproblems, 2) << "seed " << seed;
  EXPECT_LT(summary.crosscheck->max_rotation_difference, kTolerance)
      << "seed " << seed;
  EXPECT_LT(summary.crosscheck->max_translation_difference, kTolerance)
      << "seed " << seed;
}

TEST(Crosscheck, ClosedFormsOfQuatroAreThoseOfCeres) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const double ratio = 0.3 + 0.03 * static_cast<double>(seed);
    const MatchedProblem problem = MakeOutlierProblem(100, ratio, 0.1, seed);
    QuatroOptions options;
    options.crosscheck = true;
    if (seed % 2 == 1) options.pruning = Pruning::kNone;
    const QuatroSummary checked =
        SolveQuatro(problem.source, problem.target, options);
    ASSERT_TRUE(checked.IsUsable()) << checked.message;
    ExpectAgreement(checked, seed);
    // The cross-check does not change the result.
    options.crosscheck = false;
    const QuatroSummary plain =
        SolveQuatro(problem.source, problem.target, options);
    EXPECT_FALSE(plain.crosscheck.has_value());
    EXPECT_EQ(plain.target_from_source->ToMatrix(),
              checked.target_from_source->ToMatrix())
        << "seed " << seed;
  }
}

TEST(Crosscheck, ClosedFormsOfTeaserAreThoseOfCeres) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const double ratio = 0.3 + 0.03 * static_cast<double>(seed);
    const MatchedProblem problem = MakeOutlierProblem(100, ratio, 0.1, seed);
    TeaserOptions options;
    options.crosscheck = true;
    const TeaserSummary checked =
        SolveTeaser(problem.source, problem.target, options);
    ASSERT_TRUE(checked.IsUsable()) << checked.message;
    ExpectAgreement(checked, seed);
    options.crosscheck = false;
    EXPECT_EQ(SolveTeaser(problem.source, problem.target, options)
                  .target_from_source->ToMatrix(),
              checked.target_from_source->ToMatrix())
        << "seed " << seed;
  }
}

// Subproblems whose closed form has a small error.
struct OffQuasiSo3 : QuasiSo3 {
  std::optional<Estimate> Solve(const WeightsRef& weights) const {
    auto estimate = QuasiSo3::Solve(weights);
    if (estimate) estimate->target_from_source += kOff;
    return estimate;
  }
};

struct OffSo3 : So3 {
  std::optional<Estimate> Solve(const WeightsRef& weights) const {
    auto estimate = So3::Solve(weights);
    if (estimate) {
      estimate->target_from_source =
          Eigen::AngleAxisd(kOff, Eigen::Vector3d(2.0, -1.0, 2.0) / 3.0)
              .toRotationMatrix() *
          estimate->target_from_source;
    }
    return estimate;
  }
};

template <typename Subproblem>
CrosscheckReport ReportOf(const Subproblem& subproblem) {
  const CrossChecked<Subproblem> checked(subproblem);
  SolveGnc<TruncatedLeastSquares>(checked, GncOptions());
  return checked.report();
}

TEST(Crosscheck, AClosedFormThatIsOffIsReportedByHowMuch) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const MatchedProblem tims = MakeTimProblem(60, 0.4, 0.1, seed);
    const QuasiSo3 yaw{tims.source, tims.target, 0.3};
    const So3 rotation{tims.source, tims.target, 0.3};

    const CrosscheckReport right_yaw = ReportOf(yaw);
    EXPECT_GT(right_yaw.num_subproblems, 1);
    EXPECT_LT(right_yaw.max_rotation_difference, kTolerance) << "seed " << seed;
    const CrosscheckReport right_rotation = ReportOf(rotation);
    EXPECT_GT(right_rotation.num_subproblems, 1);
    EXPECT_LT(right_rotation.max_rotation_difference, kTolerance)
        << "seed " << seed;

    EXPECT_NEAR(ReportOf(OffQuasiSo3{yaw}).max_rotation_difference, kOff, 1e-7)
        << "seed " << seed;
    EXPECT_NEAR(ReportOf(OffSo3{rotation}).max_rotation_difference, kOff, 1e-7)
        << "seed " << seed;
  }
}

TEST(Crosscheck, GivesTheAnswersOfTheSubproblem) {
  const MatchedProblem tims = MakeTimProblem(60, 0.4, 0.1, 1);
  const QuasiSo3 yaw{tims.source, tims.target, 0.3};
  const CrossChecked<QuasiSo3> checked(yaw);
  EXPECT_EQ(checked.report().num_subproblems, 0);
  EXPECT_EQ(checked.NumMeasurements(), 60);
  EXPECT_EQ(checked.Solve(Weights::Ones(60))->target_from_source,
            yaw.Solve(Weights::Ones(60))->target_from_source);
  EXPECT_EQ(checked.report().num_subproblems, 1);
  EXPECT_FALSE(checked.Solve(Weights::Zero(60)));
  EXPECT_EQ(checked.report().num_subproblems, 1);
  const auto estimate = *yaw.Solve(Weights::Ones(60));
  EXPECT_EQ(checked.SquaredResiduals(estimate), yaw.SquaredResiduals(estimate));
}

TEST(Crosscheck, PosesAreAddedToTheReport) {
  const MatchedProblem problem = MakeOutlierProblem(30, 0.0, 0.1, 1);
  std::optional<CrosscheckReport> report;
  CrosscheckPose(Points(3, 0), Points(3, 0), &report);
  ASSERT_TRUE(report.has_value());
  EXPECT_EQ(report->num_subproblems, 0);
  // Two matches determine a yaw and a translation; more also the full pose.
  CrosscheckPose(
      problem.source.leftCols(2), problem.target.leftCols(2), &report);
  EXPECT_EQ(report->num_subproblems, 1);
  CrosscheckPose(problem.source, problem.target, &report);
  EXPECT_EQ(report->num_subproblems, 3);
  EXPECT_LT(report->max_rotation_difference, kTolerance);
  EXPECT_LT(report->max_translation_difference, kTolerance);
}

}  // namespace
}  // namespace quatro::crosscheck_test
