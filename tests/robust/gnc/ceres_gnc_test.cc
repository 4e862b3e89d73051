// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/gnc/ceres_gnc.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "features/base/random.h"
#include "robust/gnc/chi_square.h"
#include "robust/gnc/quasi_so3.h"
#include "solvers/ceres/manifolds.h"
#include "tests/support/matched_problems.h"
#include "tests/support/matchers.h"

namespace quatro::ceres_gnc_test {
namespace {

using ::testing::HasSubstr;
using Id = ceres::ResidualBlockId;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// kDim residuals, each (x - value) / sigma.
template <int kDim>
struct OffsetFrom {
  template <typename T>
  bool operator()(const T* x, T* residual) const {
    for (int i = 0; i < kDim; ++i) residual[i] = (x[0] - value) / sigma;
    return true;
  }
  double value;
  double sigma = 1.0;
};

template <int kDim = 1>
ceres::CostFunction* MakeOffset(double value, double sigma = 1.0) {
  return new ceres::AutoDiffCostFunction<OffsetFrom<kDim>, kDim, 1>(
      new OffsetFrom<kDim>{value, sigma});
}

// The mean of values: the smallest problem, with results that can be computed
// by hand.
struct MeanProblem {
  explicit MeanProblem(const std::vector<double>& values,
                       ceres::LossFunction* loss = nullptr) {
    for (const double value : values) {
      ids.push_back(problem.AddResidualBlock(MakeOffset(value), loss, &x));
    }
  }
  double x = 0.0;
  std::vector<Id> ids;
  ceres::Problem problem;
};

// About the tightest tolerance for Ceres: below it the steps are rounding
// errors, which Ceres treats as a failure.
CeresGncOptions Tight(double bound = 1.0) {
  CeresGncOptions options;
  options.bound = bound;
  options.solver.function_tolerance = 1e-14;
  options.solver.gradient_tolerance = 1e-12;
  options.solver.parameter_tolerance = 1e-14;
  options.solver.max_num_iterations = 200;
  options.solver.logging_type = ceres::SILENT;
  return options;
}

CeresGncOptions NeverConverging() {
  CeresGncOptions options = Tight();
  options.gnc.binary_weight_tolerance = 0.0;
  options.gnc.relative_cost_tolerance = 0.0;
  return options;
}

// The mean as a subproblem of robust/gnc/gnc.h, in closed form.
struct MeanSubproblem {
  using Estimate = double;
  Eigen::Index NumMeasurements() const { return values.size(); }
  double Identity() const { return 0.0; }
  std::optional<double> Solve(const WeightsRef& weights) const {
    return weights.dot(values) / weights.sum();
  }
  Eigen::VectorXd SquaredResiduals(double mean) const {
    return (values.array() - mean).square();
  }
  Eigen::VectorXd values;
};

// The loop equals that of quasi-SO(3)

TEST(CeresGncTest, TakesTheStepsOfTheClosedForm) {
  const std::vector<double> values = {0.0, 0.1, 0.3, -0.2, 7.0, 9.0, -40.0};
  const MeanSubproblem closed{
      Eigen::Map<const Eigen::VectorXd>(values.data(), 7)};
  for (const auto start : {GncStart::kPlainFit, GncStart::kIdentity}) {
    MeanProblem mean(values);
    CeresGncOptions options = Tight();
    options.gnc.start = start;
    const auto expected = SolveGnc<TruncatedLeastSquares>(closed, options.gnc);
    const auto summary = SolveCeresGnc(&mean.problem, options);
    EXPECT_EQ(summary.termination, expected.termination);
    EXPECT_EQ(summary.message, expected.message);
    EXPECT_NEAR(mean.x, *expected.estimate, 1e-9);
    ASSERT_EQ(summary.iterations.size(), expected.iterations.size());
    for (std::size_t i = 0; i < summary.iterations.size(); ++i) {
      EXPECT_NEAR(
          summary.iterations[i].mu / expected.iterations[i].mu, 1.0, 1e-9);
      EXPECT_NEAR(
          2.0 * summary.iterations[i].cost, expected.iterations[i].cost, 1e-7);
      EXPECT_NEAR(summary.iterations[i].sum_of_weights,
                  expected.iterations[i].sum_of_weights,
                  1e-7);
    }
    for (std::size_t i = 0; i < 7; ++i) {
      EXPECT_NEAR(summary.blocks.at(mean.ids[i]).weight,
                  expected.weights[static_cast<Eigen::Index>(i)],
                  1e-9);
    }
  }
}

// q - R(yaw) p in the plane, yaw a point on the unit circle.
struct PlanarTurn {
  template <typename T>
  bool operator()(const T* r, T* residual) const {
    residual[0] = q.x() - (r[0] * p.x() - r[1] * p.y());
    residual[1] = q.y() - (r[1] * p.x() + r[0] * p.y());
    return true;
  }
  Eigen::Vector2d p, q;
};

TEST(CeresGncTest, FindsTheYawOfQuasiSo3) {
  MatchedProblemOptions matches;
  matches.num_inliers = 60;
  matches.num_outliers = 140;
  matches.translation.setZero();
  const KnownProblem known = MakeMatchedProblem(matches, 1);
  const auto expected = SolveGnc<TruncatedLeastSquares>(
      QuasiSo3{known.source, known.target, 0.3}, GncOptions());

  double turn[2] = {1.0, 0.0};
  ceres::Problem problem;
  problem.AddParameterBlock(turn, 2, new UnitCircleManifold);
  std::vector<Id> ids;
  for (Eigen::Index i = 0; i < known.source.cols(); ++i) {
    ids.push_back(problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<PlanarTurn, 2, 2>(new PlanarTurn{
            known.source.col(i).head<2>(), known.target.col(i).head<2>()}),
        nullptr,
        turn));
  }
  const auto summary = SolveCeresGnc(&problem, Tight(0.3));
  ASSERT_TRUE(summary.IsUsable()) << summary.FullReport();
  EXPECT_THAT(std::atan2(turn[1], turn[0]),
              IsAngleNear(expected.estimate->target_from_source, 1e-8));
  EXPECT_EQ(summary.iterations.size(), expected.iterations.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    EXPECT_NEAR(summary.blocks.at(ids[i]).weight,
                expected.weights[static_cast<Eigen::Index>(i)],
                1e-6);
  }
}

// Start and update of mu

TEST(CeresGncMu, StartsFromThePlainFit) {
  MeanProblem mean({0.0, 0.0, 0.0, 4.0});  // Mean 1, largest r2 9.
  CeresGncOptions options = Tight();
  EXPECT_NEAR(SolveCeresGnc(&mean.problem, options).iterations.front().mu,
              1.0 / 17.0,
              1e-9);
  options.surrogate = SurrogateType::kGemanMcClure;
  EXPECT_NEAR(
      SolveCeresGnc(&mean.problem, options).iterations.front().mu, 18.0, 1e-6);
}

TEST(CeresGncMu, StartsFromTheValuesGiven) {
  MeanProblem mean({0.0, 0.0, 0.0, 4.0});
  CeresGncOptions options = Tight();
  options.gnc.start = GncStart::kIdentity;
  mean.x = -1.0;  // Largest r2 25.
  EXPECT_NEAR(SolveCeresGnc(&mean.problem, options).iterations.front().mu,
              1.0 / 24.0,
              1e-12);
}

TEST(CeresGncMu, StartsFromTheLargestResidualOverItsOwnBound) {
  MeanProblem mean({0.0, 0.0, 0.0, 4.0});  // r2 1, 1, 1, 9.
  CeresGncOptions options = Tight(3.0);
  options.bounds = {{mean.ids[0], 0.2}};
  EXPECT_NEAR(SolveCeresGnc(&mean.problem, options).iterations.front().mu,
              1.0 / (2.0 * 25.0 - 1.0),
              1e-9);
}

TEST(CeresGncMu, KnownBlocksHaveNoSayInTheStart) {
  MeanProblem mean({0.1, 0.1, 0.1, 3.7, 100.0, 1.0});
  CeresGncOptions options = Tight();
  options.known_outliers = {mean.ids[4]};
  options.known_inliers = {mean.ids[3]};
  // The plain fit is 1 with the value at 3.7 and without the value at 100. The
  // candidates at 0.1 are the farthest from it, and within their bounds.
  const auto summary = SolveCeresGnc(&mean.problem, options);
  EXPECT_EQ(summary.termination, GncTermination::kAllInliers);
  EXPECT_NEAR(mean.x, 1.0, 1e-7);
}

TEST(CeresGncMu, MovesByItsStep) {
  CeresGncOptions options = NeverConverging();
  options.gnc.max_num_iterations = 4;
  options.gnc.mu_step = 1.5;
  MeanProblem up({0.0, 0.1, 0.3, 40.0});
  const auto tls = SolveCeresGnc(&up.problem, options);
  ASSERT_EQ(tls.iterations.size(), 4u);
  options.surrogate = SurrogateType::kWelsch;
  MeanProblem down({0.0, 0.1, 0.3, 40.0});
  const auto welsch = SolveCeresGnc(&down.problem, options);
  ASSERT_EQ(welsch.iterations.size(), 4u);
  for (std::size_t i = 1; i < 4; ++i) {
    EXPECT_DOUBLE_EQ(tls.iterations[i].mu, 1.5 * tls.iterations[i - 1].mu);
    EXPECT_DOUBLE_EQ(welsch.iterations[i].mu,
                     welsch.iterations[i - 1].mu / 1.5);
  }
}

// Each stopping criterion alone

TEST(CeresGncStop, OnceWeightsAreBinary) {
  CeresGncOptions options = NeverConverging();
  options.gnc.binary_weight_tolerance = 1e-9;
  MeanProblem mean({0.0, 0.0, 0.1, 4.0});
  const auto summary = SolveCeresGnc(&mean.problem, options);
  EXPECT_EQ(summary.termination, GncTermination::kConverged);
  EXPECT_EQ(summary.message, "the weights were binary");
  EXPECT_EQ(summary.blocks.at(mean.ids[0]).weight, 1.0);
  EXPECT_EQ(summary.blocks.at(mean.ids[3]).weight, 0.0);
}

TEST(CeresGncStop, OnceTheCostSettles) {
  CeresGncOptions options = NeverConverging();
  options.gnc.relative_cost_tolerance = 1e9;  // Compares two costs.
  MeanProblem mean({0.0, 0.1, 0.3, 40.0});
  const auto summary = SolveCeresGnc(&mean.problem, options);
  EXPECT_EQ(summary.termination, GncTermination::kConverged);
  EXPECT_EQ(summary.message, "the cost converged");
  EXPECT_EQ(summary.iterations.size(), 2u);
}

TEST(CeresGncStop, CostThatSettlesIsThatOfKnownInliersToo) {
  // A constant cost of 1e6 hides a change of 1.
  MeanProblem mean({0.0, 0.1, 0.3, 40.0});
  double y = 0.0;
  const Id a = mean.problem.AddResidualBlock(MakeOffset(1e3), nullptr, &y);
  const Id b = mean.problem.AddResidualBlock(MakeOffset(-1e3), nullptr, &y);
  CeresGncOptions options = NeverConverging();
  options.known_inliers = {a, b};
  options.gnc.relative_cost_tolerance = 1e-3;
  const auto summary = SolveCeresGnc(&mean.problem, options);
  EXPECT_EQ(summary.message, "the cost converged");
  EXPECT_EQ(summary.iterations.size(), 2u);
  EXPECT_GE(summary.iterations.back().cost, 1e6);
}

TEST(CeresGncStop, WhereTheLossIsExact) {
  CeresGncOptions options = NeverConverging();
  for (const auto surrogate :
       {SurrogateType::kGemanMcClure, SurrogateType::kWelsch}) {
    options.surrogate = surrogate;
    MeanProblem mean({0.0, 0.0, 0.0, 4.0});
    const auto summary = SolveCeresGnc(&mean.problem, options);
    EXPECT_EQ(summary.message, "the loss was exact");
    EXPECT_EQ(summary.iterations.back().mu, 1.0);
    EXPECT_GT(summary.iterations.size(), 5u);
  }
}

TEST(CeresGncStop, UsableWhenIterationsRunOut) {
  CeresGncOptions options = NeverConverging();
  options.gnc.max_num_iterations = 3;
  MeanProblem mean({0.0, 0.1, 0.3, 40.0});
  const auto summary = SolveCeresGnc(&mean.problem, options);
  EXPECT_EQ(summary.termination, GncTermination::kMaxNumIterations);
  EXPECT_TRUE(summary.IsUsable());
  EXPECT_EQ(summary.iterations.size(), 3u);
  EXPECT_EQ(summary.inner.size(), 4u);
}

TEST(CeresGncStop, AtThePlainFitWhereAllAreInliers) {
  MeanProblem mean({1.1, 2.0, 2.9});
  const auto summary = SolveCeresGnc(&mean.problem, Tight());
  EXPECT_EQ(summary.termination, GncTermination::kAllInliers);
  EXPECT_TRUE(summary.iterations.empty());
  EXPECT_EQ(summary.inner.size(), 1u);
  EXPECT_NEAR(mean.x, 2.0, 1e-7);
  for (const Id id : mean.ids) EXPECT_EQ(summary.blocks.at(id).weight, 1.0);
}

// Weights

TEST(CeresGncWeights, BelowBetweenAndAboveTheBounds) {
  // x is constant at zero; r2 is 0.25, 1, 2.25, 9, so mu = 1/17 and the bounds
  // are 1/18 and 18; then mu = 4 and the bounds are 0.8 and 1.25.
  MeanProblem mean({0.5, 1.0, 1.5, 3.0});
  mean.problem.SetParameterBlockConstant(&mean.x);
  CeresGncOptions options = NeverConverging();
  options.gnc.max_num_iterations = 1;
  auto summary = SolveCeresGnc(&mean.problem, options);
  const auto weight = [&](std::size_t i) {
    return summary.blocks.at(mean.ids[i]).weight;
  };
  const double root = std::sqrt(18.0) / 17.0;
  EXPECT_NEAR(weight(0), root / 0.5 - 1.0 / 17.0, 1e-12);
  EXPECT_NEAR(weight(1), root / 1.0 - 1.0 / 17.0, 1e-12);
  EXPECT_NEAR(weight(2), root / 1.5 - 1.0 / 17.0, 1e-12);
  EXPECT_NEAR(weight(3), root / 3.0 - 1.0 / 17.0, 1e-12);

  options.gnc.max_num_iterations = 2;
  options.gnc.mu_step = 17.0 * 4.0;
  summary = SolveCeresGnc(&mean.problem, options);
  EXPECT_EQ(weight(0), 1.0);
  EXPECT_NEAR(weight(1), std::sqrt(20.0) - 4.0, 1e-12);
  EXPECT_EQ(weight(2), 0.0);
  EXPECT_EQ(weight(3), 0.0);
  EXPECT_EQ(mean.x, 0.0);
}

TEST(CeresGncWeights, EachBlockHasTheBoundOfItsDimension) {
  double x = 0.0;
  ceres::Problem problem;
  const Id one = problem.AddResidualBlock(MakeOffset<1>(0.0), nullptr, &x);
  const Id three = problem.AddResidualBlock(MakeOffset<3>(0.0), nullptr, &x);
  const Id six = problem.AddResidualBlock(MakeOffset<6>(0.0), nullptr, &x);
  CeresGncOptions options = Tight();
  options.bound.reset();
  auto summary = SolveCeresGnc(&problem, options);
  EXPECT_NEAR(summary.blocks.at(one).bound, std::sqrt(6.635), 1e-3);
  EXPECT_NEAR(summary.blocks.at(three).bound, std::sqrt(11.345), 1e-3);
  EXPECT_NEAR(summary.blocks.at(six).bound, std::sqrt(16.812), 1e-3);
  options.inlier_probability = 0.9;
  options.bounds = {{six, 7.5}};
  summary = SolveCeresGnc(&problem, options);
  EXPECT_NEAR(summary.blocks.at(three).bound, std::sqrt(6.251), 1e-3);
  EXPECT_EQ(summary.blocks.at(six).bound, 7.5);
}

// |r|^2 = 12 is above the bound of three residuals and below that of six.
TEST(CeresGncWeights, DimensionDecides) {
  double x = 0.0;
  ceres::Problem problem;
  problem.AddParameterBlock(&x, 1);
  problem.SetParameterBlockConstant(&x);
  const Id three = problem.AddResidualBlock(MakeOffset<3>(2.0), nullptr, &x);
  const Id six =
      problem.AddResidualBlock(MakeOffset<6>(std::sqrt(2.0)), nullptr, &x);
  CeresGncOptions options = Tight();
  options.bound.reset();
  const auto summary = SolveCeresGnc(&problem, options);
  ASSERT_TRUE(summary.IsUsable()) << summary.FullReport();
  EXPECT_EQ(summary.blocks.at(three).weight, 0.0);
  EXPECT_EQ(summary.blocks.at(six).weight, 1.0);
  EXPECT_NEAR(summary.blocks.at(three).squared_residual, 12.0 / 11.345, 1e-4);
}

TEST(CeresGncWeights, UnitOfTheResidualsDoesNotMatter) {
  std::vector<double> values = {0.0, 0.1, 0.3, -0.2, 7.0, 9.0, -40.0};
  MeanProblem metres(values);
  const auto expected = SolveCeresGnc(&metres.problem, Tight(1.0));
  for (double& value : values) value *= 1024.0;
  MeanProblem millis(values);
  const auto summary = SolveCeresGnc(&millis.problem, Tight(1024.0));
  EXPECT_NEAR(millis.x, 1024.0 * metres.x, 1e-6);
  EXPECT_EQ(summary.iterations.size(), expected.iterations.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    EXPECT_EQ(summary.blocks.at(millis.ids[i]).weight,
              expected.blocks.at(metres.ids[i]).weight);
  }
}

TEST(CeresGncWeights, OrderOfBlocksDoesNotMatter) {
  std::vector<double> values = {0.0, 0.1, 0.3, -0.2, 7.0, 9.0, -40.0};
  MeanProblem there(values);
  SolveCeresGnc(&there.problem, Tight());
  std::reverse(values.begin(), values.end());
  MeanProblem back(values);
  SolveCeresGnc(&back.problem, Tight());
  EXPECT_NEAR(there.x, back.x, 1e-12);
}

// Known blocks

TEST(CeresGncRoles, KnownOnesKeepTheirWeights) {
  MeanProblem mean({0.0, 0.1, -0.1, 30.0, 0.05, 31.0});
  CeresGncOptions options = Tight();
  options.known_inliers = {mean.ids[3]};
  options.known_outliers = {mean.ids[4]};
  const auto summary = SolveCeresGnc(&mean.problem, options);
  ASSERT_TRUE(summary.IsUsable()) << summary.FullReport();
  EXPECT_EQ(summary.blocks.at(mean.ids[3]).weight, 1.0);
  EXPECT_EQ(summary.blocks.at(mean.ids[3]).role, GncRole::kKnownInlier);
  EXPECT_EQ(summary.blocks.at(mean.ids[4]).weight, 0.0);
  EXPECT_EQ(summary.blocks.at(mean.ids[4]).role, GncRole::kKnownOutlier);
}

TEST(CeresGncRoles, CandidatesLeaveTheRestInliers) {
  MeanProblem mean({0.0, 0.0, 4.0, 30.0});
  CeresGncOptions options = Tight();
  options.candidates = {{mean.ids[3]}};
  const auto summary = SolveCeresGnc(&mean.problem, options);
  EXPECT_EQ(summary.blocks.at(mean.ids[2]).role, GncRole::kKnownInlier);
  EXPECT_EQ(summary.blocks.at(mean.ids[2]).weight, 1.0);
  EXPECT_EQ(summary.blocks.at(mean.ids[3]).weight, 0.0);
  EXPECT_NEAR(mean.x, 4.0 / 3.0, 1e-9);
}

TEST(CeresGncRoles, NoCandidatesIsThePlainSolve) {
  MeanProblem mean({0.0, 0.0, 4.0, 30.0});
  CeresGncOptions options = Tight();
  options.candidates.emplace();
  const auto summary = SolveCeresGnc(&mean.problem, options);
  EXPECT_EQ(summary.termination, GncTermination::kAllInliers);
  EXPECT_NEAR(mean.x, 8.5, 1e-7);
}

// Must never be evaluated.
class Refuses final : public ceres::SizedCostFunction<1, 1> {
 public:
  bool Evaluate(double const* const*, double*, double**) const override {
    return false;
  }
};

TEST(CeresGncRoles, KnownOutliersAreNotEvaluated) {
  MeanProblem mean({0.0, 0.0, 4.0});
  const Id bad = mean.problem.AddResidualBlock(new Refuses, nullptr, &mean.x);
  CeresGncOptions options = Tight();
  options.known_outliers = {bad};
  const auto summary = SolveCeresGnc(&mean.problem, options);
  EXPECT_TRUE(summary.IsUsable()) << summary.FullReport();
  EXPECT_NEAR(mean.x, 0.0, 1e-7);
}

class CeresGncRefuses : public ::testing::Test {
 protected:
  void ExpectRefused(const CeresGncOptions& options, const std::string& why) {
    const auto summary = SolveCeresGnc(&mean_.problem, options);
    EXPECT_EQ(summary.termination, GncTermination::kInvalidOptions);
    EXPECT_FALSE(summary.IsUsable());
    EXPECT_THAT(summary.message, HasSubstr(why));
    EXPECT_THAT(summary.BriefReport(), HasSubstr(why));
    EXPECT_THAT(summary.FullReport(), HasSubstr(why));
    EXPECT_TRUE(summary.inner.empty());
    EXPECT_TRUE(summary.blocks.empty());
    EXPECT_EQ(mean_.x, 0.5);
  }
  CeresGncRefuses() { mean_.x = 0.5; }

