// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/normals.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "features/base/degree.h"
#include "tests/support/random_problems.h"

namespace quatro::normals_test {
namespace {

constexpr double kRadius = 0.8;  // [m]
Points Normals(const Points& points,
               double radius,
               const Eigen::Vector3d& viewpoint) {
  return EstimateNormals(points,
                         FindNeighborhoods(KdTree(points), radius, 1),
                         radius,
                         viewpoint,
                         1);
}

// The largest angle [rad] between two sets of directions, sign included. Pi if
// one of them is zero.
double LargestAngle(const Points& a, const Points& b) {
  double largest = 0.0;
  for (Eigen::Index i = 0; i < a.cols(); ++i) {
    const Eigen::Vector3d u = a.col(i);
    const Eigen::Vector3d v = b.col(i);
    if (u.isZero(0.0) || v.isZero(0.0)) return M_PI;
    largest = std::max(largest, std::atan2(u.cross(v).norm(), u.dot(v)));
  }
  return largest;
}

TEST(EstimateNormals, OfAPlaneArePerpendicularToIt) {
  const Surface plane = RandomPlane(2000, 10.0, 1);
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    const Eigen::Matrix3d rotation = RandomRotation(seed);
    const Points normals = Normals(
        rotation * plane.points, kRadius, rotation * Eigen::Vector3d(1, 2, 3));
    EXPECT_LT(LargestAngle(normals, rotation * plane.normals), 1e-6)
        << "seed " << seed;
  }
}

TEST(EstimateNormals, OfASphereSeenFromItsCenterPointInwards) {
  const Surface sphere = RandomSphere(20000, 5.0, 1);
  const Points normals = Normals(sphere.points, kRadius, {0.0, 0.0, 0.0});
  EXPECT_LT(LargestAngle(normals, -sphere.normals), 2.0 * kDegree);
}

TEST(EstimateNormals, OfACylinderSeenFromItsAxisPointInwards) {
  // Away from the edges, where all neighbors are on one side.
  const Surface cylinder = RandomCylinder(20000, 5.0, 10.0, 1);
  const Points normals = Normals(cylinder.points, kRadius, {0.0, 0.0, 5.0});
  double largest = 0.0;
  int num_inside = 0;
  for (Eigen::Index i = 0; i < normals.cols(); ++i) {
    if (std::abs(cylinder.points(2, i) - 5.0) > 4.0) continue;
    largest = std::max(largest,
                       LargestAngle(normals.col(i), -cylinder.normals.col(i)));
    ++num_inside;
  }
  EXPECT_GT(num_inside, 10000);
  EXPECT_LT(largest, 2.0 * kDegree);
}

TEST(EstimateNormals, MinimizeTheSpread) {
  // The header's definition by the singular values of the centered points.
  const Points points = RandomStreet(3000, 0.03, 1);
  const KdTree tree(points);
  const Points normals = Normals(points, kRadius, {0.0, 0.0, 0.0});
  int num_checked = 0;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const auto ball = tree.WithinRadius(points.col(i), kRadius);
    if (ball.size() < 4) continue;
    Points around(3, static_cast<Eigen::Index>(ball.size()));
    for (Eigen::Index j = 0; j < around.cols(); ++j) {
      around.col(j) = points.col(ball[static_cast<std::size_t>(j)].index);
    }
    around.colwise() -= around.rowwise().mean().eval();
    const Eigen::Vector3d singular =
        Eigen::JacobiSVD<Eigen::MatrixXd>(around).singularValues();
    const double least = singular[2] * singular[2];
    const double spread = (normals.col(i).transpose() * around).squaredNorm();
    ASSERT_NEAR(spread, least, 1e-6 * singular[0] * singular[0])
        << "point " << i << " of " << ball.size() << " neighbours";
    ASSERT_NEAR(normals.col(i).norm(), 1.0, 1e-12);
    ++num_checked;
  }
  EXPECT_GT(num_checked, 2000);
}

TEST(EstimateNormals, OfANarrowStripArePerpendicularToIt) {
  // Like neighboring rings of a scanner on the ground.
  for (const double width : {0.5, 0.1, 0.02, 0.01}) {
    Surface strip = RandomPlane(500, 1.0, 1);
    strip.points.row(1) *= width;
    for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
      const Eigen::Matrix3d rotation = RandomRotation(seed);
      const Points normals = Normals(rotation * strip.points,
                                     kRadius,
                                     rotation * Eigen::Vector3d(0, 0, 3));
      EXPECT_LT(LargestAngle(normals, rotation * strip.normals), 0.1 * kDegree)
          << width << " m wide, seed " << seed;
    }
  }
}

TEST(EstimateNormals, AreTurnedTowardsTheViewpoint) {
  const Points points = RandomStreet(3000, 0.03, 1);
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Eigen::Vector3d viewpoint = RandomPoints(1, 20.0, seed);
    const Points normals = Normals(points, kRadius, viewpoint);
    const Points to_viewpoint = (-points).colwise() + viewpoint;
    EXPECT_GE(normals.cwiseProduct(to_viewpoint).colwise().sum().minCoeff(),
              0.0)
        << "seed " << seed;
  }
}

TEST(EstimateNormals, FlipWhenSeenFromTheOtherSide) {
  const Surface plane = RandomPlane(500, 5.0, 1);
  EXPECT_EQ(Normals(plane.points, kRadius, {0.0, 0.0, 9.0}),
            -Normals(plane.points, kRadius, {0.0, 0.0, -9.0}));
}

