// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "solvers/closed_form/yaw_translation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <limits>

#include "features/base/rigid3.h"
#include "tests/support/matchers.h"
#include "tests/support/random_problems.h"

namespace quatro::yaw_translation_test {
namespace {

constexpr double kTolerance = 1e-12;

Weights RandomWeights(Eigen::Index n, std::uint64_t seed) {
  Random random(seed);
  return Weights::NullaryExpr(n, [&] { return random.Uniform(); });
}

double CostAt(const Rigid3& motion,
              const Points& source,
              const Points& target,
              const Weights& weights) {
  return (target - motion.Apply(source))
      .colwise()
      .squaredNorm()
      .dot(weights.transpose());
}

// Forty noisy points far from the origin. No test requires a clean fit.
class YawTranslationTest : public ::testing::Test {
 protected:
  static constexpr Eigen::Index kNumPoints = 40;

  const Rigid3 true_motion_{RotationZ(2.2), {30.0, -20.0, 5.0}};
  const Points source_ = RandomPoints(kNumPoints, 10.0, 1).colwise() +
                         Eigen::Vector3d(50.0, 60.0, 70.0);
  const Points target_ =
      true_motion_.Apply(source_) + RandomPoints(kNumPoints, 0.5, 2);
  const Weights weights_ = RandomWeights(kNumPoints, 3);
};

TEST_F(YawTranslationTest, RecoversExactMotionsOnTheWholeCircle) {
  for (const double yaw : {0.0, 1e-9, 0.5, 1.6, 3.1, M_PI, -M_PI, -2.0}) {
    const Rigid3 motion{RotationZ(yaw), {-3.0, 40.0, -8.0}};
    const auto estimate =
        EstimateYawTranslation(source_, motion.Apply(source_), weights_);
    ASSERT_TRUE(estimate.has_value());
    EXPECT_THAT(estimate->yaw, IsAngleNear(yaw, kTolerance));
    EXPECT_LT(
        (estimate->target_from_source.translation - motion.translation).norm(),
        1e-11);
    EXPECT_LT(estimate->cost, 1e-20);
  }
}

TEST_F(YawTranslationTest, IsALeastCost) {
  const auto estimate = EstimateYawTranslation(source_, target_, weights_);
  const Rigid3& best = estimate->target_from_source;
  EXPECT_EQ(best.rotation, RotationZ(estimate->yaw));
  EXPECT_NEAR(estimate->cost,
              CostAt(best, source_, target_, weights_),
              1e-10 * estimate->cost);
  const Eigen::Vector3d pivot = source_.rowwise().mean();
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    Random random(seed);
    const double size = std::pow(10.0, -4.0 * random.Uniform());
    const double angle = size * (2.0 * random.Uniform() - 1.0);
    Rigid3 other{RotationZ(estimate->yaw + angle), {}};
    other.translation = best * pivot - other.rotation * pivot +
                        size * RandomDirection(seed + 1000);
    EXPECT_GT(CostAt(other, source_, target_, weights_), estimate->cost);
  }
}

TEST_F(YawTranslationTest, CurvatureIsTheSecondDifferenceOfTheCost) {
  const auto estimate = EstimateYawTranslation(source_, target_, weights_);
  const Rigid3& best = estimate->target_from_source;
  const Eigen::Vector3d pivot = source_ * weights_ / weights_.sum();
  const auto cost_at = [&](const Eigen::Vector4d& x) {
    Rigid3 moved{RotationZ(estimate->yaw + x[0]), {}};
    moved.translation = best * pivot - moved.rotation * pivot + x.tail<3>();
    return CostAt(moved, source_, target_, weights_);
  };
  const double h = 1e-3;
  Eigen::Matrix4d numeric;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      const Eigen::Vector4d a = h * Eigen::Vector4d::Unit(i);
      const Eigen::Vector4d b = h * Eigen::Vector4d::Unit(j);
      numeric(i, j) =
          (cost_at(a + b) - cost_at(a - b) - cost_at(b - a) + cost_at(-a - b)) /
          (4.0 * h * h);
    }
  }
  ASSERT_GT(numeric.norm(), 1.0);
  EXPECT_LT((estimate->curvature - numeric).norm(), 1e-5 * numeric.norm());
}

TEST_F(YawTranslationTest, MovingEitherCloudMovesTheAnswer) {
  const auto base = EstimateYawTranslation(source_, target_, weights_);
  const Rigid3 a{RotationZ(0.3), {1.0, 2.0, 3.0}};
  const Rigid3 b{RotationZ(2.9), {-9.0, 8.0, 7.0}};
  const auto moved =
      EstimateYawTranslation(a.Apply(source_), b.Apply(target_), weights_);
  const Rigid3 expected = b * base->target_from_source * Inverse(a);
  EXPECT_THAT(moved->yaw, IsAngleNear(base->yaw + 2.9 - 0.3, kTolerance));
  EXPECT_LT(
      (moved->target_from_source.translation - expected.translation).norm(),
      1e-11);
  EXPECT_NEAR(moved->cost, base->cost, 1e-10 * base->cost);
}

TEST_F(YawTranslationTest, SwappingSourceAndTargetInverts) {
  const auto forward = EstimateYawTranslation(source_, target_, weights_);
  const auto backward = EstimateYawTranslation(target_, source_, weights_);
  EXPECT_THAT(backward->yaw, IsAngleNear(-forward->yaw, kTolerance));
  EXPECT_LT((backward->target_from_source.translation -
             Inverse(forward->target_from_source).translation)
                .norm(),
            1e-11);
  EXPECT_NEAR(backward->cost, forward->cost, 1e-10 * forward->cost);
}