  MeanProblem mean_{{0.0, 0.0, 4.0}};
  MeanProblem other_{{0.0, 1.0}};
  CeresGncOptions options_ = Tight();
};

TEST_F(CeresGncRefuses, InlierThatIsAnOutlier) {
  options_.known_inliers = {mean_.ids[0], mean_.ids[1]};
  options_.known_outliers = {mean_.ids[1]};
  ExpectRefused(options_, "known_outliers[0] is already among known_inliers");
}

TEST_F(CeresGncRefuses, CandidateThatIsKnown) {
  options_.known_inliers = {mean_.ids[0]};
  options_.candidates = {{mean_.ids[2], mean_.ids[0]}};
  ExpectRefused(options_, "candidates[1] is already among known_inliers");
}

TEST_F(CeresGncRefuses, BlockNamedTwice) {
  options_.candidates = {{mean_.ids[2], mean_.ids[2]}};
  ExpectRefused(options_, "candidates[1] is already among candidates");
}

TEST_F(CeresGncRefuses, BlockOfAnotherProblem) {
  options_.known_outliers = {other_.ids[0]};
  ExpectRefused(options_, "known_outliers[0] is not a residual block");
}

TEST_F(CeresGncRefuses, BoundWithoutEffect) {
  options_.known_inliers = {mean_.ids[0]};
  options_.bounds = {{mean_.ids[0], 1.0}};
  ExpectRefused(options_, "no candidate");
  options_.bounds = {{other_.ids[0], 1.0}};
  ExpectRefused(options_, "not in the problem");
}

TEST_F(CeresGncRefuses, NumbersOutOfRange) {
  for (const double bound : {0.0, -1.0, kNan, HUGE_VAL}) {
    options_.bound = bound;
    ExpectRefused(options_, "bound = ");
  }
  options_ = Tight();
  options_.bounds = {{mean_.ids[0], -1.0}};
  ExpectRefused(options_, "bounds contains -1");
  options_ = Tight();
  for (const double probability : {0.0, 1.0, kNan}) {
    options_.inlier_probability = probability;
    ExpectRefused(options_, "inlier_probability = ");
  }
  options_ = Tight();
  for (const double step : {1.0, kNan, HUGE_VAL}) {
    options_.gnc.mu_step = step;
    ExpectRefused(options_, "mu_step = ");
  }
  options_ = Tight();
  options_.solver.max_num_iterations = -1;
  ExpectRefused(options_, "max_num_iterations");
}

TEST_F(CeresGncRefuses, LossThatNeverReachesTheBound) {
  // Tukey's loss saturates at a^2 / 3.
  mean_.problem.AddResidualBlock(
      MakeOffset(0.0), new ceres::TukeyLoss(1.0), &mean_.x);
  ExpectRefused(options_, "never reaches its bound");
}

// Losses of blocks

TEST(CeresGncLosses, ScaleIsPartOfTheResidual) {
  // The loss halves each residual in effect, so 4 is within a bound of 2.
  MeanProblem scaled(
      {0.0, 4.0}, new ceres::ScaledLoss(nullptr, 0.25, ceres::TAKE_OWNERSHIP));
  scaled.problem.SetParameterBlockConstant(&scaled.x);
  auto summary = SolveCeresGnc(&scaled.problem, Tight(2.01));
  EXPECT_EQ(summary.blocks.at(scaled.ids[1]).weight, 1.0);
  EXPECT_NEAR(summary.blocks.at(scaled.ids[1]).squared_residual,
              4.0 / (2.01 * 2.01),
              1e-12);
  summary = SolveCeresGnc(&scaled.problem, Tight(1.99));
  EXPECT_EQ(summary.blocks.at(scaled.ids[1]).weight, 0.0);
}

TEST(CeresGncLosses, WeightsMultiplyThem) {
  const auto huber = [] { return new ceres::HuberLoss(0.1); };
  MeanProblem all({0.0, 0.2, 0.9, 50.0}, huber());
  const auto summary = SolveCeresGnc(&all.problem, Tight());
  ASSERT_TRUE(summary.IsUsable()) << summary.FullReport();
  EXPECT_EQ(summary.blocks.at(all.ids[3]).weight, 0.0);
  MeanProblem inliers({0.0, 0.2, 0.9}, huber());
  ceres::Solver::Summary plain;
  ceres::Solve(Tight().solver, &inliers.problem, &plain);
  EXPECT_NEAR(all.x, inliers.x, 1e-7);
  EXPECT_GT(std::abs(all.x - 1.1 / 3.0), 0.05);  // Not the mean.
  EXPECT_NEAR(
      2.0 * summary.iterations.back().cost, 2.0 * plain.final_cost, 1e-9);
}

// The caller's problem

// Huber's loss; counts its deletions by Ceres.
class CountedHuber final : public ceres::LossFunction {
 public:
  explicit CountedHuber(int* num_deleted) : num_deleted_(num_deleted) {}
  ~CountedHuber() override { ++*num_deleted_; }
  void Evaluate(double s, double* rho) const override {
    huber_.Evaluate(s, rho);
  }

