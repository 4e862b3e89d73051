// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "solvers/closed_form/rotation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "features/base/rigid3.h"
#include "tests/support/horn_rotation.h"
#include "tests/support/random_problems.h"

namespace quatro::rotation_test {
namespace {

constexpr double kTolerance = 1e-12;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Weights RandomWeights(Eigen::Index n, std::uint64_t seed) {
  Random random(seed);
  return Weights::NullaryExpr(n, [&] { return random.Uniform(); });
}

Eigen::Matrix3d Exp(const Eigen::Vector3d& delta) {
  if (delta.norm() == 0.0) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(delta.norm(), delta.normalized()).toRotationMatrix();
}

// Equation (1) at any R, and (4).
double CostAt(const Eigen::Matrix3d& R,
              const Points& source,
              const Points& target,
              const Weights& weights) {
  return (target - R * source).colwise().squaredNorm().dot(weights.transpose());
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

using Solver = std::optional<RotationEstimate> (*)(const PointsRef&,
                                                   const PointsRef&,
                                                   const WeightsRef&);

// Every test runs for both closed forms on fifty noisy pairs. None requires a
// clean fit.
class RotationTest : public ::testing::TestWithParam<Solver> {
 protected:
  static constexpr Eigen::Index kNumPairs = 50;

  static auto Estimate(const Points& source,
                       const Points& target,
                       const Weights& weights) {
    return GetParam()(source, target, weights);
  }

  const Eigen::Matrix3d true_rotation_ = RandomRotation(1);
  const Points source_ = RandomPoints(kNumPairs, 10.0, 2);
  const Points target_ =
      true_rotation_ * source_ + RandomPoints(kNumPairs, 1.0, 3);
  const Weights weights_ = RandomWeights(kNumPairs, 4);
};

INSTANTIATE_TEST_SUITE_P(ClosedForms,
                         RotationTest,
                         ::testing::Values(&EstimateRotation,
                                           &EstimateRotationHorn),
                         [](const auto& solver) {
                           return solver.index == 0 ? "Svd" : "Horn";
                         });

TEST_P(RotationTest, RecoversExactRotationsAndHalfTurns) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const Eigen::Vector3d axis = seed <= 3
                                     ? Eigen::Vector3d(Eigen::Vector3d::Unit(
                                           static_cast<Eigen::Index>(seed - 1)))
                                     : RandomDirection(seed);
    for (const double angle : {0.0, 1e-9, 0.5, 3.1, M_PI, -M_PI}) {
      const Eigen::Matrix3d R = Exp(angle * axis);
      const auto estimate = Estimate(source_, R * source_, weights_);
      ASSERT_TRUE(estimate.has_value());
      EXPECT_LT(AngleBetween(estimate->target_from_source, R), kTolerance);
      EXPECT_LT(estimate->cost, kTolerance);
    }
  }
}

TEST_P(RotationTest, IsALeastCost) {
  const auto estimate = Estimate(source_, target_, weights_);
  const Eigen::Matrix3d& R = estimate->target_from_source;
  EXPECT_NEAR(estimate->cost,
              CostAt(R, source_, target_, weights_),
              kTolerance * estimate->cost);
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    const double angle = std::pow(10.0, -4.0 * Random(seed).Uniform()) * M_PI;
    const Eigen::Matrix3d other = Exp(angle * RandomDirection(seed)) * R;
    EXPECT_GT(CostAt(other, source_, target_, weights_), estimate->cost);
  }
}

TEST_P(RotationTest, TurningEitherCloudTurnsTheAnswer) {
  const auto base = Estimate(source_, target_, weights_);
  const Eigen::Matrix3d A = RandomRotation(5);
  const Eigen::Matrix3d B = RandomRotation(6);
  const auto turned = Estimate(A * source_, B * target_, weights_);
  EXPECT_LT(AngleBetween(turned->target_from_source,
                         B * base->target_from_source * A.transpose()),
            kTolerance);
  EXPECT_NEAR(turned->cost, base->cost, kTolerance * base->cost);
  EXPECT_LT((turned->curvature - B * base->curvature * B.transpose()).norm(),
            kTolerance * base->curvature.norm());
}