TEST_F(YawTranslationTest, OrderDoesNotMatter) {
  const auto order = RandomPermutation(kNumPoints, 4);
  const auto base = EstimateYawTranslation(source_, target_, weights_);
  const auto permuted = EstimateYawTranslation(
      source_(Eigen::all, order), target_(Eigen::all, order), weights_(order));
  EXPECT_THAT(permuted->yaw, IsAngleNear(base->yaw, kTolerance));
}

TEST_F(YawTranslationTest, ZeroWeightIsTheSameAsLeavingThePointOut) {
  const Eigen::Index kKept = 15;
  Weights masked = weights_;
  masked.tail(kNumPoints - kKept).setZero();
  Points wild = source_;
  wild.rightCols(kNumPoints - kKept).array() *= 1e9;
  const auto all = EstimateYawTranslation(wild, target_, masked);
  const auto kept = EstimateYawTranslation(
      source_.leftCols(kKept), target_.leftCols(kKept), weights_.head(kKept));
  ASSERT_TRUE(all.has_value());
  EXPECT_THAT(all->yaw, IsAngleNear(kept->yaw, kTolerance));
  EXPECT_NEAR(all->cost, kept->cost, kTolerance * kept->cost);
}

TEST_F(YawTranslationTest, HeightMovesTheHeightOnly) {
  const auto base = EstimateYawTranslation(source_, target_, weights_);
  Points raised = target_;
  raised.row(2).array() += 100.0;
  const auto lifted = EstimateYawTranslation(source_, raised, weights_);
  EXPECT_EQ(lifted->yaw, base->yaw);
  EXPECT_LT(
      (lifted->target_from_source.translation -
       base->target_from_source.translation - Eigen::Vector3d(0.0, 0.0, 100.0))
          .norm(),
      1e-11);
}

// At 1e7 m a double has a resolution of 2e-9 m, which limits the estimate, too.
TEST_F(YawTranslationTest, KeepsItsDigitsFarFromTheOrigin) {
  const Eigen::Vector3d far_source(1e7, -2e7, 1e7);
  const Eigen::Vector3d far_target(-1e7, 1e7, 3e7);
  const auto near = EstimateYawTranslation(source_, target_, weights_);
  const auto far = EstimateYawTranslation(
      source_.colwise() + far_source, target_.colwise() + far_target, weights_);
  ASSERT_TRUE(far.has_value());
  EXPECT_THAT(far->yaw, IsAngleNear(near->yaw, 1e-9));
  EXPECT_NEAR(far->cost, near->cost, 1e-7 * near->cost);
  const Eigen::Vector3d x(50.0, 60.0, 70.0);
  EXPECT_LT((far->target_from_source * (x + far_source) - far_target -
             near->target_from_source * x)
                .norm(),
            5e-8);
}

TEST_F(YawTranslationTest, TwoPointsAreEnough) {
  const auto estimate =
      EstimateYawTranslation(source_.leftCols(2),
                             true_motion_.Apply(source_.leftCols(2)),
                             Weights::Ones(2));
  ASSERT_TRUE(estimate.has_value());
  EXPECT_THAT(estimate->yaw, IsAngleNear(2.2, kTolerance));
}

TEST_F(YawTranslationTest, DoesNotAnswerWhenThePointsHoldNoYaw) {
  EXPECT_FALSE(EstimateYawTranslation(Points(3, 0), Points(3, 0), Weights(0)));
  EXPECT_FALSE(
      EstimateYawTranslation(source_, target_, Weights::Zero(kNumPoints)));
  EXPECT_FALSE(EstimateYawTranslation(
      source_.leftCols(1), target_.leftCols(1), Weights::Ones(1)));
  for (const double reach : {0.0, 1.0, 1e3, 1e7}) {
    Points vertical = source_;
    vertical.row(0).setConstant(0.1 + reach);
    vertical.row(1).setConstant(0.7 * reach);
    EXPECT_FALSE(EstimateYawTranslation(vertical, target_, weights_)) << reach;
    EXPECT_FALSE(EstimateYawTranslation(
        vertical, true_motion_.Apply(vertical), weights_))
        << reach;
  }
}

TEST_F(YawTranslationTest, DoesNotAnswerForAVerticalOfRoundedPoints) {
  Points vertical = source_;
  for (Eigen::Index i = 0; i < kNumPoints; ++i) {
    vertical(0, i) = std::nextafter(1e7, i % 2 == 0 ? 0.0 : 2e7);
    vertical(1, i) = std::nextafter(-3e6, i % 3 == 0 ? 0.0 : -6e6);
  }
  EXPECT_FALSE(EstimateYawTranslation(vertical, target_, weights_));
  EXPECT_FALSE(EstimateYawTranslation(target_, vertical, weights_));
  EXPECT_FALSE(EstimateYawTranslation(vertical, vertical, weights_));
}

TEST_F(YawTranslationTest, DoesNotAnswerToNaN) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (int row = 0; row < 3; ++row) {
    Points source = source_;
    Points target = target_;
    source(row, 3) = nan;
    target(row, 5) = nan;
    EXPECT_FALSE(EstimateYawTranslation(source, target_, weights_)) << row;
    EXPECT_FALSE(EstimateYawTranslation(source_, target, weights_)) << row;
  }
  Weights weights = weights_;
  weights[3] = nan;
  EXPECT_FALSE(EstimateYawTranslation(source_, target_, weights));
}

}  // namespace
}  // namespace quatro::yaw_translation_test
