// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "solvers/closed_form/gravity.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <limits>

#include "features/base/rigid3.h"
#include "solvers/ceres/ins_refinement.h"
#include "solvers/closed_form/rotation.h"
#include "tests/support/matched_problems.h"
#include "tests/support/random_problems.h"

namespace quatro::gravity_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kTolerance = 1e-14;

void ExpectRotation(const Matrix3d& rotation) {
  EXPECT_LE((rotation * rotation.transpose() - Matrix3d::Identity()).norm(),
            kTolerance);
  EXPECT_GT(rotation.determinant(), 0.0);
}

TEST(LevelFromBody, TurnsAboutXThenY) {
  const Vector3d x = Vector3d::UnitX();
  const Vector3d y = Vector3d::UnitY();
  const Vector3d z = Vector3d::UnitZ();
  // Rolled to the right: the left side is up. Pitched: the nose is down.
  EXPECT_TRUE((LevelFromBody(M_PI / 2.0, 0.0) * y).isApprox(z));
  EXPECT_TRUE((LevelFromBody(0.0, M_PI / 2.0) * x).isApprox(-z));
  EXPECT_TRUE((LevelFromBody(M_PI / 2.0, M_PI / 2.0) * y).isApprox(x));
  EXPECT_EQ(LevelFromBody(0.0, 0.0), Matrix3d(Matrix3d::Identity()));
}

TEST(WorldFromBody, YawIsTheYaw) {
  const Matrix3d rotation = WorldFromBody({0.2, -0.3, 2.5});
  EXPECT_NEAR(Yaw(rotation), 2.5, kTolerance);
  EXPECT_LE((RotationZ(-2.5) * rotation - LevelFromBody(0.2, -0.3)).norm(),
            kTolerance);
}

TEST(AttitudeOf, IsTheInverse) {
  for (const Attitude& attitude : {Attitude{0.2, -0.3, 2.5},
                                   Attitude{-3.0, 1.5, -2.0},
                                   Attitude{0.0, 0.0, 0.0}}) {
    const Attitude found = AttitudeOf(WorldFromBody(attitude));
    EXPECT_NEAR(found.roll, attitude.roll, kTolerance);
    EXPECT_NEAR(found.pitch, attitude.pitch, kTolerance);
    EXPECT_NEAR(found.yaw, attitude.yaw, kTolerance);
  }
}

TEST(RelativeTilt, IsWhatIsLeftOfTheRotationWithoutItsYaw) {
  const Attitude source = {0.1, -0.2, 2.0};
  const Attitude target = {-0.15, 0.05, -1.0};
  const Matrix3d target_from_source =
      WorldFromBody(target).transpose() * WorldFromBody(source);
  const Matrix3d tilt = RelativeTilt(source, target);
  ExpectRotation(tilt);
  EXPECT_NEAR(Yaw(tilt), 0.0, kTolerance);
  EXPECT_LE(
      (RotationZ(Yaw(target_from_source)) * tilt - target_from_source).norm(),
      kTolerance);
}

TEST(RelativeTilt, OfALevelTargetIsTheSources) {
  EXPECT_LE((RelativeTilt({0.1, -0.2, 2.0}, {0.0, 0.0, -1.0}) -
             LevelFromBody(0.1, -0.2))
                .norm(),
            kTolerance);
}

TEST(RelativeTilt, OfOneSlopeDependsOnTheHeading) {
  // Up and down one slope of 0.1, the two attitudes differ only by a rotation.
  // Nose up and nose down with one heading, they differ by twice the slope.
  const Attitude uphill = {0.0, -0.1, 0.0};
  EXPECT_LE(
      (RelativeTilt(uphill, uphill) - Matrix3d(Matrix3d::Identity())).norm(),
      kTolerance);
  EXPECT_NEAR(AngleBetween(RelativeTilt(uphill, {0.0, 0.1, M_PI}),
                           Matrix3d::Identity()),
              0.0,
              kTolerance);
  EXPECT_NEAR(
      AngleBetween(RelativeTilt(uphill, {0.0, 0.1, 0.0}), Matrix3d::Identity()),
      0.2,
      kTolerance);
}

TEST(RotationBetween, TakesOneToTheOtherByTheirAngle) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const Vector3d from = RandomDirection(2 * seed);
    const Vector3d to = RandomDirection(2 * seed + 1);
    const Matrix3d rotation = RotationBetween(from, to);
    ExpectRotation(rotation);
    EXPECT_LE((rotation * from - to).norm(), kTolerance);
    EXPECT_NEAR(AngleBetween(rotation, Matrix3d::Identity()),
                std::atan2(from.cross(to).norm(), from.dot(to)),
                1e-12);
  }
}

TEST(RotationBetween, OfEqualAxesIsIdentityToTheLastBit) {
  EXPECT_EQ(RotationBetween(Vector3d::UnitZ(), Vector3d::UnitZ()),
            Matrix3d(Matrix3d::Identity()));
}