TEST_P(RotationTest, SwappingSourceAndTargetInverts) {
  const auto forward = Estimate(source_, target_, weights_);
  const auto backward = Estimate(target_, source_, weights_);
  EXPECT_LT(AngleBetween(backward->target_from_source,
                         forward->target_from_source.transpose()),
            kTolerance);
  EXPECT_NEAR(backward->cost, forward->cost, kTolerance * forward->cost);
}

TEST_P(RotationTest, OrderDoesNotMatter) {
  const auto order = RandomPermutation(kNumPairs, 7);
  const auto base = Estimate(source_, target_, weights_);
  const auto permuted = Estimate(
      source_(Eigen::all, order), target_(Eigen::all, order), weights_(order));
  EXPECT_LT(
      AngleBetween(permuted->target_from_source, base->target_from_source),
      kTolerance);
}

TEST_P(RotationTest, WeightsScaleTheCostAndTheCurvatureOnly) {
  const auto base = Estimate(source_, target_, weights_);
  for (const double factor : {1e-100, 1e-9, 1e9, 1e100}) {
    const auto scaled = Estimate(source_, target_, factor * weights_);
    ASSERT_TRUE(scaled.has_value()) << factor;
    EXPECT_LT(
        AngleBetween(scaled->target_from_source, base->target_from_source),
        kTolerance);
    EXPECT_NEAR(scaled->cost / factor, base->cost, kTolerance * base->cost);
    EXPECT_LT((scaled->curvature / factor - base->curvature).norm(),
              kTolerance * base->curvature.norm());
  }
}

TEST_P(RotationTest, ZeroWeightIsTheSameAsLeavingThePairOut) {
  const Eigen::Index kKept = 20;
  Weights masked = weights_;
  masked.tail(kNumPairs - kKept).setZero();
  const auto all = Estimate(source_, target_, masked);
  const auto kept = Estimate(
      source_.leftCols(kKept), target_.leftCols(kKept), weights_.head(kKept));
  EXPECT_LT(AngleBetween(all->target_from_source, kept->target_from_source),
            kTolerance);
  EXPECT_NEAR(all->cost, kept->cost, kTolerance * kept->cost);
}

TEST_P(RotationTest, IsARotationEvenWhereAReflectionFitsBetter) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const Eigen::Matrix3d reflection =
        RandomRotation(seed) * Eigen::Vector3d(1.0, 1.0, -1.0).asDiagonal();
    // Flat, so that the reflected direction is that of least variance.
    const Points source = Eigen::Vector3d(1.0, 1.0, 0.3).asDiagonal() * source_;
    const auto estimate = Estimate(source, reflection * source, weights_);
    ASSERT_TRUE(estimate.has_value()) << "seed " << seed;
    const Eigen::Matrix3d& R = estimate->target_from_source;
    EXPECT_NEAR(R.determinant(), 1.0, kTolerance);
    EXPECT_LT((R * R.transpose() - Eigen::Matrix3d::Identity()).norm(),
              kTolerance);
    EXPECT_GT(estimate->cost, 1.0);
  }
}

TEST_P(RotationTest, DirectionsInAPlaneAreEnough) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const Eigen::Matrix3d R = RandomRotation(seed);
    Points flat = source_;
    flat.row(2).setZero();
    flat = RandomRotation(seed + 1000) * flat;
    const auto estimate = Estimate(flat, R * flat, weights_);
    ASSERT_TRUE(estimate.has_value()) << "seed " << seed;
    EXPECT_LT(AngleBetween(estimate->target_from_source, R), kTolerance);

    // Two directions determine a rotation.
    const auto of_two =
        Estimate(flat.leftCols(2), R * flat.leftCols(2), weights_.head(2));
    ASSERT_TRUE(of_two.has_value()) << "seed " << seed;
    EXPECT_LT(AngleBetween(of_two->target_from_source, R), 1e-9);
  }
}

