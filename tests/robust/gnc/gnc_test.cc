// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/gnc/gnc.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "robust/gnc/quasi_so3.h"
#include "robust/gnc/surrogate.h"
#include "tests/support/matched_problems.h"
#include "tests/support/matchers.h"

namespace quatro::gnc_test {
namespace {

using ::testing::HasSubstr;

// The mean of values: the smallest subproblem, with results that can be
// computed by hand.
struct MeanSubproblem {
  using Estimate = double;
  Eigen::Index NumMeasurements() const { return values.size(); }
  double Identity() const { return 0.0; }
  std::optional<double> Solve(const WeightsRef& weights) const {
    if (!(weights.sum() > 0.0)) return std::nullopt;
    return weights.dot(values) / weights.sum();
  }
  Eigen::VectorXd SquaredResiduals(double mean) const {
    return ((values.array() - mean) / noise_bound).square();
  }

  Eigen::VectorXd values;
  double noise_bound = 1.0;
};

// The plain mean is 1, with squared residuals 1, 1, 1, 9; those from zero are
// 0, 0, 0, 16.
MeanSubproblem ThreeZerosAndAFour() { return {Eigen::Vector4d(0, 0, 0, 4)}; }

// Does not converge within a few iterations.
MeanSubproblem ThreeNearAndOneFar() {
  return {Eigen::Vector4d(0.0, 0.1, 0.3, 40.0)};
}

// Neither stopping criterion applies unless a test sets it.
GncOptions NeverConverging() {
  GncOptions options;
  options.binary_weight_tolerance = 0.0;
  options.relative_cost_tolerance = 0.0;
  return options;
}

// Thirty pairs with one yaw, off by at most 0.1 m, among seventy random pairs.
QuasiSo3 YawUnderSeventyPercentOutliers() {
  MatchedProblemOptions options;
  options.num_inliers = 60;
  options.num_outliers = 140;
  options.translation.setZero();
  const KnownProblem problem = MakeMatchedProblem(options, 1);
  return {problem.source, problem.target, 0.3};
}

template <typename Surrogate>
class GncTest : public ::testing::Test {};
using Surrogates = ::testing::Types<TruncatedLeastSquares, GemanMcClure>;
TYPED_TEST_SUITE(GncTest, Surrogates);

TYPED_TEST(GncTest, FindsTheYawUnderSeventyPercentOutliers) {
  const auto summary =
      SolveGnc<TypeParam>(YawUnderSeventyPercentOutliers(), GncOptions());
  ASSERT_TRUE(summary.IsUsable()) << summary.message;
  EXPECT_EQ(summary.termination, GncTermination::kConverged);
  EXPECT_THAT(summary.estimate->target_from_source, IsAngleNear(2.0, 2e-3));
}

TYPED_TEST(GncTest, StartFromIdentityFindsItToo) {
  GncOptions options;
  options.start = GncStart::kIdentity;
  const auto summary =
      SolveGnc<TypeParam>(YawUnderSeventyPercentOutliers(), options);
  ASSERT_TRUE(summary.IsUsable()) << summary.message;
  EXPECT_THAT(summary.estimate->target_from_source, IsAngleNear(2.0, 2e-3));
}

TYPED_TEST(GncTest, EstimateWeightsAndResidualsBelongTogether) {
  const QuasiSo3 subproblem = YawUnderSeventyPercentOutliers();
  const auto summary = SolveGnc<TypeParam>(subproblem, GncOptions());
  ASSERT_TRUE(summary.IsUsable());
  EXPECT_EQ(subproblem.Solve(summary.weights)->target_from_source,
            summary.estimate->target_from_source);
  EXPECT_EQ(subproblem.SquaredResiduals(*summary.estimate),
            summary.squared_residuals);
  EXPECT_EQ(summary.iterations.back().cost,
            summary.weights.dot(summary.squared_residuals));
  EXPECT_EQ(summary.iterations.back().sum_of_weights, summary.weights.sum());
}

TYPED_TEST(GncTest, UnitOfLengthDoesNotMatter) {
  QuasiSo3 millimetres = YawUnderSeventyPercentOutliers();
  const auto expected = SolveGnc<TypeParam>(millimetres, GncOptions());
  millimetres.source *= 1024.0;
  millimetres.target *= 1024.0;
  millimetres.noise_bound *= 1024.0;
  const auto summary = SolveGnc<TypeParam>(millimetres, GncOptions());
  EXPECT_EQ(summary.estimate->target_from_source,
            expected.estimate->target_from_source);
  EXPECT_EQ(summary.weights, expected.weights);
}

TYPED_TEST(GncTest, KeepsThePlainFitWhereAllAreInliers) {
  const auto summary = SolveGnc<TypeParam>(
      MeanSubproblem{Eigen::Vector3d(1.0, 2.0, 3.0)}, GncOptions());
  EXPECT_EQ(summary.termination, GncTermination::kAllInliers);
  EXPECT_TRUE(summary.iterations.empty());
  ASSERT_TRUE(summary.IsUsable());
  EXPECT_EQ(*summary.estimate, 2.0);
  EXPECT_EQ(summary.weights, Eigen::Vector3d::Ones());
  EXPECT_EQ(summary.squared_residuals, Eigen::Vector3d(1.0, 0.0, 1.0));
}

TYPED_TEST(GncTest, FarOutliersDoNotEndItBeforeItBegins) {
  // Seven values near one, three outliers up to 3.4e4 bounds away. The first
  // weights of truncated least squares are all below 1e-6.
  for (const double far : {10.0, 100.0, 500.0, 1e3, 2e3}) {
    Eigen::VectorXd values(10);
    values << 1.0, 1.01, 0.99, 1.0, 0.98, 1.02, 1.0, far, 1.3 * far, 1.7 * far;
    const auto summary =
        SolveGnc<TypeParam>(MeanSubproblem{values, 0.1}, GncOptions());
    ASSERT_TRUE(summary.IsUsable()) << far << ": " << summary.message;
    EXPECT_EQ(summary.termination, GncTermination::kConverged);
    EXPECT_NEAR(*summary.estimate, 1.0, 0.01) << far;
  }
}

TYPED_TEST(GncTest, AnswerWithNothingWithinItsBoundIsNotUsable) {
  // No two values are within two bounds of each other, nor of any mean.
  GncOptions options;
  options.binary_weight_tolerance = 0.5;
  options.relative_cost_tolerance = 1e9;
  const auto summary = SolveGnc<TypeParam>(
      MeanSubproblem{Eigen::Vector4d(-30.0, -10.0, 10.0, 30.0)}, options);
  EXPECT_EQ(summary.termination, GncTermination::kUndetermined);
  EXPECT_FALSE(summary.IsUsable()) << *summary.estimate;
}

TYPED_TEST(GncTest, NoMeasurementsDetermineNothing) {
  const auto summary =
      SolveGnc<TypeParam>(MeanSubproblem{Eigen::VectorXd(0)}, GncOptions());
  EXPECT_EQ(summary.termination, GncTermination::kUndetermined);
  EXPECT_THAT(summary.message, HasSubstr("do not determine"));
  EXPECT_FALSE(summary.IsUsable());
}

TYPED_TEST(GncTest, StopsOnceWeightsAreBinaryEnough) {
  GncOptions options = NeverConverging();
  options.binary_weight_tolerance = 0.5;  // One weight exceeds this.
  const auto summary = SolveGnc<TypeParam>(
      MeanSubproblem{Eigen::Vector4d(0.0, 0.0, 0.0, 1.2), 0.5}, options);
  EXPECT_EQ(summary.termination, GncTermination::kConverged);
  EXPECT_EQ(summary.iterations.size(), 1u);
}

TYPED_TEST(GncTest, StopsOnceTheCostSettles) {
  GncOptions options = NeverConverging();
  options.relative_cost_tolerance = 1e9;  // Compares two costs.
  MeanSubproblem mean = ThreeNearAndOneFar();
  mean.noise_bound = 5.0;
  const auto summary = SolveGnc<TypeParam>(mean, options);
  EXPECT_EQ(summary.termination, GncTermination::kConverged);
  EXPECT_EQ(summary.iterations.size(), 2u);
}

TYPED_TEST(GncTest, StopsUsableWhenIterationsRunOut) {
  GncOptions options = NeverConverging();
  options.max_num_iterations = 3;
  const auto summary = SolveGnc<TypeParam>(ThreeNearAndOneFar(), options);
  EXPECT_EQ(summary.termination, GncTermination::kMaxNumIterations);
  EXPECT_TRUE(summary.IsUsable());
  EXPECT_EQ(summary.iterations.size(), 3u);
}

TYPED_TEST(GncTest, MuMovesByItsStepEachIteration) {
  GncOptions options = NeverConverging();
  options.mu_step = 1.5;
  options.max_num_iterations = 3;
  const auto summary = SolveGnc<TypeParam>(ThreeNearAndOneFar(), options);
  ASSERT_EQ(summary.iterations.size(), 3u);
  for (std::size_t i = 1; i < 3; ++i) {
    EXPECT_EQ(summary.iterations[i].mu,
              TypeParam::NextMu(summary.iterations[i - 1].mu, 1.5))
        << "iteration " << i;
  }
}

TYPED_TEST(GncTest, ASolveLeavesNothingBehindForTheNext) {
  const QuasiSo3 subproblem = YawUnderSeventyPercentOutliers();
  const auto first = SolveGnc<TypeParam>(subproblem, GncOptions());
  SolveGnc<TypeParam>(ThreeZerosAndAFour(), GncOptions());
  const auto second = SolveGnc<TypeParam>(subproblem, GncOptions());
  EXPECT_EQ(first.estimate->target_from_source,
            second.estimate->target_from_source);
  EXPECT_EQ(first.weights, second.weights);
  EXPECT_EQ(first.iterations.size(), second.iterations.size());
}

TEST(GncStart, PlainFitTakesMuFromItsResiduals) {
  const MeanSubproblem mean = ThreeZerosAndAFour();
  const auto tls = SolveGnc<TruncatedLeastSquares>(mean, GncOptions());
  EXPECT_DOUBLE_EQ(tls.iterations.front().mu, 1.0 / (2.0 * 9.0 - 1.0));
  const auto gm = SolveGnc<GemanMcClure>(mean, GncOptions());
  EXPECT_DOUBLE_EQ(gm.iterations.front().mu, 2.0 * 9.0);
}

TEST(GncStart, IdentityTakesMuFromTheResidualsBeforeAnyFit) {
  GncOptions options;
  options.start = GncStart::kIdentity;
  const MeanSubproblem mean = ThreeZerosAndAFour();
  const auto tls = SolveGnc<TruncatedLeastSquares>(mean, options);
  EXPECT_DOUBLE_EQ(tls.iterations.front().mu, 1.0 / (16.0 - 1.0));
  const auto gm = SolveGnc<GemanMcClure>(mean, options);
  EXPECT_DOUBLE_EQ(gm.iterations.front().mu, 2.0 * 16.0);
}

TEST(GncStart, IdentityThatFitsKeepsThePlainFit) {
  GncOptions options;
  options.start = GncStart::kIdentity;
  const auto summary = SolveGnc<TruncatedLeastSquares>(
      MeanSubproblem{Eigen::Vector2d(0.2, 0.6)}, options);
  EXPECT_EQ(summary.termination, GncTermination::kAllInliers);
  EXPECT_DOUBLE_EQ(*summary.estimate, 0.4);
}

TEST(GncIteration, FirstOneByHand) {
  // mu = 1/17, bounds at 1/18 and 18: sqrt(mu (mu + 1) / r2) - mu is
  // (sqrt(18) - 1) / 17 for r2 = 1 and (sqrt(2) - 1) / 17 for r2 = 9.
  GncOptions options = NeverConverging();
  options.max_num_iterations = 1;
  const auto summary =
      SolveGnc<TruncatedLeastSquares>(ThreeZerosAndAFour(), options);
  const double w1 = (std::sqrt(18.0) - 1.0) / 17.0;
  const double w9 = (std::sqrt(2.0) - 1.0) / 17.0;
  ASSERT_EQ(summary.weights.size(), 4);
  EXPECT_NEAR(summary.weights[0], w1, 1e-15);
  EXPECT_NEAR(summary.weights[3], w9, 1e-15);
  const double mean = 4.0 * w9 / (3.0 * w1 + w9);
  EXPECT_NEAR(*summary.estimate, mean, 1e-15);
  EXPECT_NEAR(summary.iterations[0].cost,
              3.0 * w1 * mean * mean + w9 * (4.0 - mean) * (4.0 - mean),
              1e-14);
  EXPECT_NEAR(summary.iterations[0].sum_of_weights, 3.0 * w1 + w9, 1e-15);
}

TEST(GncTermination, GemanMcClureStopsWhereItIsExact) {
  const auto summary =
      SolveGnc<GemanMcClure>(ThreeZerosAndAFour(), NeverConverging());
  EXPECT_EQ(summary.termination, GncTermination::kConverged);
  EXPECT_EQ(summary.iterations.back().mu, 1.0);
  // From 18 down to 1 by factors of 1.4, both ends included.
  EXPECT_EQ(
      summary.iterations.size(),
      1u + static_cast<std::size_t>(std::ceil(std::log(18.0) / std::log(1.4))));
}

TEST(GncTermination, TruncatedLeastSquaresEndsWithBinaryWeights) {
  GncOptions options;
  options.relative_cost_tolerance = 0.0;
  const auto summary =
      SolveGnc<TruncatedLeastSquares>(ThreeZerosAndAFour(), options);
  EXPECT_EQ(summary.termination, GncTermination::kConverged);
  EXPECT_EQ(summary.weights, Eigen::Vector4d(1, 1, 1, 0));
  EXPECT_EQ(*summary.estimate, 0.0);
}

TEST(GncTermination, WeightThatRunsOutIsNoAnswer) {
  // Two contradicting values stay at r2 = 100 on either side of the mean until
  // both are outliers. The result is an error, not 0 / 0 or the last mean.
  const auto summary = SolveGnc<TruncatedLeastSquares>(
      MeanSubproblem{Eigen::Vector2d(-10.0, 10.0)}, GncOptions());
  EXPECT_EQ(summary.termination, GncTermination::kUndetermined);
  EXPECT_THAT(summary.message, HasSubstr("measurements were rejected"));
  EXPECT_FALSE(summary.IsUsable());
  EXPECT_GT(summary.iterations.size(), 1u);
}

TEST(GncOptions, DefaultsAreValid) {
  std::string error;
  EXPECT_TRUE(GncOptions().IsValid(&error)) << error;
  EXPECT_TRUE(error.empty());
}

TEST(GncOptions, ErrorNamesTheFieldThatIsOutOfRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto expect_error = [](const GncOptions& options, const char* field) {
    std::string error;
    EXPECT_FALSE(options.IsValid(&error)) << field;
    EXPECT_THAT(error, HasSubstr(field));
  };
  expect_error({.max_num_iterations = 0}, "max_num_iterations = 0");
  expect_error({.mu_step = 1.0}, "mu_step = 1");
  expect_error({.mu_step = nan}, "mu_step = nan");
  expect_error({.mu_step = HUGE_VAL}, "mu_step = inf, must be > 1 and finite");
  expect_error({.binary_weight_tolerance = -1e-3}, "binary_weight_tolerance");
  expect_error({.relative_cost_tolerance = nan}, "relative_cost_tolerance");
}

TEST(GncOptions, InvalidOnesAreRefusedBeforeAnythingIsTried) {
  const auto summary = SolveGnc<GemanMcClure>(
      MeanSubproblem{Eigen::VectorXd(0)}, {.mu_step = 0.5});
  EXPECT_EQ(summary.termination, GncTermination::kInvalidOptions);
  EXPECT_THAT(summary.message, HasSubstr("mu_step"));
  EXPECT_FALSE(summary.IsUsable());
}

}  // namespace
}  // namespace quatro::gnc_test
