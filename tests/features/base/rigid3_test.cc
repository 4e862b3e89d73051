// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/base/rigid3.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "features/base/random.h"
#include "tests/support/matched_problems.h"
#include "tests/support/matchers.h"
#include "tests/support/random_problems.h"

namespace quatro::rigid3_test {
namespace {

constexpr double kTolerance = 1e-14;

Rigid3 RandomMotion(Random* random) {
  return {RandomRotation(random->Next()),
          RandomPointsInBox(1, Eigen::Vector3d::Constant(10.0), random)};
}

double Difference(const Rigid3& a, const Rigid3& b) {
  return (a.ToMatrix() - b.ToMatrix()).cwiseAbs().maxCoeff();
}

class Rigid3Test : public ::testing::Test {
 protected:
  Random random_{3};
  const Rigid3 b_from_a_ = RandomMotion(&random_);
  const Rigid3 c_from_b_ = RandomMotion(&random_);
  const Points points_in_a_ =
      RandomPointsInBox(20, Eigen::Vector3d::Constant(5.0), &random_);
};

TEST_F(Rigid3Test, DefaultLeavesPointsWhereTheyAre) {
  EXPECT_EQ(Rigid3().Apply(points_in_a_), points_in_a_);
  EXPECT_EQ(Rigid3().ToMatrix(), Eigen::Matrix4d::Identity());
}

TEST_F(Rigid3Test, TurnsBeforeItMoves) {
  const Rigid3 quarter_turn{RotationZ(M_PI / 2), {1.0, 2.0, 3.0}};
  const Eigen::Vector3d moved = quarter_turn * Eigen::Vector3d(10.0, 0.0, 0.0);
  EXPECT_NEAR((moved - Eigen::Vector3d(1.0, 12.0, 3.0)).norm(), 0.0, 1e-14);
}

TEST_F(Rigid3Test, ApplyMovesEachColumnAsTheProductDoes) {
  const Points moved = b_from_a_.Apply(points_in_a_);
  ASSERT_EQ(moved.cols(), points_in_a_.cols());
  for (Eigen::Index i = 0; i < moved.cols(); ++i) {
    const Eigen::Vector3d product =
        b_from_a_ * Eigen::Vector3d(points_in_a_.col(i));
    EXPECT_LE((moved.col(i) - product).norm(), kTolerance) << "column " << i;
  }
}

TEST_F(Rigid3Test, ApplyOfNoPointsIsNoPoints) {
  EXPECT_EQ(b_from_a_.Apply(Points(3, 0)).cols(), 0);
}

TEST_F(Rigid3Test, CompositionIsOneAfterTheOther) {
  const Points together = (c_from_b_ * b_from_a_).Apply(points_in_a_);
  const Points in_turn = c_from_b_.Apply(b_from_a_.Apply(points_in_a_));
  EXPECT_LE((together - in_turn).cwiseAbs().maxCoeff(), 1e-13);
}

TEST_F(Rigid3Test, CompositionIsTheProductOfMatrices) {
  EXPECT_LE(((c_from_b_ * b_from_a_).ToMatrix() -
             c_from_b_.ToMatrix() * b_from_a_.ToMatrix())
                .cwiseAbs()
                .maxCoeff(),
            kTolerance);
}

TEST_F(Rigid3Test, InverseUndoesOnBothSides) {
  EXPECT_LE(Difference(Inverse(b_from_a_) * b_from_a_, Rigid3()), kTolerance);
  EXPECT_LE(Difference(b_from_a_ * Inverse(b_from_a_), Rigid3()), kTolerance);
}

TEST_F(Rigid3Test, InverseOfAChainRunsBackwards) {
  EXPECT_LE(Difference(Inverse(c_from_b_ * b_from_a_),
                       Inverse(b_from_a_) * Inverse(c_from_b_)),
            kTolerance);
}

TEST(RotationZ, TurnsCounterClockwise) {
  const Eigen::Vector3d turned = RotationZ(M_PI / 2) * Eigen::Vector3d::UnitX();
  EXPECT_NEAR((turned - Eigen::Vector3d::UnitY()).norm(), 0.0, 1e-15);
}

TEST(Yaw, IsReadBackFromATurnAboutZ) {
  for (const double yaw : {0.0, 1e-12, -0.3, 1.6, 3.0, -3.0, M_PI, -M_PI}) {
    EXPECT_THAT(Yaw(RotationZ(yaw)), IsAngleNear(yaw, 1e-15)) << yaw;
  }
}

TEST(Yaw, WrapsIntoHalfATurnEitherWay) {
  EXPECT_NEAR(Yaw(RotationZ(M_PI + 0.1)), -M_PI + 0.1, 1e-15);
  EXPECT_NEAR(Yaw(RotationZ(-M_PI - 0.1)), M_PI - 0.1, 1e-15);
  EXPECT_NEAR(Yaw(RotationZ(7.0)), 7.0 - 2.0 * M_PI, 1e-15);
}

TEST(Yaw, IsTheFirstAngleOfYawPitchRoll) {
  for (const double yaw : {-3.0, -1.0, 0.4, 2.5}) {
    const Eigen::Matrix3d tilted =
        RotationZ(yaw) *
        Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitY()).toRotationMatrix() *
        Eigen::AngleAxisd(-0.7, Eigen::Vector3d::UnitX()).toRotationMatrix();
    EXPECT_THAT(Yaw(tilted), IsAngleNear(yaw, 1e-15));
  }
}

class AngleBetweenTest : public ::testing::Test {
 protected:
  const Eigen::Matrix3d base_ = RandomRotation(4);
  const Eigen::Vector3d axis_ = Eigen::Vector3d(1.0, -2.0, 0.5).normalized();

  Eigen::Matrix3d Turned(double angle) const {
    return base_ * Eigen::AngleAxisd(angle, axis_).toRotationMatrix();
  }
};

TEST_F(AngleBetweenTest, IsTheAngleOfTheTurnBetween) {
  for (const double angle : {0.1, 1.0, M_PI / 2, 2.0, 3.0, 3.14}) {
    EXPECT_NEAR(AngleBetween(base_, Turned(angle)), angle, 1e-14);
    EXPECT_NEAR(AngleBetween(Turned(angle), base_), angle, 1e-14);
  }
}

TEST_F(AngleBetweenTest, HasAllDigitsOfASmallAngle) {
  // The trace would lose angles below 1e-8 rad.
  const Eigen::Matrix3d tiny = RotationZ(1e-9);
  EXPECT_NEAR(AngleBetween(Eigen::Matrix3d::Identity(), tiny), 1e-9, 1e-24);
  EXPECT_NEAR(AngleBetween(base_, Turned(1e-9)), 1e-9, 1e-15);
  EXPECT_EQ(AngleBetween(tiny, tiny), 0.0);
}

TEST_F(AngleBetweenTest, IsHalfATurnAtMost) {
  EXPECT_NEAR(AngleBetween(base_, Turned(M_PI)), M_PI, 1e-14);
  EXPECT_NEAR(AngleBetween(base_, Turned(M_PI - 1e-9)), M_PI - 1e-9, 1e-14);
  EXPECT_NEAR(AngleBetween(base_, Turned(M_PI + 0.5)), M_PI - 0.5, 1e-14);
}

}  // namespace
}  // namespace quatro::rigid3_test