TEST_P(RotationTest, CurvatureIsTheSecondDifferenceOfTheCost) {
  const auto estimate = Estimate(source_, target_, weights_);
  const double h = 1e-3;
  const auto cost_at = [&](const Eigen::Vector3d& delta) {
    return CostAt(
        Exp(delta) * estimate->target_from_source, source_, target_, weights_);
  };
  Eigen::Matrix3d numeric;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const Eigen::Vector3d a = h * Eigen::Vector3d::Unit(i);
      const Eigen::Vector3d b = h * Eigen::Vector3d::Unit(j);
      numeric(i, j) =
          (cost_at(a + b) - cost_at(a - b) - cost_at(b - a) + cost_at(-a - b)) /
          (4.0 * h * h);
    }
  }
  ASSERT_GT(numeric.norm(), 1.0);
  EXPECT_LT((estimate->curvature - numeric).norm(), 1e-5 * numeric.norm());
}

TEST_P(RotationTest, LeastCurvatureIsThatOfTheSingularValues) {
  // Along the axes, d_i = 2 |s_i| |t_i|.
  Points source(3, 6);
  source << Eigen::Matrix3d::Identity(), -Eigen::Matrix3d::Identity();
  const Points target = Eigen::Vector3d(5.0, 3.0, -2.0).asDiagonal() * source;
  const auto estimate = Estimate(source, target, Weights::Ones(6));
  ASSERT_TRUE(estimate.has_value());
  EXPECT_LT(
      AngleBetween(estimate->target_from_source, Eigen::Matrix3d::Identity()),
      kTolerance);
  EXPECT_LT((estimate->curvature.diagonal() - Eigen::Vector3d(4.0, 12.0, 32.0))
                .norm(),
            kTolerance);
}

TEST_P(RotationTest, DoesNotAnswerWhenThePairsHoldNoRotation) {
  EXPECT_FALSE(Estimate(Points(3, 0), Points(3, 0), Weights(0)));
  EXPECT_FALSE(Estimate(source_, target_, Weights::Zero(kNumPairs)));
  EXPECT_FALSE(
      Estimate(source_.leftCols(1), target_.leftCols(1), Weights::Ones(1)));
  EXPECT_FALSE(
      Estimate(Points::Zero(3, kNumPairs), target_, Weights(weights_)));

  Weights one = Weights::Zero(kNumPairs);
  one[7] = 1.0;
  EXPECT_FALSE(Estimate(source_, target_, one));
}

TEST_P(RotationTest, DoesNotAnswerWhenAllIsOnALine) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const Eigen::RowVectorXd along = source_.row(0);
    const Points line = RandomDirection(seed) * along;
    EXPECT_FALSE(Estimate(line, RandomRotation(seed) * line, weights_)) << seed;
    EXPECT_FALSE(Estimate(line, target_, weights_)) << seed;
    EXPECT_FALSE(Estimate(source_, line, weights_)) << seed;
  }
}

TEST_P(RotationTest, DoesNotAnswerWhenTwoRotationsTieForAReflection) {
  Points axes(3, 6);
  axes << Eigen::Matrix3d::Identity(), -Eigen::Matrix3d::Identity();
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const Points source = RandomRotation(seed) * axes;
    const Points target = -RandomRotation(seed + 1000) * source;
    EXPECT_FALSE(Estimate(source, target, Weights::Ones(6))) << seed;
    // Without the tie, there is a solution.
    Weights uneven = Weights::Ones(6);
    uneven[0] = 0.9;
    EXPECT_TRUE(Estimate(source, target, uneven)) << seed;
  }
}

TEST_P(RotationTest, DoesNotAnswerToNaN) {
  for (int field = 0; field < 3; ++field) {
    Points source = source_;
    Points target = target_;
    Weights weights = weights_;
    if (field == 0) source(1, 3) = kNaN;
    if (field == 1) target(2, 3) = kNaN;
    if (field == 2) weights[3] = kNaN;
    EXPECT_FALSE(Estimate(source, target, weights)) << field;
    EXPECT_FALSE(EstimateRigid(source, target, weights)) << field;
  }
}