 private:
  ceres::HuberLoss huber_{2.0};
  int* num_deleted_;
};

// Keeps the second of two parameters constant and counts its deletions.
class CountedSubset final : public ceres::Manifold {
 public:
  explicit CountedSubset(int* num_deleted) : num_deleted_(num_deleted) {}
  ~CountedSubset() override { ++*num_deleted_; }
  int AmbientSize() const override { return subset_.AmbientSize(); }
  int TangentSize() const override { return subset_.TangentSize(); }
  bool Plus(const double* x, const double* delta, double* y) const override {
    return subset_.Plus(x, delta, y);
  }
  bool PlusJacobian(const double* x, double* jacobian) const override {
    return subset_.PlusJacobian(x, jacobian);
  }
  bool Minus(const double* y, const double* x, double* delta) const override {
    return subset_.Minus(y, x, delta);
  }
  bool MinusJacobian(const double* x, double* jacobian) const override {
    return subset_.MinusJacobian(x, jacobian);
  }

 private:
  ceres::SubsetManifold subset_{2, {1}};
  int* num_deleted_;
};

struct TwoNumbers {
  template <typename T>
  bool operator()(const T* x, const T* y, T* residual) const {
    residual[0] = x[0] + y[0] - a;
    residual[1] = x[1] - y[0] - b;
    return true;
  }
  double a, b;
};

class CallersProblem : public ::testing::Test {
 protected:
  void SetUp() override {
    problem_ = std::make_unique<ceres::Problem>();
    problem_->AddParameterBlock(x_, 2);
    problem_->AddParameterBlock(y_, 1);
    manifold_ = new CountedSubset(&num_manifolds_deleted_);
    problem_->SetManifold(x_, manifold_);
    problem_->SetParameterLowerBound(x_, 0, -0.25);
    problem_->SetParameterUpperBound(x_, 0, 0.5);
    problem_->SetParameterBlockConstant(y_);
    for (int i = 0; i < 10; ++i) {
      losses_.push_back(i % 2 == 0 ? nullptr
                                   : new CountedHuber(&num_losses_deleted_));
      ids_.push_back(problem_->AddResidualBlock(
          new ceres::AutoDiffCostFunction<TwoNumbers, 2, 2, 1>(
              new TwoNumbers{i < 7 ? 0.3 + 0.01 * i : 20.0, 1.0}),
          losses_.back(),
          x_,
          y_));
    }
  }

