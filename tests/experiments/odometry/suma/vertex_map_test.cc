// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/odometry/suma/vertex_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "features/base/rigid3.h"
#include "tests/support/random_problems.h"

namespace quatro::vertex_map_test {
namespace {

TEST(SphericalImageTest, RayOfAPixelIsInThatPixel) {
  const SphericalImage image;
  for (int v = 0; v < image.height; ++v) {
    for (int u = 0; u < image.width; ++u) {
      const Eigen::Vector3d ray = image.Ray(u, v);
      ASSERT_NEAR(ray.norm(), 1.0, 1e-12);
      ASSERT_EQ(image.Project(12.0 * ray), Eigen::Index{v} * image.width + u);
    }
  }
}

TEST(SphericalImageTest, OutsideThereIsNoPixel) {
  const SphericalImage image;
  EXPECT_EQ(image.Project(Eigen::Vector3d(0.0, 0.0, 0.0)), -1);
  EXPECT_EQ(image.Project(Eigen::Vector3d(0.0, 0.0, 5.0)), -1);
  EXPECT_EQ(image.Project(Eigen::Vector3d(10.0, 0.0, 10.0)), -1);
  EXPECT_EQ(image.Project(Eigen::Vector3d(10.0, 0.0, -10.0)), -1);
  EXPECT_GE(image.Project(Eigen::Vector3d(-10.0, 0.0, 0.0)), 0);
  EXPECT_GE(image.Project(Eigen::Vector3d(-10.0, -0.0, 0.0)), 0);
}

TEST(FitImageTest, HoldsTheBeamsInTheMiddleOfTheirRows) {
  // Four beams at 10, 0, -10 and -20 deg.
  Points points(3, 400);
  for (Eigen::Index i = 0; i < 400; ++i) {
    const double e = (10.0 - 10.0 * static_cast<double>(i % 4)) * M_PI / 180.0;
    const double a = 0.0157 * static_cast<double>(i);
    points.col(i) << 9.0 * std::cos(e) * std::cos(a),
        9.0 * std::cos(e) * std::sin(a), 9.0 * std::sin(e);
  }
  const auto image = FitImage(points, 32, 4);
  ASSERT_TRUE(image);
  for (Eigen::Index i = 0; i < 400; ++i) {
    ASSERT_EQ(image->Project(points.col(i)) / 32, i % 4);
  }
  EXPECT_FALSE(FitImage(Points(3, 0), 32, 4));
  EXPECT_FALSE(FitImage(Points::Ones(3, 9), 32, 4));
}

// A room of 16 x 16 m around the sensor, with the floor 2 m below it.
Eigen::Vector3d RoomAlong(const Eigen::Vector3d& ray) {
  double range = 8.0 / std::max(std::abs(ray.x()), std::abs(ray.y()));
  if (ray.z() < 0.0) range = std::min(range, -2.0 / ray.z());
  return range * ray;
}

Points Room(const SphericalImage& image) {
  Points points(3, image.size());
  for (int v = 0; v < image.height; ++v) {
    for (int u = 0; u < image.width; ++u) {
      points.col(Eigen::Index{v} * image.width + u) =
          RoomAlong(image.Ray(u, v));
    }
  }
  return points;
}

TEST(MakeVertexMapTest, NormalsAreThoseOfTheRoom) {
  const SphericalImage image;
  const VertexMap map = MakeVertexMap(Room(image), image, 1.0, 1);
  Eigen::Index num_right = 0;
  for (Eigen::Index i = 0; i < image.size(); ++i) {
    ASSERT_TRUE(map.HasVertex(i));
    if (!map.HasNormal(i)) continue;
    const Eigen::Vector3d p = map.vertices.col(i);
    const Eigen::Vector3d n = map.normals.col(i);
    ASSERT_NEAR(n.norm(), 1.0, 1e-12);
    ASSERT_LE(n.dot(p), 0.0);
    Eigen::Vector3d expected = Eigen::Vector3d::UnitZ();
    if (p.z() > -2.0 + 1e-9) {
      expected.setZero();
      const int axis = std::abs(p.x()) > std::abs(p.y()) ? 0 : 1;
      expected[axis] = p[axis] > 0.0 ? -1.0 : 1.0;
    }
    if (n.dot(expected) > 0.999) ++num_right;
  }
  // All windows except those at the corners.
  EXPECT_GT(num_right, image.size() * 9 / 10);
}

TEST(MakeVertexMapTest, NearestOfAPixelIsKeptAndTheOrderDoesNotMatter) {
  const SphericalImage image;
  const Eigen::Vector3d ray = image.Ray(100, 30);
  Points points(3, 3);
  points << 9.0 * ray, 5.0 * ray, 0.5 * ray;
  const VertexMap map = MakeVertexMap(points, image, 1.0, 1);
  EXPECT_EQ(map.vertices.col(30 * image.width + 100), 5.0 * ray);
  const VertexMap other =
      MakeVertexMap(points.rowwise().reverse(), image, 1.0, 1);
  EXPECT_EQ(map.vertices, other.vertices);
}

TEST(MakeVertexMapTest, ThreadsDoNotMatterBitForBit) {
  const SphericalImage image;
  const Points points = Room(image) + RandomPoints(image.size(), 0.02, 4);
  const VertexMap one = MakeVertexMap(points, image, 1.0, 1);
  const VertexMap four = MakeVertexMap(points, image, 1.0, 4);
  EXPECT_EQ(one.normals, four.normals);
  EXPECT_EQ(one.vertices, four.vertices);
}

// A rotation about z by whole pixels shifts the image, also across the seam.
TEST(MakeVertexMapTest, TurnsWithTheScan) {
  const SphericalImage image;
  const Points points = Room(image);
  const int shift = 37;
  const Eigen::Matrix3d turn = RotationZ(-shift * image.PixelWidth());
  const VertexMap map = MakeVertexMap(points, image, 1.0, 1);
  const VertexMap turned = MakeVertexMap(turn * points, image, 1.0, 1);
  for (int v = 0; v < image.height; ++v) {
    for (int u = 0; u < image.width; ++u) {
      const Eigen::Index from = Eigen::Index{v} * image.width + u;
      const Eigen::Index to =
          Eigen::Index{v} * image.width + (u + shift) % image.width;
      ASSERT_LT((turned.normals.col(to) - turn * map.normals.col(from)).norm(),
                1e-6)
          << u << " " << v;
    }
  }
}

TEST(SphericalImageTest, ErrorNamesTheField) {
  std::string error;
  SphericalImage image;
  image.width = 3;
  EXPECT_FALSE(image.IsValid(&error));
  EXPECT_THAT(error, ::testing::HasSubstr("width, height = 3, 64"));
  image = {};
  image.bottom = 0.1;
  EXPECT_FALSE(image.IsValid(&error));
  EXPECT_THAT(error, ::testing::HasSubstr("top, bottom = 0.05, 0.1"));
}

}  // namespace
}  // namespace quatro::vertex_map_test