TEST(EstimateRotation, BothClosedFormsAgree) {
  int num_compared = 0;
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    Random random(seed);
    const auto n = static_cast<Eigen::Index>(2 + random.Below(60));
    const Points source = RandomPoints(n, 10.0, seed + 10000);
    const double noise = 20.0 * random.Uniform() * random.Uniform();
    const Points target =
        RandomRotation(seed) * source + RandomPoints(n, noise, seed + 20000);
    const Weights weights = RandomWeights(n, seed + 30000);
    const auto svd = EstimateRotation(source, target, weights);
    const auto horn = EstimateRotationHorn(source, target, weights);
    ASSERT_EQ(svd.has_value(), horn.has_value()) << "seed " << seed;
    ASSERT_TRUE(svd.has_value()) << "seed " << seed;
    const auto eigenvalues =
        svd->curvature.selfadjointView<Eigen::Lower>().eigenvalues();
    if (eigenvalues[0] < 1e-4 * eigenvalues[2]) continue;
    ++num_compared;
    EXPECT_LT(AngleBetween(svd->target_from_source, horn->target_from_source),
              1e-10)
        << "seed " << seed;
    EXPECT_NEAR(svd->cost, horn->cost, 1e-10 * svd->cost) << "seed " << seed;
    EXPECT_LT((svd->curvature - horn->curvature).norm(),
              1e-10 * svd->curvature.norm())
        << "seed " << seed;
  }
  EXPECT_GT(num_compared, 1950);
}

class RigidTest : public ::testing::Test {
 protected:
  static constexpr Eigen::Index kNumPoints = 40;

  const Rigid3 true_motion_{RandomRotation(11), {30.0, -20.0, 5.0}};
  const Points source_ = RandomPoints(kNumPoints, 10.0, 12).colwise() +
                         Eigen::Vector3d(50.0, 60.0, 70.0);
  const Points target_ =
      true_motion_.Apply(source_) + RandomPoints(kNumPoints, 0.5, 13);
  const Weights weights_ = RandomWeights(kNumPoints, 14);
};

TEST_F(RigidTest, RecoversExactMotions) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const Rigid3 motion{RandomRotation(seed), 100.0 * RandomDirection(seed)};
    const auto estimate =
        EstimateRigid(source_, motion.Apply(source_), weights_);
    ASSERT_TRUE(estimate.has_value());
    EXPECT_LT(
        AngleBetween(estimate->target_from_source.rotation, motion.rotation),
        kTolerance);
    EXPECT_LT(
        (estimate->target_from_source.translation - motion.translation).norm(),
        1e-11);
    EXPECT_LT(estimate->cost, 1e-20);
  }
}

TEST_F(RigidTest, IsALeastCost) {
  const auto estimate = EstimateRigid(source_, target_, weights_);
  const Rigid3& best = estimate->target_from_source;
  EXPECT_NEAR(estimate->cost,
              CostAt(best, source_, target_, weights_),
              1e-10 * estimate->cost);
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    const double size = std::pow(10.0, -4.0 * Random(seed).Uniform());
    const Eigen::Vector3d pivot = source_.rowwise().mean();
    Rigid3 other{Exp(size * RandomDirection(seed)) * best.rotation, {}};
    other.translation = best * pivot - other.rotation * pivot +
                        size * RandomDirection(seed + 1000);
    EXPECT_GT(CostAt(other, source_, target_, weights_), estimate->cost);
  }
}

TEST_F(RigidTest, MovingEitherCloudMovesTheAnswer) {
  const auto base = EstimateRigid(source_, target_, weights_);
  const Rigid3 a{RandomRotation(15), {1.0, 2.0, 3.0}};
  const Rigid3 b{RandomRotation(16), {-9.0, 8.0, 7.0}};
  const auto moved =
      EstimateRigid(a.Apply(source_), b.Apply(target_), weights_);
  const Rigid3 expected = b * base->target_from_source * Inverse(a);
  EXPECT_LT(AngleBetween(moved->target_from_source.rotation, expected.rotation),
            kTolerance);
  EXPECT_LT(
      (moved->target_from_source.translation - expected.translation).norm(),
      1e-11);
  EXPECT_NEAR(moved->cost, base->cost, 1e-10 * base->cost);
}

