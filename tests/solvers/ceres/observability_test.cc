// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "solvers/ceres/observability.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "features/base/types.h"
#include "tests/support/random_problems.h"

namespace quatro::observability_test {
namespace {

using ::testing::HasSubstr;

// The information, about `center`, of points that are constrained only along
// their normals.
Matrix6 SurfaceInformation(const Surface& surface,
                           const Eigen::Vector3d& center) {
  Matrix6 information = Matrix6::Zero();
  for (Eigen::Index i = 0; i < surface.points.cols(); ++i) {
    const Eigen::Vector3d x = surface.points.col(i) - center;
    const Eigen::Vector3d n = surface.normals.col(i);
    Vector6 a;
    a << x.cross(n), n;
    information += a * a.transpose();
  }
  return information;
}

std::vector<DirectionInformation> UnobservableOn(
    const Surface& surface, const Eigen::Vector3d& center) {
  std::vector<DirectionInformation> unobservable;
  const double floor = 1e-9 * static_cast<double>(surface.points.cols());
  for (const auto& direction :
       SplitInformation(SurfaceInformation(surface, center), center, floor)) {
    if (direction.information < floor) unobservable.push_back(direction);
  }
  return unobservable;
}

double DistanceFromAxis(const Eigen::Vector3d& point,
                        const Eigen::Vector3d& on_axis,
                        const Eigen::Vector3d& axis) {
  return axis.cross(point - on_axis).norm();
}

TEST(SplitInformation, APlaneHoldsNoPositionInItAndNoTurnAboutItsNormal) {
  const Eigen::Matrix3d R = RandomRotation(1);
  Surface plane = RandomPlane(100, 10.0, 1);
  plane.points = (R * plane.points).colwise() + Eigen::Vector3d(3.0, 1.0, 2.0);
  plane.normals = R * plane.normals;
  const auto unobservable = UnobservableOn(plane, {3.5, 1.0, 2.0});
  ASSERT_EQ(unobservable.size(), 3u);
  const Eigen::Vector3d normal = R.col(2);
  for (const int i : {0, 1}) {
    EXPECT_EQ(unobservable[i].freedom, Freedom::kTranslation);
    EXPECT_NEAR(unobservable[i].axis.dot(normal), 0.0, 1e-9);
  }
  EXPECT_EQ(unobservable[2].freedom, Freedom::kRotation);
  EXPECT_NEAR(std::abs(unobservable[2].axis.dot(normal)), 1.0, 1e-9);
}

TEST(SplitInformation, ACylinderTurnsAndSlidesAlongItsOwnAxis) {
  const Eigen::Matrix3d R = RandomRotation(2);
  const Eigen::Vector3d foot(5.0, -4.0, 1.0);
  Surface cylinder = RandomCylinder(200, 0.5, 4.0, 2);
  cylinder.points = (R * cylinder.points).colwise() + foot;
  cylinder.normals = R * cylinder.normals;
  // The center is not on the axis.
  const auto unobservable =
      UnobservableOn(cylinder, foot + Eigen::Vector3d(1.0, 2.0, 3));
  ASSERT_EQ(unobservable.size(), 2u);
  EXPECT_EQ(unobservable[0].freedom, Freedom::kTranslation);
  EXPECT_NEAR(std::abs(unobservable[0].axis.dot(R.col(2))), 1.0, 1e-9);
  EXPECT_EQ(unobservable[1].freedom, Freedom::kRotation);
  EXPECT_NEAR(std::abs(unobservable[1].axis.dot(R.col(2))), 1.0, 1e-9);
  EXPECT_LT(DistanceFromAxis(unobservable[1].point, foot, R.col(2)), 1e-6);
}

TEST(SplitInformation, ASphereTurnsAboutItsMiddle) {
  const Eigen::Vector3d middle(2.0, -3.0, 4.0);
  Surface sphere = RandomSphere(200, 2.0, 3);
  sphere.points.colwise() += middle;
  const auto unobservable = UnobservableOn(sphere, {2.5, -3.0, 3.0});
  ASSERT_EQ(unobservable.size(), 3u);
  for (const DirectionInformation& direction : unobservable) {
    EXPECT_EQ(direction.freedom, Freedom::kRotation);
    EXPECT_LT(DistanceFromAxis(middle, direction.point, direction.axis), 1e-6);
  }
}

// The determinant is the oracle: it is the product of all six eigenvalues.
TEST(SplitInformation, IsABlockDecomposition) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    const Matrix6 root =
        Matrix6::NullaryExpr([&] { return RandomNormal(random); });
    const Matrix6 information = root * root.transpose();
    double product = 1.0;
    const auto directions =
        SplitInformation(information, Eigen::Vector3d::Zero(), 0.0);
    for (const auto& direction : directions) product *= direction.information;
    EXPECT_NEAR(product / information.determinant(), 1.0, 1e-6) << seed;
    // The information of a rotation is the inverse of its variance.
    const Matrix6 covariance = information.inverse();
    const Eigen::Vector3d w = directions[3].axis;
    EXPECT_NEAR(
        w.dot(covariance.topLeftCorner<3, 3>() * w) * directions[3].information,
        1.0,
        1e-6);
  }
}

TEST(UnobservableDirection, SaysWhichAndWhy) {
  UnobservableDirection direction;
  direction.freedom = Freedom::kTranslation;
  direction.reason = UnobservableReason::kNoSurface;
  direction.axis = {0.94, 0.342, -1e-9};
  EXPECT_EQ(direction.Describe(),
            "position along the axis (0.94, 0.34, 0.00): no surface "
            "constrains it");
  direction.reason = UnobservableReason::kUncertain;
  direction.standard_deviation = 0.5;
  EXPECT_THAT(direction.Describe(), HasSubstr("standard deviation 0.5 m"));
  direction.freedom = Freedom::kRotation;
  direction.standard_deviation = M_PI / 180.0;
  direction.point = {12.34, -5.0, 0.0};
  EXPECT_EQ(direction.Describe(),
            "rotation about the axis (0.94, 0.34, 0.00) through (12.3, -5.0, "
            "0.0): standard deviation 1 deg");
  direction.reason = UnobservableReason::kAssumed;
  EXPECT_THAT(direction.Describe(),
              HasSubstr("not estimated, but assumed with"));
  direction.standard_deviation.reset();
  direction.reason = UnobservableReason::kNoData;
  EXPECT_THAT(direction.Describe(), HasSubstr("no inlier constrains it"));
  direction.reason = UnobservableReason::kWithinNoise;
  EXPECT_THAT(direction.Describe(), HasSubstr("by less than their noise"));
}

}  // namespace
}  // namespace quatro::observability_test