  void ExpectUntouched() const {
    EXPECT_EQ(problem_->NumResidualBlocks(), 10);
    EXPECT_EQ(problem_->NumParameterBlocks(), 2);
    for (std::size_t i = 0; i < ids_.size(); ++i) {
      EXPECT_EQ(problem_->GetLossFunctionForResidualBlock(ids_[i]), losses_[i]);
    }
    EXPECT_EQ(problem_->GetManifold(x_), manifold_);
    EXPECT_TRUE(problem_->IsParameterBlockConstant(y_));
    EXPECT_FALSE(problem_->IsParameterBlockConstant(x_));
    EXPECT_EQ(problem_->GetParameterLowerBound(x_, 0), -0.25);
    EXPECT_EQ(problem_->GetParameterUpperBound(x_, 0), 0.5);
    EXPECT_EQ(num_losses_deleted_, 0);
    EXPECT_EQ(num_manifolds_deleted_, 0);
  }

  double x_[2] = {0.0, 1.0};
  double y_[1] = {0.125};
  ceres::Manifold* manifold_ = nullptr;
  std::vector<ceres::LossFunction*> losses_;
  std::vector<Id> ids_;
  int num_losses_deleted_ = 0;
  int num_manifolds_deleted_ = 0;
  std::unique_ptr<ceres::Problem> problem_;
};

TEST_F(CallersProblem, IsAsItWas) {
  const auto summary = SolveCeresGnc(problem_.get(), Tight());
  ASSERT_TRUE(summary.IsUsable()) << summary.FullReport();
  ExpectUntouched();
  // A constant block, a coordinate fixed by its manifold, and bounds.
  EXPECT_EQ(y_[0], 0.125);
  EXPECT_EQ(x_[1], 1.0);
  EXPECT_NEAR(x_[0], 0.33 - 0.125, 1e-7);
  EXPECT_EQ(summary.blocks.at(ids_[9]).weight, 0.0);

  // The problem solves as before, outliers included.
  ceres::Solver::Summary plain;
  ceres::Solve(Tight().solver, problem_.get(), &plain);
  EXPECT_NEAR(x_[0], 0.5, 1e-7);
  problem_.reset();
  EXPECT_EQ(num_losses_deleted_, 5);
  EXPECT_EQ(num_manifolds_deleted_, 1);
}

TEST_F(CallersProblem, ParametersStayWithinTheirBounds) {
  for (const double end : {0.1, 0.3}) {  // The solution is 0.205.
    problem_->SetParameterLowerBound(x_, 0, end < 0.2 ? -0.25 : end);
    problem_->SetParameterUpperBound(x_, 0, end < 0.2 ? end : 0.5);
    x_[0] = end;
    const auto summary = SolveCeresGnc(problem_.get(), Tight());
    ASSERT_TRUE(summary.IsUsable()) << summary.FullReport();
    EXPECT_EQ(x_[0], end);
  }
}

TEST_F(CallersProblem, IsAsItWasAfterTwoCalls) {
  const auto first = SolveCeresGnc(problem_.get(), Tight());
  x_[0] = 0.0;
  const auto second = SolveCeresGnc(problem_.get(), Tight());
  ExpectUntouched();
  ASSERT_EQ(first.iterations.size(), second.iterations.size());
  for (std::size_t i = 0; i < first.iterations.size(); ++i) {
    EXPECT_EQ(first.iterations[i].mu, second.iterations[i].mu);
    EXPECT_EQ(first.iterations[i].cost, second.iterations[i].cost);
  }
}

// Makes the n-th inner solve fail.
class AbortIn final : public ceres::IterationCallback {
 public:
  explicit AbortIn(int num_solves) : left_(num_solves) {}
  ceres::CallbackReturnType operator()(
      const ceres::IterationSummary& step) override {
    if (step.iteration == 0) --left_;
    return left_ < 0 ? ceres::SOLVER_ABORT : ceres::SOLVER_CONTINUE;
  }