TEST_F(RigidTest, SwappingSourceAndTargetInverts) {
  const auto forward = EstimateRigid(source_, target_, weights_);
  const auto backward = EstimateRigid(target_, source_, weights_);
  const Rigid3 expected = Inverse(forward->target_from_source);
  EXPECT_LT(
      AngleBetween(backward->target_from_source.rotation, expected.rotation),
      kTolerance);
  EXPECT_LT(
      (backward->target_from_source.translation - expected.translation).norm(),
      1e-11);
}

TEST_F(RigidTest, ZeroWeightIsTheSameAsLeavingThePointOut) {
  const Eigen::Index kKept = 15;
  Weights masked = weights_;
  masked.tail(kNumPoints - kKept).setZero();
  Points wild = source_;
  wild.rightCols(kNumPoints - kKept).array() *= 1e9;
  const auto all = EstimateRigid(wild, target_, masked);
  const auto kept = EstimateRigid(
      source_.leftCols(kKept), target_.leftCols(kKept), weights_.head(kKept));
  ASSERT_TRUE(all.has_value());
  EXPECT_LT(AngleBetween(all->target_from_source.rotation,
                         kept->target_from_source.rotation),
            kTolerance);
  EXPECT_LT((all->target_from_source.translation -
             kept->target_from_source.translation)
                .norm(),
            1e-11);
}

// At 1e7 m a double has a resolution of 2e-9 m, which limits the estimate, too.
TEST_F(RigidTest, KeepsItsDigitsFarFromTheOrigin) {
  const Eigen::Vector3d far_source(1e7, -2e7, 1e7);
  const Eigen::Vector3d far_target(-1e7, 1e7, 3e7);
  const Points source = source_.colwise() + far_source;
  const Points target = target_.colwise() + far_target;
  const auto near = EstimateRigid(source_, target_, weights_);
  const auto far = EstimateRigid(source, target, weights_);
  ASSERT_TRUE(far.has_value());
  EXPECT_LT(AngleBetween(far->target_from_source.rotation,
                         near->target_from_source.rotation),
            1e-9);
  EXPECT_NEAR(far->cost, near->cost, 1e-7 * near->cost);
  const Eigen::Vector3d x(50.0, 60.0, 70.0);
  EXPECT_LT((far->target_from_source * (x + far_source) - far_target -
             near->target_from_source * x)
                .norm(),
            5e-8);
}

TEST_F(RigidTest, DoesNotAnswerOnALineWhereverItIs) {
  int num_answers = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const double reach = std::pow(10.0, static_cast<double>(seed % 8));
    const Eigen::RowVectorXd along = RandomPoints(kNumPoints, 1.0, seed).row(0);
    const Points line = (RandomDirection(seed) * along).colwise() +
                        reach * RandomDirection(seed + 500);
    const Rigid3 motion{RandomRotation(seed), 10.0 * RandomDirection(seed)};
    num_answers +=
        EstimateRigid(line, motion.Apply(line), weights_).has_value();
    num_answers += EstimateRigid(line, target_, weights_).has_value();
  }
  EXPECT_EQ(num_answers, 0);
}

TEST_F(RigidTest, DoesNotAnswerWithoutThreePoints) {
  EXPECT_FALSE(EstimateRigid(Points(3, 0), Points(3, 0), Weights(0)));
  EXPECT_FALSE(EstimateRigid(source_, target_, Weights::Zero(kNumPoints)));
  for (Eigen::Index n = 1; n <= 4; ++n) {
    EXPECT_EQ(EstimateRigid(
                  source_.leftCols(n), target_.leftCols(n), Weights::Ones(n))
                  .has_value(),
              n >= 3)
        << n;
  }
  EXPECT_FALSE(EstimateRigid(
      source_.col(0).replicate(1, 9), target_.leftCols(9), Weights::Ones(9)));
}

}  // namespace
}  // namespace quatro::rotation_test