TEST(RotationBetween, OppositeAxesAreHalfATurnApart) {
  // Upside down: the rotation is about x.
  EXPECT_LE((RotationBetween(-Vector3d::UnitZ(), Vector3d::UnitZ()) -
             Matrix3d(Vector3d(1.0, -1.0, -1.0).asDiagonal()))
                .norm(),
            kTolerance);
  for (const double gap : {0.0, 1e-12, 1e-9, 1e-7, 1e-3}) {
    for (const Vector3d& axis :
         {Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(0.6, 0.0, 0.8)}) {
      const Vector3d to = -(axis + gap * axis.unitOrthogonal()).normalized();
      const Matrix3d rotation = RotationBetween(axis, to);
      ExpectRotation(rotation);
      EXPECT_LE((rotation * axis - to).norm(), 3e-8) << gap;
    }
  }
}

// Matches with noise `sigma`, tilted by LevelFromBody(0.1, -0.05).
class RefineWithInsTest : public ::testing::Test {
 protected:
  RefineWithInsTest() {
    source_ = RandomPoints(30, 10.0, 1);
    target_ = true_.Apply(source_) + RandomPoints(30, kSigma, 2);
    prior_.up_in_target = true_.rotation * prior_.up_in_source;
  }

  static double ErrorOf(const Rigid3& a, const Rigid3& b) {
    return (a.ToMatrix() - b.ToMatrix()).norm();
  }

  static constexpr double kSigma = 0.1;  // [m]
  const Rigid3 true_{RotationZ(1.0) * LevelFromBody(0.1, -0.05),
                     {100.0, -50.0, 3.0}};
  const Rigid3 start_{RotationZ(0.9), {99.0, -50.0, 3.0}};
  VerticalPrior prior_;
  Points source_;
  Points target_;
};

TEST_F(RefineWithInsTest, APriorWithoutWeightLeavesTheRigidFit) {
  prior_.angle_std = 1e6;
  const auto refined = RefineWithIns(source_, target_, kSigma, start_, prior_);
  const auto rigid = EstimateRigid(source_, target_, Weights::Ones(30));
  ASSERT_TRUE(refined.has_value());
  ASSERT_TRUE(rigid.has_value());
  EXPECT_LE(ErrorOf(refined->target_from_source, rigid->target_from_source),
            1e-7);
  EXPECT_NEAR(refined->cost, rigid->cost / (kSigma * kSigma), 1e-8);
}

TEST_F(RefineWithInsTest, AFirmPriorHoldsTheVertical) {
  prior_.up_in_target = true_.rotation * Vector3d(0.02, 0.0, 1.0).normalized();
  prior_.angle_std = 1e-6;
  const auto refined = RefineWithIns(source_, target_, kSigma, start_, prior_);
  ASSERT_TRUE(refined.has_value());
  EXPECT_LE((refined->target_from_source.rotation * prior_.up_in_source -
             prior_.up_in_target)
                .norm(),
            1e-6);
}

TEST_F(RefineWithInsTest, TwoMatchesAreEnough) {
  const Points source = source_.leftCols(2);
  const Points target = true_.Apply(source);
  const auto refined = RefineWithIns(source, target, kSigma, start_, prior_);
  ASSERT_TRUE(refined.has_value());
  EXPECT_LE(ErrorOf(refined->target_from_source, true_), 1e-6);
  EXPECT_LE(refined->cost, 1e-12);
}

TEST_F(RefineWithInsTest, SwapGivesTheInverse) {
  const auto refined = RefineWithIns(source_, target_, kSigma, start_, prior_);
  const auto swapped =
      RefineWithIns(target_,
                    source_,
                    kSigma,
                    Inverse(start_),
                    {prior_.up_in_target, prior_.up_in_source, 0.01});
  ASSERT_TRUE(refined.has_value());
  ASSERT_TRUE(swapped.has_value());
  EXPECT_LE(ErrorOf(Inverse(refined->target_from_source),
                    swapped->target_from_source),
            1e-5);
  EXPECT_NEAR(refined->cost, swapped->cost, 1e-6);
}

TEST_F(RefineWithInsTest, WhatHoldsNoRotationHasNoAnswer) {
  Points pole = Points::Zero(3, 20);
  pole.row(2).setLinSpaced(0.0, 5.0);
  EXPECT_FALSE(RefineWithIns(pole, pole, kSigma, {}, {}).has_value());
  EXPECT_FALSE(
      RefineWithIns(source_.leftCols(1), target_.leftCols(1), kSigma, {}, {})
          .has_value());
  source_(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(RefineWithIns(source_, target_, kSigma, {}, {}).has_value());
}

}  // namespace
}  // namespace quatro::gravity_test