 private:
  int left_;
};

TEST_F(CallersProblem, IsAsItWasWhereASolveFails) {
  for (const int num_solves : {0, 3}) {
    x_[0] = -0.2;
    AbortIn abort(num_solves);
    CeresGncOptions options = Tight();
    options.solver.callbacks.push_back(&abort);
    const auto summary = SolveCeresGnc(problem_.get(), options);
    EXPECT_EQ(summary.termination, GncTermination::kUndetermined);
    EXPECT_FALSE(summary.IsUsable());
    EXPECT_THAT(summary.message,
                HasSubstr("inner solve " + std::to_string(num_solves)));
    EXPECT_THAT(summary.FullReport(), HasSubstr("GNC failed"));
    EXPECT_EQ(summary.inner.size(), static_cast<std::size_t>(num_solves) + 1);
    ExpectUntouched();
    EXPECT_EQ(x_[0], -0.2);
    EXPECT_EQ(y_[0], 0.125);
  }
}

TEST_F(CallersProblem, SolverOptionsKeepTheirOrdering) {
  // Ceres removes constant blocks from the ordering it gets.
  CeresGncOptions options = Tight();
  options.solver.linear_solver_type = ceres::DENSE_SCHUR;
  options.solver.linear_solver_ordering =
      std::make_shared<ceres::ParameterBlockOrdering>();
  options.solver.linear_solver_ordering->AddElementToGroup(x_, 0);
  options.solver.linear_solver_ordering->AddElementToGroup(y_, 1);
  const auto summary = SolveCeresGnc(problem_.get(), options);
  EXPECT_TRUE(summary.IsUsable()) << summary.FullReport();
  EXPECT_EQ(options.solver.linear_solver_ordering->NumElements(), 2);
}

TEST(CeresGncValues, AreThoseOfThePlainSolveBitForBit) {
  std::vector<double> values;
  for (int i = 0; i < 50; ++i) values.push_back(std::sin(i));
  MeanProblem plain(values, new ceres::CauchyLoss(1.0));
  MeanProblem gnc(values, new ceres::CauchyLoss(1.0));
  ceres::Solver::Options options;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary ignored;
  ceres::Solve(options, &plain.problem, &ignored);
  CeresGncOptions wide = Tight(10.0);
  wide.solver = options;
  SolveCeresGnc(&gnc.problem, wide);
  EXPECT_EQ(plain.x, gnc.x);
  EXPECT_NE(plain.x, 0.0);
}

TEST(CeresGncValues, GoOnFromTheLastSolve) {
  // Each inner solve starts at the result of the previous one, not at x = 1e3.
  MeanProblem mean({0.0, 0.1, -0.1, 30.0});
  mean.x = 1e3;
  const auto summary = SolveCeresGnc(&mean.problem, Tight());
  ASSERT_GT(summary.inner.size(), 3u);
  EXPECT_GT(summary.inner[0].initial_cost, 1e6);
  for (std::size_t i = 1; i < summary.inner.size(); ++i) {
    EXPECT_LT(summary.inner[i].initial_cost, 1e3) << i;
  }
}

TEST(CeresGncValues, AreRestoredWhereAllWeightIsTakenAway) {
  MeanProblem mean({-10.0, 10.0});
  mean.x = 3.0;
  const auto summary = SolveCeresGnc(&mean.problem, Tight());
  EXPECT_EQ(summary.termination, GncTermination::kUndetermined);
  EXPECT_THAT(summary.message, HasSubstr("all candidates were rejected"));
  EXPECT_EQ(mean.x, 3.0);
}

TEST(CeresGncValues, AreRestoredWhereAResidualIsNotFinite) {
  for (const auto start : {GncStart::kPlainFit, GncStart::kIdentity}) {
    MeanProblem mean({0.0, kNan, 1.0});
    mean.x = 3.0;
    CeresGncOptions options = Tight();
    options.gnc.start = start;
    const auto summary = SolveCeresGnc(&mean.problem, options);
    EXPECT_FALSE(summary.IsUsable());
    EXPECT_FALSE(summary.message.empty());
    EXPECT_EQ(mean.x, 3.0);
  }
}

TEST(CeresGncValues, OfAnEmptyProblemAreNoAnswer) {
  ceres::Problem problem;
  const auto summary = SolveCeresGnc(&problem, Tight());
  EXPECT_FALSE(summary.IsUsable());
  EXPECT_THAT(summary.message, HasSubstr("no residual block"));
}

// The callback computes the residual.
class Halve final : public ceres::EvaluationCallback {
 public:
  explicit Halve(const double* x) : x_(x) {}
  void PrepareForEvaluation(bool, bool new_point) override {
    if (new_point) half = *x_ / 2.0;
  }
  double half = kNan;