TEST(EstimateNormals, TurnWithTheCloudAndTheViewpoint) {
  const Points points = RandomStreet(3000, 0.03, 1);
  const Neighborhoods neighborhoods =
      FindNeighborhoods(KdTree(points), kRadius, 1);
  const Eigen::Vector3d viewpoint(0.5, -0.3, 0.2);
  const Points normals =
      EstimateNormals(points, neighborhoods, kRadius, viewpoint, 1);
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Eigen::Matrix3d rotation = RandomRotation(seed);
    const Eigen::Vector3d translation = RandomPoints(1, 50.0, seed);
    const Points turned =
        EstimateNormals((rotation * points).colwise() + translation,
                        neighborhoods,
                        kRadius,
                        rotation * viewpoint + translation,
                        1);
    int num_compared = 0;
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
      const Eigen::Vector3d expected = rotation * normals.col(i);
      EXPECT_EQ(turned.col(i).isZero(0.0), expected.isZero(0.0));
      // Seen edge on, the side is a matter of rounding.
      const Eigen::Vector3d ray = (viewpoint - points.col(i)).normalized();
      if (std::abs(normals.col(i).dot(ray)) < 1e-3) continue;
      ASSERT_LT(LargestAngle(turned.col(i), expected), 1e-4) << "point " << i;
      ++num_compared;
    }
    EXPECT_GT(num_compared, 2500);
  }
}

TEST(EstimateNormals, RadiusMayBeSmallerThanTheNeighborhoods) {
  const Points points = RandomStreet(3000, 0.03, 1);
  const KdTree tree(points);
  const Eigen::Vector3d viewpoint = Eigen::Vector3d::Zero();
  const Neighborhoods wide = FindNeighborhoods(tree, 2.0, 1);
  EXPECT_EQ(EstimateNormals(points, wide, 0.5, viewpoint, 1),
            Normals(points, 0.5, viewpoint));
  EXPECT_NE(EstimateNormals(points, wide, 2.0, viewpoint, 1),
            Normals(points, 0.5, viewpoint));
}

TEST(EstimateNormals, FarFromTheOriginAreTheSame) {
  // At 1e7 m a coordinate has a resolution of 2e-9 m.
  const Points points = RandomStreet(2000, 0.03, 1);
  const Neighborhoods neighborhoods =
      FindNeighborhoods(KdTree(points), kRadius, 1);
  const Eigen::Vector3d offset(1e7, -1e7, 1e7);
  const Eigen::Vector3d viewpoint(0.0, 0.0, 100.0);
  const Points near =
      EstimateNormals(points, neighborhoods, kRadius, viewpoint, 1);
  const Points far = EstimateNormals(
      points.colwise() + offset, neighborhoods, kRadius, viewpoint + offset, 1);
  int num_compared = 0;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    // Seen edge on, the side is a matter of rounding.
    if (std::abs(near(2, i)) < 0.2) continue;
    ASSERT_LT(LargestAngle(near.col(i), far.col(i)), 1e-4) << "point " << i;
    ++num_compared;
  }
  EXPECT_GT(num_compared, 1000);
}

TEST(EstimateNormals, AreZeroForFewerThanThreePoints) {
  // One isolated point, two together, three together.
  const Points points{
      {0, 10, 10, 20, 20, 20.1}, {0, 0, 0.1, 0, 0.1, 0}, {0, 0, 0, 0, 0, 0}};
  const Points normals = Normals(points, 1.0, {0.0, 0.0, 5.0});
  EXPECT_TRUE(normals.leftCols<3>().isZero(0.0)) << normals;
  EXPECT_LT(LargestAngle(normals.rightCols<3>(),
                         Eigen::Vector3d::UnitZ().replicate<1, 3>()),
            1e-6)
      << normals;
  EXPECT_EQ(Normals(Points(3, 0), 1.0, {0.0, 0.0, 0.0}).cols(), 0);
}

TEST(EstimateNormals, AreZeroOnALine) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    const Eigen::Vector3d direction = RandomDirection(seed);
    const Eigen::RowVectorXd along = RandomPoints(100, 1.0, seed).row(0);
    for (const double offset : {0.0, 100.0, 1e7}) {
      const Points line = (direction * along).array() + offset;
      EXPECT_TRUE(Normals(line, 1.0, {0.0, 0.0, 0.0}).isZero(0.0))
          << "seed " << seed << ", " << offset << " m away";
    }
  }
}

TEST(EstimateNormals, AreZeroForCoincidentPoints) {
  const Points points = Eigen::Vector3d(1.0, 2.0, 3.0).replicate(1, 20);
  EXPECT_TRUE(Normals(points, 1.0, {0.0, 0.0, 0.0}).isZero(0.0));
}

TEST(EstimateNormals, DoNotDependOnTheNumberOfThreads) {
  const Points points = RandomStreet(3000, 0.03, 1);
  const Neighborhoods neighborhoods =
      FindNeighborhoods(KdTree(points), kRadius, 1);
  const auto with_threads = [&](int num_threads) {
    return EstimateNormals(
        points, neighborhoods, kRadius, Eigen::Vector3d::Zero(), num_threads);
  };
  const Points one = with_threads(1);
  for (const int num_threads : {0, 2, 3}) {
    EXPECT_EQ(with_threads(num_threads), one) << num_threads << " threads";
  }
}

}  // namespace
}  // namespace quatro::normals_test
