// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Compares closed forms with their Ceres twins, and tests the parts of the
// twins.

#include "solvers/ceres/ceres_twins.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "features/base/rigid3.h"
#include "solvers/ceres/ceres_residuals.h"
#include "solvers/ceres/second_derivative.h"
#include "tests/support/horn_rotation.h"
#include "tests/support/matchers.h"
#include "tests/support/random_problems.h"

namespace quatro::ceres_twins_test {
namespace {

constexpr int kNumProblems = 1000;

// Tolerances of the argmin [rad, m], the cost and the curvature (relative).
constexpr double kTolerance = 1e-8;

// A problem is ill-conditioned if the least curvature of its rotation is below
// the first fraction of sum_i w_i |s_i| |t_i| about the means, or the second
// fraction of that sum about the origin. There, rounding (1e-16) and the 50 m
// to the origin alone move the estimate by 1e-9.
constexpr double kMinConditioning = 1e-5;
constexpr double kMinConditioningFarAway = 1e-8;

struct WeightedPairs {
  Points source;
  Points target;
  Weights weights;

  double Scale() const {
    return (source.colwise().norm().array() * target.colwise().norm().array())
        .matrix()
        .dot(weights.transpose());
  }
  double SquaredReach() const {
    return (source.colwise().squaredNorm() + target.colwise().squaredNorm())
        .dot(weights.transpose());
  }
};

// 1 to 60 pairs. A fifth of them have no weight; weights vary over many orders
// of magnitude; noise ranges from zero to twice the signal.
WeightedPairs RandomPairs(const Eigen::Matrix3d& rotation, std::uint64_t seed) {
  Random random(seed);
  const auto n = static_cast<Eigen::Index>(1 + random.Below(60));
  const double size = std::pow(10.0, 2.0 * random.Uniform() - 0.5);
  const double noise =
      seed % 10 == 0 ? 0.0
                     : size * std::pow(10.0, 5.0 * random.Uniform() - 4.7);
  const double weight = std::pow(10.0, 12.0 * random.Uniform() - 6.0);
  WeightedPairs pairs;
  pairs.source = RandomPoints(n, size, Mix(seed) + 1);
  pairs.target =
      rotation * pairs.source + RandomPoints(n, noise, Mix(seed) + 2);
  pairs.weights = Weights::NullaryExpr(n, [&] {
    return random.Uniform() < 0.2 ? 0.0 : weight * random.Uniform();
  });
  return pairs;
}

// `pairs` with both clouds translated.
WeightedPairs Moved(WeightedPairs pairs, std::uint64_t seed) {
  pairs.source.colwise() += 50.0 * RandomDirection(Mix(seed) + 3);
  pairs.target.colwise() += 50.0 * RandomDirection(Mix(seed) + 4);
  return pairs;
}

// Coordinates relative to the weighted means.
WeightedPairs Centered(WeightedPairs pairs) {
  const double total = pairs.weights.sum();
  const Eigen::Vector3d p = pairs.source * pairs.weights / total;
  const Eigen::Vector3d q = pairs.target * pairs.weights / total;
  pairs.source.colwise() -= p;
  pairs.target.colwise() -= q;
  return pairs;
}

bool IsIllConditioned(const WeightedPairs& pairs, double least_curvature) {
  return !(least_curvature >
           std::max(kMinConditioning * Centered(pairs).Scale(),
                    kMinConditioningFarAway * pairs.Scale()));
}

double LeastEigenvalue(const Eigen::MatrixXd& symmetric) {
  return symmetric.selfadjointView<Eigen::Lower>().eigenvalues()[0];
}

// Rounding gives a sum of squares of numbers this large an error even if the
// sum is zero.
double CostTolerance(const WeightedPairs& pairs, double cost) {
  return kTolerance * cost + 1e-22 * pairs.SquaredReach();
}

TEST(CeresTwins, YawAgreesWithItsClosedForm) {
  int num_skipped = 0;
  for (std::uint64_t seed = 1; seed <= kNumProblems; ++seed) {
    SCOPED_TRACE(seed);
    const double yaw = 2.0 * M_PI * Random(seed + 5000).Uniform();
    WeightedPairs pairs = RandomPairs(RotationZ(yaw), seed);
    const auto closed_form =
        EstimateYaw(pairs.source, pairs.target, pairs.weights);
    const auto twin =
        SolveYawByCeres(pairs.source, pairs.target, pairs.weights);
    ASSERT_EQ(closed_form.has_value(), twin.is_usable) << twin.message;
    if (!twin.is_usable ||
        twin.estimate.curvature < kMinConditioning * pairs.Scale()) {
      ++num_skipped;
      continue;
    }
    EXPECT_THAT(twin.estimate.target_from_source,
                IsAngleNear(closed_form->target_from_source, kTolerance))
        << twin.message;
    EXPECT_NEAR(twin.estimate.cost,
                closed_form->cost,
                CostTolerance(pairs, closed_form->cost));
    EXPECT_NEAR(twin.estimate.curvature,
                closed_form->curvature,
                kTolerance * closed_form->curvature);
  }
  RecordProperty("skipped", num_skipped);
  EXPECT_LT(num_skipped, 10);
}

TEST(CeresTwins, RotationAgreesWithItsClosedForms) {
  int num_skipped = 0;
  for (std::uint64_t seed = 1; seed <= kNumProblems; ++seed) {
    SCOPED_TRACE(seed);
    const WeightedPairs pairs = RandomPairs(RandomRotation(seed), seed);
    const auto twin =
        SolveRotationByCeres(pairs.source, pairs.target, pairs.weights);
    if (!twin.is_usable || LeastEigenvalue(twin.estimate.curvature) <
                               kMinConditioning * pairs.Scale()) {
      ++num_skipped;
      continue;
    }
    for (const auto& closed_form :
         {EstimateRotation(pairs.source, pairs.target, pairs.weights),
          EstimateRotationHorn(pairs.source, pairs.target, pairs.weights)}) {
      ASSERT_TRUE(closed_form.has_value());
      EXPECT_LT(AngleBetween(twin.estimate.target_from_source,
                             closed_form->target_from_source),
                kTolerance)
          << twin.message;
      EXPECT_NEAR(twin.estimate.cost,
                  closed_form->cost,
                  CostTolerance(pairs, closed_form->cost));
      EXPECT_LT((twin.estimate.curvature - closed_form->curvature).norm(),
                kTolerance * closed_form->curvature.norm());
    }
  }
  RecordProperty("skipped", num_skipped);
  EXPECT_LT(num_skipped, 60);
}

TEST(CeresTwins, YawTranslationAgreesWithItsClosedForm) {
  int num_skipped = 0;
  for (std::uint64_t seed = 1; seed <= kNumProblems; ++seed) {
    SCOPED_TRACE(seed);
    const double yaw = 2.0 * M_PI * Random(seed + 5000).Uniform();
    const WeightedPairs pairs = Moved(RandomPairs(RotationZ(yaw), seed), seed);
    const auto twin =
        SolveYawTranslationByCeres(pairs.source, pairs.target, pairs.weights);
    if (!twin.is_usable ||
        IsIllConditioned(pairs, twin.estimate.curvature(0, 0))) {
      ++num_skipped;
      continue;
    }
    const auto closed_form =
        EstimateYawTranslation(pairs.source, pairs.target, pairs.weights);
    ASSERT_TRUE(closed_form.has_value());
    EXPECT_THAT(twin.estimate.yaw, IsAngleNear(closed_form->yaw, kTolerance))
        << twin.message;
    EXPECT_LT((twin.estimate.target_from_source.ToMatrix() -
               closed_form->target_from_source.ToMatrix())
                  .norm(),
              kTolerance);
    EXPECT_NEAR(twin.estimate.cost,
                closed_form->cost,
                CostTolerance(pairs, closed_form->cost));
    EXPECT_LT((twin.estimate.curvature - closed_form->curvature).norm(),
              kTolerance * closed_form->curvature.norm());
  }
  RecordProperty("skipped", num_skipped);
  EXPECT_LT(num_skipped, 60);
}

TEST(CeresTwins, PoseAgreesWithItsClosedForm) {
  int num_skipped = 0;
  for (std::uint64_t seed = 1; seed <= kNumProblems; ++seed) {
    SCOPED_TRACE(seed);
    const WeightedPairs pairs =
        Moved(RandomPairs(RandomRotation(seed), seed), seed);
    const auto twin =
        SolvePoseByCeres(pairs.source, pairs.target, pairs.weights);
    if (!twin.is_usable ||
        IsIllConditioned(
            pairs,
            LeastEigenvalue(twin.estimate.curvature.topLeftCorner<3, 3>()))) {
      ++num_skipped;
      continue;
    }
    const auto closed_form =
        EstimateRigid(pairs.source, pairs.target, pairs.weights);
    ASSERT_TRUE(closed_form.has_value());
    EXPECT_LT((twin.estimate.target_from_source.ToMatrix() -
               closed_form->target_from_source.ToMatrix())
                  .norm(),
              kTolerance)
        << twin.message;
    EXPECT_NEAR(twin.estimate.cost,
                closed_form->cost,
                CostTolerance(pairs, closed_form->cost));
    EXPECT_LT((twin.estimate.curvature - closed_form->curvature).norm(),
              kTolerance * closed_form->curvature.norm());
  }
  RecordProperty("skipped", num_skipped);
  EXPECT_LT(num_skipped, 100);
}

class CeresTwinTest : public ::testing::Test {
 protected:
  static constexpr Eigen::Index kNumPairs = 30;