 private:
  const double* x_;
};

class HalfMinus final : public ceres::SizedCostFunction<1, 1> {
 public:
  HalfMinus(const Halve* halve, double value) : halve_(halve), value_(value) {}
  bool Evaluate(double const* const*,
                double* residuals,
                double** jacobians) const override {
    residuals[0] = halve_->half - value_;
    if (jacobians != nullptr && jacobians[0] != nullptr) jacobians[0][0] = 0.5;
    return true;
  }

 private:
  const Halve* halve_;
  double value_;
};

TEST(CeresGncValues, CanComeByAnEvaluationCallback) {
  double x = 5.0;
  Halve halve(&x);
  ceres::Problem::Options shared;
  shared.evaluation_callback = &halve;
  ceres::Problem problem(shared);
  for (const double value : {1.0, 1.1, 0.9, 20.0}) {
    problem.AddResidualBlock(new HalfMinus(&halve, value), nullptr, &x);
  }
  CeresGncOptions options = Tight();
  options.evaluation_callback = &halve;
  options.gnc.start = GncStart::kIdentity;
  const auto summary = SolveCeresGnc(&problem, options);
  ASSERT_TRUE(summary.IsUsable()) << summary.FullReport();
  EXPECT_NEAR(x, 2.0, 1e-9);
}

// Problems whose plain solve fails

struct LineResidual {
  template <typename T>
  bool operator()(const T* line, T* residual) const {
    residual[0] = y - (line[0] * x + line[1]);
    return true;
  }
  double x, y;
};

// 300 points, 90 of them within 0.05 of a line, the others at random.
struct LineProblem {
  explicit LineProblem(std::uint64_t seed, double huber = 0.0) {
    Random random(seed);
    for (int i = 0; i < 300; ++i) {
      const double x = 10.0 * random.Uniform();
      const double y = i < 90 ? 0.5 * x + 1.0 + 0.05 * SignedUniform(&random)
                              : 20.0 * random.Uniform();
      ids.push_back(problem.AddResidualBlock(
          new ceres::AutoDiffCostFunction<LineResidual, 1, 2>(
              new LineResidual{x, y}),
          huber > 0.0 ? new ceres::HuberLoss(huber) : nullptr,
          line));
    }
  }

