// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/segments.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "features/base/rigid3.h"
#include "tests/support/random_problems.h"

namespace quatro::segments_test {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr double kVoxel = 0.3;

// Appends points and their normals.
void Append(const Surface& part, Surface* all) {
  const Eigen::Index n = all->points.cols();
  all->points.conservativeResize(3, n + part.points.cols());
  all->normals.conservativeResize(3, n + part.points.cols());
  all->points.rightCols(part.points.cols()) = part.points;
  all->normals.rightCols(part.points.cols()) = part.normals;
}

// A wall on a grid of voxels from `begin` along `direction`, from z = -1.5 m.
Surface MakeWall(const Eigen::Vector2d& begin,
                 const Eigen::Vector2d& direction,
                 double length,
                 double height,
                 const Eigen::Vector2d& normal) {
  Surface wall;
  std::vector<Eigen::Vector3d> points;
  for (double a = 0.0; a <= length; a += kVoxel) {
    for (double z = 0.0; z <= height; z += kVoxel) {
      const Eigen::Vector2d xy = begin + a * direction;
      points.emplace_back(xy.x(), xy.y(), z - 1.5);
    }
  }
  const auto n = static_cast<Eigen::Index>(points.size());
  wall.points.resize(3, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    wall.points.col(i) = points[static_cast<std::size_t>(i)];
  }
  wall.normals = Eigen::Vector3d(normal.x(), normal.y(), 0.0).replicate(1, n);
  return wall;
}

// Two walls at a right angle, a pole, a cluster and the ground, seen from the
// origin.
Surface MakeScene() {
  Surface scene;
  Append(MakeWall({-10.0, 8.0}, {1.0, 0.0}, 12.0, 5.0, {0.0, -1.0}), &scene);
  Append(MakeWall({9.0, -6.0}, {0.0, 1.0}, 8.0, 4.0, {-1.0, 0.0}), &scene);
  for (const auto& [x, y, radius, height] :
       {std::array{-5.0, -4.0, 0.15, 4.0}, std::array{4.0, -9.0, 0.7, 1.6}}) {
    Surface post = RandomCylinder(60, radius, height, 3);
    post.points.colwise() += Eigen::Vector3d(x, y, -1.5);
    Append(post, &scene);
  }
  Surface ground = RandomPlane(4000, 30.0, 1);
  ground.points.row(2).setConstant(-1.5);
  Append(ground, &scene);
  return scene;
}

TEST(FindSegments, FindsWallsAPoleAndACluster) {
  const Surface scene = MakeScene();
  const Segments segments = FindSegments(scene.points, scene.normals, kVoxel);
  ASSERT_THAT(segments.walls, SizeIs(2));
  const Wall& first = segments.walls[0];
  EXPECT_NEAR(first.normal.y(), -1.0, 1e-9);
  EXPECT_NEAR(first.offset, -8.0, 1e-9);
  EXPECT_NEAR(first.length(), 12.0, kVoxel + 1e-9);
  EXPECT_NEAR(first.bottom, -1.5, kVoxel + 1e-9);
  EXPECT_NEAR(first.top, 3.5, 2 * kVoxel + 1e-9);
  // The tangent of (0, -1) is (1, 0).
  EXPECT_NEAR(first.begin, -10.0, 1e-9);
  const Wall& second = segments.walls[1];
  EXPECT_NEAR(second.normal.x(), -1.0, 1e-9);
  EXPECT_NEAR(second.offset, -9.0, 1e-9);
  EXPECT_NEAR(second.length(), 8.0, kVoxel + 1e-9);

  ASSERT_THAT(segments.posts, SizeIs(2));
  const Post& pole = segments.posts[0];
  EXPECT_TRUE(pole.is_pole);
  EXPECT_LT((pole.center - Eigen::Vector2d(-5.0, -4.0)).norm(), 0.05);
  EXPECT_NEAR(pole.height(), 4.0, 0.3);
  EXPECT_LE(pole.width, 0.3);
  const Post& cluster = segments.posts[1];
  EXPECT_FALSE(cluster.is_pole);
  EXPECT_LT((cluster.center - Eigen::Vector2d(4.0, -9.0)).norm(), 0.2);
}

// Gaps of more than ten voxels end a wall.
TEST(FindSegments, AGapDividesAWall) {
  for (const double gap : {2.4, 3.6}) {
    Surface scene;
    Append(MakeWall({-10.0, 8.0}, {1.0, 0.0}, 6.0, 4.0, {0.0, -1.0}), &scene);
    Append(MakeWall({-4.0 + gap, 8.0}, {1.0, 0.0}, 6.0, 4.0, {0.0, -1.0}),
           &scene);
    EXPECT_THAT(FindSegments(scene.points, scene.normals, kVoxel).walls,
                SizeIs(gap < 3.0 ? 1 : 2))
        << gap;
  }
}

TEST(FindSegments, AreOnlyThoseThatAreLongAndTall) {
  for (const auto& [length, height, num] : {std::array{2.4, 4.0, 0.0},
                                            std::array{6.0, 1.2, 0.0},
                                            std::array{6.0, 4.0, 1.0}}) {
    const Surface wall =
        MakeWall({-3.0, 8.0}, {1.0, 0.0}, length, height, {0.0, -1.0});
    EXPECT_THAT(FindSegments(wall.points, wall.normals, kVoxel).walls,
                SizeIs(static_cast<std::size_t>(num)))
        << length << " " << height;
  }
}

// Segments move with the points. Azimuths of 5 deg are not multiples of the
// rotation, so lengths may differ by the points at the ends.
TEST(FindSegments, MoveWithTheCloud) {
  const Surface scene = MakeScene();
  const Segments before = FindSegments(scene.points, scene.normals, kVoxel);
  for (const double yaw : {0.3, 1.234, -2.5}) {
    const Eigen::Matrix3d rotation = RotationZ(yaw);
    const Eigen::Vector3d shift(0.7, -1.9, 0.4);
    const Segments after =
        FindSegments((rotation * scene.points).colwise() + shift,
                     rotation * scene.normals,
                     kVoxel);
    ASSERT_EQ(after.walls.size(), before.walls.size()) << yaw;
    for (std::size_t k = 0; k < before.walls.size(); ++k) {
      const Eigen::Vector2d moved =
          rotation.topLeftCorner<2, 2>() * before.walls[k].normal;
      EXPECT_LT((after.walls[k].normal - moved).norm(), 1e-6) << yaw;
      EXPECT_NEAR(after.walls[k].offset,
                  before.walls[k].offset + moved.dot(shift.head<2>()),
                  1e-6);
      EXPECT_NEAR(after.walls[k].length(), before.walls[k].length(), 1e-6);
      EXPECT_NEAR(after.walls[k].bottom, before.walls[k].bottom + 0.4, 1e-9);
    }
    ASSERT_EQ(after.posts.size(), before.posts.size()) << yaw;
    for (std::size_t k = 0; k < before.posts.size(); ++k) {
      const Eigen::Vector2d moved =
          rotation.topLeftCorner<2, 2>() * before.posts[k].center +
          shift.head<2>();
      EXPECT_LT((after.posts[k].center - moved).norm(), 1e-6) << yaw;
    }
  }
}

TEST(FindSegments, TheOrderOfThePointsDoesNotMatter) {
  const Surface scene = MakeScene();
  const Segments before = FindSegments(scene.points, scene.normals, kVoxel);
  Surface shuffled = scene;
  const auto order = RandomPermutation(scene.points.cols(), 5);
  for (std::size_t k = 0; k < order.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    shuffled.points.col(column) = scene.points.col(order[k]);
    shuffled.normals.col(column) = scene.normals.col(order[k]);
  }
  const Segments after =
      FindSegments(shuffled.points, shuffled.normals, kVoxel);
  ASSERT_EQ(after.walls.size(), before.walls.size());
  for (std::size_t k = 0; k < before.walls.size(); ++k) {
    EXPECT_NEAR(after.walls[k].offset, before.walls[k].offset, 1e-9);
    EXPECT_NEAR(after.walls[k].begin, before.walls[k].begin, 1e-9);
  }
  ASSERT_EQ(after.posts.size(), before.posts.size());
  for (std::size_t k = 0; k < before.posts.size(); ++k) {
    EXPECT_LT((after.posts[k].center - before.posts[k].center).norm(), 1e-9);
  }
}

TEST(FindSegments, GroundAndUnknownNormalsAreNone) {
  Surface ground = RandomPlane(2000, 20.0, 1);
  const Segments of_ground =
      FindSegments(ground.points, ground.normals, kVoxel);
  EXPECT_THAT(of_ground.walls, IsEmpty());
  EXPECT_THAT(of_ground.posts, IsEmpty());
  Surface scene = MakeScene();
  scene.normals.setZero();
  const Segments unknown = FindSegments(scene.points, scene.normals, kVoxel);
  EXPECT_THAT(unknown.walls, IsEmpty());
  EXPECT_THAT(unknown.posts, IsEmpty());
  const Segments none = FindSegments(Points(3, 0), Points(3, 0), kVoxel);
  EXPECT_THAT(none.walls, IsEmpty());
}

}  // namespace
}  // namespace quatro::segments_test
