// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/registration/vertical.h"

#include <gtest/gtest.h>

#include <cmath>

#include "solvers/closed_form/gravity.h"
#include "tests/support/described_clouds.h"
#include "tests/support/random_problems.h"

namespace quatro::vertical_test {
namespace {

const Eigen::Vector3d kUp = Eigen::Vector3d::UnitZ();

double Uniform(double low, double high, Random* random) {
  return low + (high - low) * random->Uniform();
}

// `num` normals: three of ten of a ground that is inclined, the others
// horizontal up to `sigma`, with azimuths within `spread` [rad].
DescribedCloud MakeCloud(Eigen::Index num,
                         double sigma,
                         double spread,
                         std::uint64_t seed) {
  Random random(seed);
  Points normals(3, num);
  for (Eigen::Index i = 0; i < num; ++i) {
    if (i % 10 < 3) {
      normals.col(i) = Eigen::Vector3d(0.15, 0.0, 1.0).normalized();
      continue;
    }
    const double azimuth = Uniform(0.0, spread, &random);
    normals.col(i) =
        Eigen::Vector3d(
            std::cos(azimuth), std::sin(azimuth), sigma * RandomNormal(random))
            .normalized();
  }
  return MakeDescribedCloud(RandomPoints(num, 10.0, seed), normals);
}

DescribedCloud Turned(const DescribedCloud& cloud,
                      const Eigen::Matrix3d& rotation) {
  return MakeDescribedCloud(rotation * cloud.points(),
                            rotation * cloud.normals);
}

TEST(EstimateVertical, IsTheOneOfTheWallsNotOfTheGround) {
  const auto up = EstimateVertical(MakeCloud(2000, 0.05, 6.28, 1), kUp);
  ASSERT_TRUE(up);
  EXPECT_NEAR(up->norm(), 1.0, 1e-12);
  EXPECT_LT((*up - kUp).norm(), 0.01);
}

TEST(EstimateVertical, TurnsWithTheCloud) {
  const DescribedCloud cloud = MakeCloud(2000, 0.05, 2.0, 2);
  const auto up = EstimateVertical(cloud, kUp);
  ASSERT_TRUE(up);
  for (const double tilt : {0.05, 0.15, 0.3}) {
    const Eigen::Matrix3d rotation = LevelFromBody(tilt, -0.5 * tilt);
    const auto turned = EstimateVertical(Turned(cloud, rotation), kUp);
    ASSERT_TRUE(turned);
    EXPECT_LT((*turned - rotation * *up).norm(), 1e-4) << tilt;
  }
}

TEST(EstimateVertical, PointsAsTheGuess) {
  const DescribedCloud cloud = MakeCloud(2000, 0.05, 6.28, 3);
  const auto up = EstimateVertical(cloud, kUp);
  const auto down = EstimateVertical(cloud, -kUp);
  ASSERT_TRUE(up && down);
  EXPECT_LT((*up + *down).norm(), 1e-6);
}

TEST(EstimateVertical, OneWallIsNotEnough) {
  EXPECT_FALSE(EstimateVertical(MakeCloud(2000, 0.02, 0.05, 4), kUp));
}

TEST(EstimateVertical, FewNormalsAreNotEnough) {
  EXPECT_FALSE(EstimateVertical(MakeCloud(60, 0.02, 6.28, 5), kUp));
  EXPECT_TRUE(EstimateVertical(MakeCloud(80, 0.02, 6.28, 5), kUp));
  EXPECT_FALSE(
      EstimateVertical(MakeDescribedCloud(Points(3, 0), Points(3, 0)), kUp));
}

}  // namespace
}  // namespace quatro::vertical_test