  const Points source_ = RandomPoints(kNumPairs, 10.0, 1);
  const Weights weights_ = RandomPoints(kNumPairs, 1.0, 3).row(0).cwiseAbs();
};

// The starts at which (1) is flat: exactly half a rotation from the minimum.
TEST_F(CeresTwinTest, FindsTheMinimumFromEveryHalfTurn) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Eigen::Matrix3d R = RandomRotation(seed);
    // Principal axes are along x, y, z, so half rotations are flat points.
    Points axes(3, 6);
    axes << Eigen::Matrix3d::Identity(), -Eigen::Matrix3d::Identity();
    const Points source = Eigen::Vector3d(5.0, 3.0, 2.0).asDiagonal() * axes;
    for (int i = 0; i < 3; ++i) {
      const Eigen::Matrix3d half_turn =
          Eigen::AngleAxisd(M_PI, Eigen::Vector3d::Unit(i)).toRotationMatrix();
      const auto rotation = SolveRotationByCeres(
          source, R * source, Weights::Ones(6), R * half_turn);
      ASSERT_TRUE(rotation.is_usable);
      EXPECT_LT(AngleBetween(rotation.estimate.target_from_source, R),
                kTolerance)
          << rotation.message;
      const auto pose = SolvePoseByCeres(source,
                                         R * source,
                                         Weights::Ones(6),
                                         {R * half_turn, {1.0, 2.0, 3.0}});
      EXPECT_LT(AngleBetween(pose.estimate.target_from_source.rotation, R),
                kTolerance)
          << pose.message;
    }
    const double yaw = Yaw(R);
    const Points turned = RotationZ(yaw) * source;
    const auto twin =
        SolveYawByCeres(source, turned, Weights::Ones(6), yaw + M_PI);
    EXPECT_THAT(twin.estimate.target_from_source, IsAngleNear(yaw, kTolerance))
        << twin.message;
    const auto planar = SolveYawTranslationByCeres(
        source, turned, Weights::Ones(6), {RotationZ(yaw + M_PI), {}});
    EXPECT_THAT(planar.estimate.yaw, IsAngleNear(yaw, kTolerance))
        << planar.message;
  }
}

