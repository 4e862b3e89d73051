// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/verdict/contact_covariance.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "features/base/random.h"
#include "tests/support/described_clouds.h"

namespace quatro::contact_covariance_test {
namespace {

constexpr double kVoxelSize = 0.3;

// Points of a hall of 30 x 20 x 6 m with their normals. Without `has_ends`, no
// surface faces x.
struct Hall {
  Points points;
  Points normals;
};

Hall MakeHall(bool has_ends, double noise, std::uint64_t seed) {
  Random random(seed);
  constexpr Eigen::Index kNum = 6000;
  Hall hall{Points(3, kNum), Points(3, kNum)};
  const Eigen::Array3d half_size(15.0, 10.0, 3.0);
  for (Eigen::Index i = 0; i < kNum; ++i) {
    const int axis = static_cast<int>(i % 3);
    const int wall = has_ends || axis > 0 ? axis : 1;
    Eigen::Array3d point;
    for (double& x : point) x = 2.0 * random.Uniform() - 1.0;
    point *= half_size;
    point[wall] = std::copysign(half_size[wall], point[wall]);
    point[wall] += noise * random.Normal();
    hall.points.col(i) = point.matrix();
    hall.normals.col(i) = Eigen::Vector3d::Unit(wall);
  }
  return hall;
}

std::optional<ContactCovariance> Measure(const Hall& source,
                                         const Hall& target,
                                         const Rigid3& pose,
                                         double scale = 1.0) {
  const DescribedCloud a =
      MakeDescribedCloud(scale * source.points, source.normals);
  const DescribedCloud b =
      MakeDescribedCloud(scale * target.points, target.normals);
  const Rigid3 scaled{pose.rotation, scale * pose.translation};
  return MeasureContactCovariance(
      a,
      b,
      scaled,
      FindMutualContacts(a, b, scaled, scale * 5.0 / 3.0 * kVoxelSize, 1),
      scale * kVoxelSize);
}

Hall Moved(const Rigid3& motion, const Hall& hall) {
  return {motion.Apply(hall.points), motion.rotation * hall.normals};
}

// The largest ratio of variances in any direction, either way.
double LargestRatio(const Matrix6& a, const Matrix6& b) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix6> solver(a, b);
  return std::max(solver.eigenvalues().maxCoeff(),
                  1.0 / solver.eigenvalues().minCoeff());
}

Matrix6 Turned(const Eigen::Matrix3d& rotation, const Matrix6& covariance) {
  Matrix6 turn = Matrix6::Zero();
  turn.topLeftCorner<3, 3>() = rotation;
  turn.bottomRightCorner<3, 3>() = rotation;
  return turn * covariance * turn.transpose();
}

class ContactCovarianceTest : public ::testing::Test {
 protected:
  const Hall source_ = MakeHall(true, 0.02, 1);
  const Hall target_ = MakeHall(true, 0.02, 2);
  const Rigid3 identity_ = Rigid3();
};

TEST_F(ContactCovarianceTest, IsPositiveAndSmall) {
  const auto measured = Measure(source_, target_, identity_);
  ASSERT_TRUE(measured);
  const Eigen::SelfAdjointEigenSolver<Matrix6> solver(
      measured->covariance_at_center);
  EXPECT_GT(solver.eigenvalues().minCoeff(), 0.0);
  EXPECT_LT(std::sqrt(solver.eigenvalues().maxCoeff()), 0.01);
}

// A pose beside the surfaces is as uncertain as it is far from them.
TEST_F(ContactCovarianceTest, ContainsTheWayToTheSurfaces) {
  const Eigen::Vector3d off(0.1, -0.05, 0.06);
  const auto measured =
      Measure(source_, target_, {Eigen::Matrix3d::Identity(), off});
  ASSERT_TRUE(measured);
  EXPECT_LT((measured->step.tail<3>() + off).norm(), 0.02);
  const Eigen::Matrix3d P =
      measured->covariance_at_center.bottomRightCorner<3, 3>();
  const double distance = std::sqrt(off.dot(P.ldlt().solve(off)));
  EXPECT_LT(distance, 1.0);
  EXPECT_GT(distance, 0.5);
}

TEST_F(ContactCovarianceTest, GrowsWithTheNoise) {
  const auto measured = Measure(source_, target_, identity_);
  const auto noisy =
      Measure(MakeHall(true, 0.06, 1), MakeHall(true, 0.06, 2), identity_);
  ASSERT_TRUE(measured && noisy);
  EXPECT_GT(noisy->covariance_at_center.trace(),
            3.0 * measured->covariance_at_center.trace());
}

TEST_F(ContactCovarianceTest, ScalesWithTheUnitOfLength) {
  const auto meters = Measure(source_, target_, identity_);
  const auto scaled = Measure(source_, target_, identity_, 1024.0);
  ASSERT_TRUE(meters && scaled);
  Vector6 units;
  units << 1.0, 1.0, 1.0, 1024.0, 1024.0, 1024.0;
  const Matrix6 expected =
      units.asDiagonal() * meters->covariance_at_center * units.asDiagonal();
  EXPECT_NEAR(LargestRatio(scaled->covariance_at_center, expected), 1.0, 1e-6);
}

// Patches depend on the axes, so the invariances hold up to a factor.
TEST_F(ContactCovarianceTest, TurnsWithTheFrames) {
  const Rigid3 motion{RotationZ(0.7), {100.0, -50.0, 3.0}};
  const auto measured = Measure(source_, target_, identity_);
  const auto turned = Measure(source_, Moved(motion, target_), motion);
  ASSERT_TRUE(measured && turned);
  EXPECT_LT((turned->center - motion * measured->center).norm(), 1e-6);
  EXPECT_LT(
      LargestRatio(turned->covariance_at_center,
                   Turned(motion.rotation, measured->covariance_at_center)),
      2.0);
}

TEST_F(ContactCovarianceTest, IsTheSameForTheSwappedPair) {
  const Rigid3 motion{RotationZ(0.7), {4.0, -5.0, 1.0}};
  const Hall target = Moved(motion, target_);
  const auto forward = Measure(source_, target, motion);
  const auto backward = Measure(target, source_, Inverse(motion));
  ASSERT_TRUE(forward && backward);
  EXPECT_LT((forward->center - motion * backward->center).norm(), 1e-6);
  EXPECT_LT(
      LargestRatio(forward->covariance_at_center,
                   Turned(motion.rotation, backward->covariance_at_center)),
      2.0);
}

TEST_F(ContactCovarianceTest, NeedsSurfacesThatConstrainAllDirections) {
  EXPECT_FALSE(
      Measure(MakeHall(false, 0.02, 1), MakeHall(false, 0.02, 2), identity_));
  EXPECT_FALSE(Measure(
      source_, target_, {Eigen::Matrix3d::Identity(), {500.0, 0.0, 0.0}}));
}

}  // namespace
}  // namespace quatro::contact_covariance_test
