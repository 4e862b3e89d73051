// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The targets of odometry matching: voxels, surfels, lines and planes of a map,
// and those of the previous scan.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "experiments/odometry/aloam/scan_to_map.h"
#include "experiments/odometry/aloam/scan_to_scan.h"
#include "experiments/odometry/aloam/voxel_map.h"
#include "experiments/odometry/suma/surfel_map.h"
#include "tests/support/random_problems.h"

namespace quatro::odometry_maps_test {
namespace {

TEST(VoxelMapTest, HoldsTheMeanOfEachVoxelAndForgetsFarOnes) {
  VoxelMap map(1.0);
  Points points(3, 3);
  points << 0.25, 0.75, -0.5,  //
      0.5, 0.5, 0.5,           //
      0.5, 0.5, 0.5;
  map.Insert(points.leftCols(1));
  map.Insert(points.rightCols(2));
  ASSERT_EQ(map.size(), 2);
  EXPECT_EQ(map.Means().col(0), points.col(2));
  EXPECT_EQ(map.Means().col(1), Eigen::Vector3d(0.5, 0.5, 0.5));
  map.Crop(Eigen::Vector3d(0.5, 0.5, 0.5), 0.9);
  EXPECT_EQ(map.size(), 1);
}

// Five points along a line, and then five points in a plane across it.
TEST(FitTest, LineAndPlaneOfTheFiveNearest) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Eigen::Matrix3d turn = RandomRotation(seed);
    Points along(3, 5), across(3, 5);
    along << -0.4, -0.2, 0.0, 0.2, 0.4,  //
        0.01, -0.01, 0.0, -0.01, 0.01,   //
        0.0, 0.01, -0.01, 0.0, 0.01;
    across << -0.3, 0.3, 0.3, -0.3, 0.0,  //
        -0.3, -0.3, 0.3, 0.3, 0.0,        //
        0.01, -0.01, 0.01, -0.01, 0.0;
    const Eigen::Vector3d source(7.0, 8.0, 9.0);
    const Eigen::Vector3d query = turn * Eigen::Vector3d(0.0, 0.1, 0.1);
    const KdTree line_map(turn * along), plane_map(turn * across);

    const auto line = FitLine(line_map, source, query, 1.0);
    ASSERT_TRUE(line);
    EXPECT_EQ(line->source, source);
    EXPECT_GT(std::abs(line->direction.dot(turn.col(0))), 0.999);
    // Not a plane: its normal would be determined by noise.
    EXPECT_FALSE(FitPlane(line_map, source, query, 1.0));

    const auto plane = FitPlane(plane_map, source, query, 1.0);
    ASSERT_TRUE(plane);
    EXPECT_GT(std::abs(plane->direction.dot(turn.col(2))), 0.99);
    EXPECT_LT((plane->point - turn * across.rowwise().mean()).norm(), 1e-12);
    EXPECT_FALSE(FitLine(plane_map, source, query, 1.0));

    EXPECT_FALSE(FitLine(line_map, source, query, 0.3));
    EXPECT_FALSE(FitPlane(plane_map, source, query, 0.3));
  }
}

TEST(FitTest, NeitherOfABallOrOfTooFew) {
  Points ball(3, 5);
  ball << 0.3, -0.3, 0.0, 0.0, 0.0,  //
      0.0, 0.0, 0.3, -0.3, 0.0,      //
      0.1, 0.1, 0.1, 0.1, -0.35;
  const KdTree map(ball);
  const Eigen::Vector3d query = Eigen::Vector3d::Zero();
  EXPECT_FALSE(FitLine(map, query, query, 1.0));
  EXPECT_FALSE(FitPlane(map, query, query, 1.0));
  EXPECT_FALSE(FitLine(KdTree(ball.leftCols(4)), query, query, 1.0));
  EXPECT_FALSE(FitPlane(KdTree(Points(3, 0)), query, query, 1.0));
}

// Three rings see a pole along z at x = 5 and a wall x = 8.
TEST(MatchToScanTest, LineAndPlaneAreOfMoreThanOneRing) {
  RingFeatures features;
  Points pole(3, 3), wall(3, 9);
  for (int r = 0; r < 3; ++r) {
    pole.col(r) << 5.0, 0.0, 0.3 * r;
    for (int i = 0; i < 3; ++i) wall.col(3 * r + i) << 8.0, 0.2 * i, 0.3 * r;
  }
  features.less_sharp = {pole, {0, 1, 2}};
  features.less_flat = {wall, {0, 0, 0, 1, 1, 1, 2, 2, 2}};
  features.sharp = {pole.col(1), {1}};
  features.flat = {wall.col(4), {1}};
  const ScanModel model(features);
  const Rigid3 shift{Eigen::Matrix3d::Identity(), {0.1, 0.02, 0.01}};
  const auto matches = MatchToScan(features, model, shift, 1.0, 1);
  ASSERT_EQ(matches.lines.size(), 1u);
  EXPECT_NEAR(std::abs(matches.lines[0].direction.z()), 1.0, 1e-12);
  EXPECT_EQ(matches.lines[0].source, Eigen::Vector3d(5.0, 0.0, 0.3));
  ASSERT_EQ(matches.planes.size(), 1u);
  EXPECT_NEAR(std::abs(matches.planes[0].direction.x()), 1.0, 1e-12);

  const Rigid3 far{Eigen::Matrix3d::Identity(), {2.0, 0.0, 0.0}};
  EXPECT_TRUE(MatchToScan(features, model, far, 1.0, 1).lines.empty());
  // One ring determines neither a line nor a plane.
  features.less_sharp.ring = {1, 1, 1};
  features.less_flat.ring.assign(9, 1);
  const auto none = MatchToScan(features, ScanModel(features), shift, 1.0, 1);
  EXPECT_TRUE(none.lines.empty());
  EXPECT_TRUE(none.planes.empty());
}