  void SolvePlain() {
    ceres::Solver::Summary ignored;
    ceres::Solve(Tight().solver, &problem, &ignored);
  }

  // The larger error at the two ends of the line.
  double Error() const {
    return std::max(std::abs(line[1] - 1.0),
                    std::abs(10.0 * line[0] + line[1] - 6.0));
  }

  double line[2] = {0.0, 0.0};
  std::vector<Id> ids;
  ceres::Problem problem;
};

TEST(CeresGncTest, FindsTheLineThatThePlainSolveAndHuberMiss) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    LineProblem plain(seed);
    plain.SolvePlain();
    EXPECT_GT(plain.Error(), 1.0) << "seed " << seed;
    LineProblem huber(seed, 0.1);
    huber.SolvePlain();
    EXPECT_GT(huber.Error(), 0.5) << "seed " << seed;

    // With mu_step = 1.4 truncated least squares is too greedy here.
    CeresGncOptions options = Tight(0.1);
    options.gnc.mu_step = 1.1;
    options.gnc.max_num_iterations = 300;
    for (const auto surrogate : {SurrogateType::kTruncatedLeastSquares,
                                 SurrogateType::kGemanMcClure,
                                 SurrogateType::kWelsch}) {
      options.surrogate = surrogate;
      LineProblem gnc(seed);
      const auto summary = SolveCeresGnc(&gnc.problem, options);
      ASSERT_TRUE(summary.IsUsable()) << summary.FullReport();
      EXPECT_LT(gnc.Error(), 0.1) << "seed " << seed;
      for (std::size_t i = 0; i < 90; ++i) {
        EXPECT_LE(summary.blocks.at(gnc.ids[i]).squared_residual, 1.0)
            << "seed " << seed;
      }
    }
  }
}

