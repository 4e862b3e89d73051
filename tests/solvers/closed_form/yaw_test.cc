// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "solvers/closed_form/yaw.h"

#include <ceres/ceres.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "solvers/ceres/manifolds.h"
#include "tests/support/matchers.h"

namespace quatro::yaw_test {
namespace {

constexpr double kTolerance = 1e-12;

Eigen::Matrix3d RotationZ(double angle) {
  return Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

// Fifty noisy pairs of random weight. No test requires a clean fit.
class YawTest : public ::testing::Test {
 protected:
  static constexpr int kNumPairs = 50;
  static constexpr double kYaw = 0.7;    // [rad]
  static constexpr double kNoise = 0.3;  // [m], a deliberately poor fit.

  Points RandomPoints(double sigma) {
    std::normal_distribution<double> normal(0.0, sigma);
    return Points::NullaryExpr(3, kNumPairs, [&] { return normal(rng_); });
  }

  std::mt19937 rng_{20220523};
  const Points source_ = RandomPoints(10.0);
  const Points target_ = RotationZ(kYaw) * source_ + RandomPoints(kNoise);
  const Weights weights_ = RandomPoints(1.0).row(0).cwiseAbs().transpose();
};

TEST_F(YawTest, RecoversExactYawOnTheWholeCircle) {
  for (const double yaw : {0.0, 1e-9, 0.5, 1.6, 3.1, M_PI, -M_PI, -2.0}) {
    const auto estimate =
        EstimateYaw(source_, RotationZ(yaw) * source_, weights_);
    ASSERT_TRUE(estimate.has_value());
    EXPECT_THAT(estimate->target_from_source, IsAngleNear(yaw, kTolerance));
    EXPECT_NEAR(estimate->cost, 0.0, kTolerance);
  }
}

TEST_F(YawTest, TurningTheTargetAddsToTheYaw) {
  const auto base = EstimateYaw(source_, target_, weights_);
  const auto turned = EstimateYaw(source_, RotationZ(2.9) * target_, weights_);
  EXPECT_THAT(turned->target_from_source,
              IsAngleNear(base->target_from_source + 2.9, kTolerance));
  EXPECT_NEAR(turned->cost, base->cost, 1e-9 * base->cost);
}

TEST_F(YawTest, SwappingSourceAndTargetInvertsTheYaw) {
  const auto forward = EstimateYaw(source_, target_, weights_);
  const auto backward = EstimateYaw(target_, source_, weights_);
  EXPECT_THAT(backward->target_from_source,
              IsAngleNear(-forward->target_from_source, kTolerance));
}

TEST_F(YawTest, HeightDoesNotMatter) {
  Points raised = source_;
  raised.row(2).setConstant(1e6);
  EXPECT_EQ(EstimateYaw(raised, target_, weights_)->target_from_source,
            EstimateYaw(source_, target_, weights_)->target_from_source);
}

TEST_F(YawTest, ZeroWeightIsTheSameAsLeavingThePairOut) {
  const int kKept = 20;
  Weights masked = weights_;
  masked.tail(kNumPairs - kKept).setZero();
  EXPECT_THAT(EstimateYaw(source_, target_, masked)->target_from_source,
              IsAngleNear(EstimateYaw(source_.leftCols(kKept),
                                      target_.leftCols(kKept),
                                      weights_.head(kKept))
                              ->target_from_source,
                          kTolerance));
}

TEST_F(YawTest, DoesNotAnswerWhenThePairsHoldNoYaw) {
  EXPECT_FALSE(EstimateYaw(Points(3, 0), Points(3, 0), Weights(0)));
  EXPECT_FALSE(EstimateYaw(source_, target_, Weights::Zero(kNumPairs)));

  Points vertical = source_;
  vertical.topRows<2>().setZero();
  EXPECT_FALSE(EstimateYaw(vertical, target_, weights_));
}

// An independent implementation of (1) for Ceres to differentiate.
struct WeightedPairResidual {
  template <typename T>
  bool operator()(const T* direction, T* residual) const {
    for (int row = 0; row < 2; ++row) {
      const T x = row == 0 ? direction[0] : direction[1];
      const T y = row == 0 ? -direction[1] : direction[0];
      residual[row] =
          sqrt_weight * (target[row] - (x * source[0] + y * source[1]));
    }
    return true;
  }

  Eigen::Vector2d source;
  Eigen::Vector2d target;
  double sqrt_weight;
};

TEST_F(YawTest, AgreesWithCeresOnTheUnitCircle) {
  const auto closed_form = EstimateYaw(source_, target_, weights_);

  double direction[2] = {1.0, 0.0};
  ceres::Problem problem;
  problem.AddParameterBlock(direction, 2, new UnitCircleManifold);
  for (int i = 0; i < kNumPairs; ++i) {
    problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<WeightedPairResidual, 2, 2>(
            new WeightedPairResidual{source_.col(i).head<2>(),
                                     target_.col(i).head<2>(),
                                     std::sqrt(weights_[i])}),
        nullptr,
        direction);
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.function_tolerance = 1e-16;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);

  ASSERT_TRUE(summary.IsSolutionUsable()) << summary.FullReport();
  EXPECT_THAT(closed_form->target_from_source,
              IsAngleNear(std::atan2(direction[1], direction[0]), 1e-8))
      << summary.FullReport();
  // Ceres halves the sum of squares.
  EXPECT_NEAR(
      closed_form->cost, 2.0 * summary.final_cost, 1e-9 * closed_form->cost);

  // The curvature is Ceres' Gauss-Newton Hessian plus the second derivative of
  // the residuals. If the fit is poor, only a finite difference of (1) includes
  // both.
  const auto cost_at = [&](double angle) {
    const Eigen::Matrix2Xd error =
        target_.topRows<2>() -
        Eigen::Rotation2Dd(angle).toRotationMatrix() * source_.topRows<2>();
    return error.colwise().squaredNorm().dot(weights_);
  };
  const double a = closed_form->target_from_source;
  const double h = 1e-4;
  const double numeric_curvature =
      (cost_at(a + h) - 2.0 * cost_at(a) + cost_at(a - h)) / (h * h);
  EXPECT_NEAR(
      closed_form->curvature, numeric_curvature, 1e-5 * numeric_curvature);
}

}  // namespace
}  // namespace quatro::yaw_test