SphericalImage Image() {
  SphericalImage image;
  image.width = 360;
  image.height = 40;
  image.top = 0.3;
  image.bottom = -0.4;
  return image;
}

// A wall x = `distance` for |y| < distance.
VertexMap SeeWall(double distance) {
  const SphericalImage image = Image();
  std::vector<double> coordinates;
  for (int v = 0; v < image.height; ++v) {
    for (int u = 0; u < image.width; ++u) {
      const Eigen::Vector3d ray = image.Ray(u, v);
      if (ray.x() < std::abs(ray.y())) continue;
      const Eigen::Vector3d p = distance / ray.x() * ray;
      coordinates.insert(coordinates.end(), p.begin(), p.end());
    }
  }
  return MakeVertexMap(Eigen::Map<const Points>(
                           coordinates.data(),
                           3,
                           static_cast<Eigen::Index>(coordinates.size()) / 3),
                       image,
                       0.5,
                       1);
}

TEST(SurfelMapTest, RendersWhatItWasGiven) {
  const VertexMap scan = SeeWall(8.0);
  SurfelMap map{SurfelMapOptions{}};
  map.Update(scan, {});
  EXPECT_GT(map.surfels().size(), 2000u);
  const RenderedMap rendered = map.Render(Image(), {});
  for (Eigen::Index i = 0; i < scan.image.size(); ++i) {
    if (!scan.HasNormal(i)) continue;
    ASSERT_TRUE(rendered.view.HasNormal(i));
    EXPECT_LT((rendered.view.vertices.col(i) - scan.vertices.col(i)).norm(),
              1e-6);
    EXPECT_LT((rendered.view.normals.col(i) - scan.normals.col(i)).norm(),
              1e-6);
  }
}

TEST(SurfelMapTest, IsSeenFromElsewhereWithoutHoles) {
  SurfelMap map{SurfelMapOptions{}};
  map.Update(SeeWall(8.0), {});
  const Rigid3 ahead{RotationZ(0.2), Eigen::Vector3d(2.0, 1.0, 0.1)};
  const RenderedMap rendered = map.Render(Image(), ahead);
  // The center of the wall as seen from there: all pixels are on it.
  int num_seen = 0;
  for (int v = 10; v < 30; ++v) {
    for (int u = 170; u < 200; ++u) {
      const Eigen::Index i = Eigen::Index{v} * 360 + u;
      ASSERT_TRUE(rendered.view.HasVertex(i)) << u << " " << v;
      EXPECT_NEAR((ahead * Eigen::Vector3d(rendered.view.vertices.col(i))).x(),
                  8.0,
                  1e-6);
      ++num_seen;
    }
  }
  EXPECT_EQ(num_seen, 600);
  // Also not from behind.
  const Rigid3 behind{RotationZ(M_PI), Eigen::Vector3d(16.0, 0.0, 0.0)};
  EXPECT_TRUE(map.Render(Image(), behind).view.vertices.isZero(0.0));
}

TEST(SurfelMapTest, AgreementConfirmsAndSmoothes) {
  SurfelMap map{SurfelMapOptions{}};
  map.Update(SeeWall(8.0), {});
  const std::size_t before = map.surfels().size();
  map.Update(SeeWall(8.1), {});
  // Hardly anything is new, and consistent points have moved by a tenth, except
  // at the rim of the wall, where normals come from half a window.
  EXPECT_LT(map.surfels().size(), before * 11 / 10);
  std::size_t num_confirmed = 0;
  double moved = 0.0;
  for (const Surfel& surfel : map.surfels()) {
    if (surfel.created != 0 || surfel.log_odds <= 0.0) continue;
    ++num_confirmed;
    moved += surfel.position.x() - 8.0;
    EXPECT_GT(surfel.position.x(), 8.0);
    EXPECT_LT(surfel.position.x(), 8.1);
  }
  EXPECT_NEAR(moved / static_cast<double>(num_confirmed), 0.01, 0.001);
  EXPECT_GT(num_confirmed, before * 8 / 10);
}

TEST(SurfelMapTest, WhatIsSeenOnceIsForgotten) {
  SurfelMapOptions options;
  SurfelMap map(options);
  map.Update(SeeWall(8.0), {});
  for (int i = 0; i <= options.confirm_within; ++i)
    map.Update(SeeWall(20.0), {});
  ASSERT_FALSE(map.surfels().empty());
  for (const Surfel& surfel : map.surfels()) {
    EXPECT_GT(surfel.position.x(), 15.0);
  }
}

TEST(SurfelMapTest, WhatIsNeverSeenAgainIsForgotten) {
  SurfelMapOptions options;
  SurfelMap map(options);
  map.Update(SeeWall(8.0), {});
  const VertexMap nothing = MakeVertexMap(Points(3, 0), Image(), 0.5, 1);
  for (int i = 1; i < options.confirm_within; ++i) map.Update(nothing, {});
  EXPECT_FALSE(map.surfels().empty());
  map.Update(nothing, {});
  EXPECT_TRUE(map.surfels().empty());
}

TEST(SurfelMapTest, WhatIsFarBehindIsForgotten) {
  SurfelMapOptions options;
  options.radius = 30.0;
  SurfelMap map(options);
  map.Update(SeeWall(8.0), {});
  map.Update(SeeWall(8.0), {Eigen::Matrix3d::Identity(), {500.0, 0.0, 0.0}});
  ASSERT_FALSE(map.surfels().empty());
  for (const Surfel& surfel : map.surfels()) {
    EXPECT_GT(surfel.position.x(), 400.0);
  }
}

}  // namespace
}  // namespace quatro::odometry_maps_test
