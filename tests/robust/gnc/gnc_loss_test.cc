// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/gnc/gnc_loss.h"

#include <ceres/ceres.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace quatro {
namespace {

template <typename Surrogate>
class GncLossTest : public ::testing::Test {};
using Surrogates =
    ::testing::Types<TruncatedLeastSquares, GemanMcClure, Welsch>;
TYPED_TEST_SUITE(GncLossTest, Surrogates);

// Both derivatives against finite differences, as Ceres tests its losses.
TYPED_TEST(GncLossTest, DerivativesAreThoseOfTheLoss) {
  constexpr double kStep = 1e-5;
  for (const double mu : {0.05, 1.0, 9.0}) {
    const GncLoss<TypeParam> loss(0.7, &mu);
    for (const double s : {0.1, 0.3, 0.47, 0.6, 1.4, 30.0}) {
      double rho[3], next[3], last[3];
      loss.Evaluate(s, rho);
      loss.Evaluate(s + kStep, next);
      loss.Evaluate(s - kStep, last);
      EXPECT_NEAR(rho[1], (next[0] - last[0]) / (2.0 * kStep), 1e-7)
          << "s " << s << ", mu " << mu;
      EXPECT_NEAR(rho[2], (next[1] - last[1]) / (2.0 * kStep), 1e-7)
          << "s " << s << ", mu " << mu;
    }
  }
}

TYPED_TEST(GncLossTest, StartsAsTheSquare) {
  const double mu = 3.0;
  double rho[3];
  GncLoss<TypeParam>(0.7, &mu).Evaluate(0.0, rho);
  EXPECT_EQ(rho[0], 0.0);
  EXPECT_EQ(rho[1], 1.0);
}

TEST(GncLossBound, IsTheResidualAndNotItsSquare) {
  const double mu = 1e9;
  const GncLoss<TruncatedLeastSquares> loss(3.0, &mu);
  double rho[3];
  loss.Evaluate(8.9, rho);  // |r| = 2.98
  EXPECT_NEAR(rho[0], 8.9, 1e-6);
  EXPECT_EQ(rho[1], 1.0);
  loss.Evaluate(9.1, rho);
  EXPECT_NEAR(rho[0], 9.0, 1e-6);
  EXPECT_EQ(rho[1], 0.0);
}

// Thirteen values near zero and seven near ten. The mean is 3.5, and the exact
// loss has a minimum at each cluster.
struct OffsetFrom {
  template <typename T>
  bool operator()(const T* x, T* residual) const {
    residual[0] = x[0] - value;
    return true;
  }
  double value;
};

void AddTwoHeaps(ceres::LossFunction* loss,
                 double* x,
                 ceres::Problem* problem) {
  for (int i = 0; i < 20; ++i) {
    const double value = i < 13 ? 0.1 * (i - 6) : 10.0 + 0.05 * (i - 16);
    problem->AddResidualBlock(new ceres::AutoDiffCostFunction<OffsetFrom, 1, 1>(
                                  new OffsetFrom{value}),
                              loss,
                              x);
  }
}

// Lowers mu after every step that Ceres takes, in one solve.
template <typename Surrogate>
class LowerMu final : public ceres::IterationCallback {
 public:
  explicit LowerMu(double* mu) : mu_(mu) {}

  ceres::CallbackReturnType operator()(
      const ceres::IterationSummary& step) override {
    if (step.step_is_successful) *mu_ = Surrogate::NextMu(*mu_, 1.4);
    return ceres::SOLVER_CONTINUE;
  }

 private:
  double* mu_;
};

// Solves from x = 11.
template <typename Surrogate>
double SolveWithCallback(double mu, bool lower_mu) {
  double x = 11.0;
  ceres::Problem problem;
  AddTwoHeaps(new GncLoss<Surrogate>(1.0, &mu), &x, &problem);
  LowerMu<Surrogate> callback(&mu);
  ceres::Solver::Options options;
  options.max_num_iterations = 200;
  options.logging_type = ceres::SILENT;
  if (lower_mu) options.callbacks.push_back(&callback);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  EXPECT_TRUE(summary.IsSolutionUsable()) << summary.FullReport();
  if (lower_mu) {
    EXPECT_EQ(mu, 1.0);
  }
  return x;
}

TEST(GncLossInACallback, FindsTheLargerHeapWhereTheLossAloneDoesNot) {
  const double start =
      GemanMcClure::InitialMu(11.6 * 11.6, GncStart::kIdentity);
  EXPECT_NEAR(SolveWithCallback<GemanMcClure>(start, true), 0.0, 0.05);
  EXPECT_NEAR(SolveWithCallback<GemanMcClure>(1.0, false), 10.0, 0.5);
  EXPECT_NEAR(SolveWithCallback<Welsch>(start, true), 0.0, 0.05);
  EXPECT_NEAR(SolveWithCallback<Welsch>(1.0, false), 10.0, 0.5);
}

TEST(GncLossInALoop, TruncatedLeastSquaresTakesASolvePerMu) {
  double x = 3.5;  // The plain fit.
  double mu =
      TruncatedLeastSquares::InitialMu(6.65 * 6.65, GncStart::kPlainFit);
  ceres::Problem problem;
  AddTwoHeaps(new GncLoss<TruncatedLeastSquares>(1.0, &mu), &x, &problem);
  ceres::Solver::Options options;
  options.logging_type = ceres::SILENT;
  for (; mu < 1e3; mu = TruncatedLeastSquares::NextMu(mu, 1.4)) {
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
  }
  EXPECT_NEAR(x, 0.0, 0.01);
}

}  // namespace
}  // namespace quatro