TEST_F(CeresTwinTest, KeepsItsDigitsFarFromTheOrigin) {
  const Rigid3 motion{RandomRotation(4), {1.0, 2.0, 3.0}};
  const Points target = motion.Apply(source_) + RandomPoints(kNumPairs, 0.5, 5);
  const Points far_source = source_.colwise() + Eigen::Vector3d(1e7, -2e7, 1e7);
  const Points far_target = target.colwise() + Eigen::Vector3d(3e7, 1e7, -1e7);
  const auto twin = SolvePoseByCeres(far_source, far_target, weights_);
  const auto closed_form = EstimateRigid(far_source, far_target, weights_);
  EXPECT_LT(AngleBetween(twin.estimate.target_from_source.rotation,
                         closed_form->target_from_source.rotation),
            1e-12);
  EXPECT_LT((twin.estimate.target_from_source * far_source.col(0) -
             closed_form->target_from_source * far_source.col(0))
                .norm(),
            5e-8);
}

TEST_F(CeresTwinTest, IsNotUsableWithoutWeightOrWithNaN) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Points broken = source_;
  broken(1, 3) = nan;
  Weights not_numbers = weights_;
  not_numbers[0] = nan;
  const Weights zero = Weights::Zero(kNumPairs);
  EXPECT_FALSE(SolveYawByCeres(source_, source_, zero).is_usable);
  EXPECT_FALSE(SolveYawByCeres(broken, source_, weights_).is_usable);
  EXPECT_FALSE(SolveYawTranslationByCeres(source_, source_, zero).is_usable);
  EXPECT_FALSE(SolvePoseByCeres(source_, broken, weights_).is_usable);
  EXPECT_FALSE(
      SolvePoseByCeres(Points(3, 0), Points(3, 0), Weights(0)).is_usable);
  const auto twin = SolveRotationByCeres(source_, source_, not_numbers);
  EXPECT_FALSE(twin.is_usable);
  EXPECT_EQ(twin.message, "a point or a weight is not finite");
}