// Reports

TEST(CeresGncReport, SaysWhyItStoppedAndWhatItCost) {
  MeanProblem mean({0.0, 0.0, 0.1, 40.0});
  const auto summary = SolveCeresGnc(&mean.problem, Tight());
  EXPECT_THAT(summary.BriefReport(), HasSubstr(summary.message));
  EXPECT_THAT(summary.BriefReport(), HasSubstr("3 of 4 candidates"));
  EXPECT_EQ(summary.BriefReport().find('\n'), std::string::npos);
  const std::string full = summary.FullReport();
  EXPECT_EQ(
      static_cast<std::size_t>(std::count(full.begin(), full.end(), '\n')),
      summary.iterations.size() + 4);
  EXPECT_GT(summary.total_seconds, 0.0);
  EXPECT_LE(summary.solver_seconds, summary.total_seconds);
}

TEST(CeresGncReport, OfAFailedSolveIsOneLineAndHasTheBlocks) {
  MeanProblem mean({0.0, 1.0, 2.0});
  mean.x = kNan;
  const auto summary = SolveCeresGnc(&mean.problem, Tight());
  EXPECT_FALSE(summary.IsUsable());
  ASSERT_EQ(summary.inner.size(), 1u);
  EXPECT_THAT(summary.inner[0].message, HasSubstr("\n"));
  EXPECT_THAT(summary.BriefReport(), HasSubstr("inner solve 0 failed: "));
  EXPECT_EQ(summary.BriefReport().find('\n'), std::string::npos);
  EXPECT_EQ(summary.blocks.size(), 3u);
}

TEST(CeresGncReport, OfNothingDoneSaysSo) {
  EXPECT_THAT(CeresGncSummary().FullReport(), HasSubstr("was not called"));
}

}  // namespace
}  // namespace quatro::ceres_gnc_test