TEST_F(CeresTwinTest, UndeterminedIsUsableWithASingularCurvature) {
  Points line = Points::Zero(3, kNumPairs);
  line.row(1) = source_.row(1);
  const Points target = RandomRotation(6) * line;
  const auto twin = SolveRotationByCeres(line, target, weights_);
  ASSERT_TRUE(twin.is_usable) << twin.message;
  EXPECT_LT(LeastEigenvalue(twin.estimate.curvature),
            1e-12 * twin.estimate.curvature.norm());
}

// The fit is poor, so the residuals' own second derivative matters.
TEST_F(CeresTwinTest, CurvatureIsTheSecondDifferenceOfTheCost) {
  const Points target =
      RandomRotation(7) * source_ + RandomPoints(kNumPairs, 8.0, 8);
  const auto twin = SolvePoseByCeres(source_, target, weights_);
  const Rigid3& best = twin.estimate.target_from_source;
  const Eigen::Vector3d pivot = source_ * weights_ / weights_.sum();
  using Vector6 = Eigen::Vector<double, 6>;
  const auto cost_at = [&](const Vector6& x) {
    const double angle = x.head<3>().norm();
    const Eigen::Matrix3d exp =
        Eigen::AngleAxisd(angle, x.head<3>() / std::max(angle, 1e-300))
            .toRotationMatrix();
    Rigid3 moved{exp * best.rotation, {}};
    moved.translation = best * pivot - moved.rotation * pivot + x.tail<3>();
    return (target - moved.Apply(source_))
        .colwise()
        .squaredNorm()
        .dot(weights_.transpose());
  };
  const double h = 1e-3;
  Eigen::Matrix<double, 6, 6> numeric;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      const Vector6 a = h * Vector6::Unit(i);
      const Vector6 b = h * Vector6::Unit(j);
      numeric(i, j) =
          (cost_at(a + b) - cost_at(a - b) - cost_at(b - a) + cost_at(-a - b)) /
          (4.0 * h * h);
    }
  }
  ASSERT_GT(numeric.norm(), 1.0);
  EXPECT_LT((twin.estimate.curvature - numeric).norm(), 1e-5 * numeric.norm());
}

TEST(SecondDerivative, OfAPolynomialByHand) {
  // f = x^3 y + 2 x + 5 y^2 about (2, 3).
  const auto at = ComputeSecondDerivative<2>([]<typename T>(const T* d) {
    const T x = d[0] + Constant<T>(2.0);
    const T y = d[1] + Constant<T>(3.0);
    return x * x * x * y + Constant<T>(2.0) * x + Constant<T>(5.0) * y * y;
  });
  EXPECT_EQ(at.value, 24.0 + 4.0 + 45.0);
  EXPECT_EQ(at.gradient, Eigen::Vector2d(38.0, 38.0));
  Eigen::Matrix2d expected;
  expected << 36.0, 12.0, 12.0, 10.0;
  EXPECT_EQ(at.hessian, expected);
}

}  // namespace
}  // namespace quatro::ceres_twins_test
