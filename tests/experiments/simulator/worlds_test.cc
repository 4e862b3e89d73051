// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/simulator/worlds.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "experiments/simulator/lidar.h"
#include "experiments/simulator/road.h"
#include "experiments/simulator/sensors.h"
#include "features/base/degree.h"
#include "features/base/rigid3.h"
#include "features/kd_tree.h"

namespace quatro::worlds_test {
namespace {

using ::testing::HasSubstr;

LidarOptions Exact(const std::string& sensor) {
  std::string error;
  LidarOptions options = MakeSensor(sensor, &error).value_or(LidarOptions());
  options.range_sigma = 0.0;
  options.dropout_rate = 0.0;
  return options;
}

PointCloud ScanAt(const World& world,
                  const Rigid3& world_from_sensor,
                  const LidarOptions& lidar) {
  std::string error;
  const auto scene = LidarScene::Create(world.scene, &error);
  EXPECT_NE(scene, nullptr) << error;
  return scene->Scan(world_from_sensor, lidar, ScanId(), 2);
}

double TiltBetween(const World& world) {
  const Eigen::Matrix3d target_from_source =
      world.world_from_target.rotation.transpose() *
      world.world_from_source.rotation;
  return std::acos(std::min(1.0, target_from_source(2, 2)));
}

TEST(WorldNamesTest, AreThoseOfTheKinds) {
  for (const std::string& name : WorldNames()) {
    const auto kind = WorldByName(name);
    ASSERT_TRUE(kind.has_value()) << name;
    EXPECT_EQ(WorldName(*kind), name);
  }
  EXPECT_FALSE(WorldByName("moon").has_value());
}

TEST(MakeWorldTest, PlacesAreAsFarApartAndTurnedAsAsked) {
  for (const std::string& name : WorldNames()) {
    for (const uint64_t seed : {1, 2, 3, 4}) {
      WorldOptions options;
      options.kind = *WorldByName(name);
      options.seed = seed;
      options.distance = 14.0;
      options.yaw = 1.0;
      options.tilt_sigma = 0.0;
      const World world = MakeWorld(options);
      // The offset across the path is added.
      EXPECT_NEAR((world.world_from_source.translation -
                   world.world_from_target.translation)
                      .norm(),
                  14.0,
                  1.6)
          << name << " " << seed;
      const double turn = Yaw(world.world_from_target.rotation.transpose() *
                              world.world_from_source.rotation);
      EXPECT_NEAR(turn, 1.0, 12.0 * kDegree) << name << " " << seed;
    }
  }
}

// The grade changes linearly from one end of the curve to the other.
TEST(RoadTest, CurveIsAParabola) {
  RoadOptions options;
  options.undulation = 0.0;
  options.slope = -0.1;
  options.curve_begin = 100.0;
  options.curve_end = 120.0;
  options.curve_climb = 0.2;
  const Road road(options);
  const auto grade = [&](double s) {
    return (road.SurfacePoint(s + 0.1, 0.0) - road.SurfacePoint(s - 0.1, 0.0))
               .z() /
           0.2;
  };
  EXPECT_NEAR(grade(80.0), std::tan(-0.1), 1e-6);
  EXPECT_NEAR(grade(105.0), 0.5 * std::tan(-0.1), 1e-6);
  EXPECT_NEAR(grade(110.0), 0.0, 1e-6);
  EXPECT_NEAR(grade(115.0), 0.5 * std::tan(0.1), 1e-6);
  EXPECT_NEAR(grade(140.0), std::tan(0.1), 1e-6);
}

TEST(MakeWorldTest, HillsAreAsSteepAsAsked) {
  for (const uint64_t seed : {1, 2, 3, 4, 5, 6}) {
    for (const double tilt : {2.0 * kDegree, 8.0 * kDegree, 15.0 * kDegree}) {
      WorldOptions options;
      options.kind = WorldKind::kHill;
      options.seed = seed;
      options.distance = 20.0;
      options.yaw = 2.5;
      options.tilt = tilt;
      options.tilt_sigma = 0.0;
      // The crown of the road and its sinusoids account for 2 deg.
      EXPECT_NEAR(TiltBetween(MakeWorld(options)), tilt, 2.0 * kDegree)
          << "seed " << seed;
    }
  }
}

// The fraction of rays from the twin place that end at the same points as those
// from the place itself.
double ShareThatAgrees(const World& world) {
  LidarOptions lidar = Exact(world.sensor);
  lidar.max_range = 30.0;  // The ends of the structure are farther away.
  const Rigid3& place = world.world_from_source;
  // Without missed echoes, so that rays correspond.
  const PointCloud here = ScanAt(world, place, lidar);
  const PointCloud there = ScanAt(world, *world.symmetry * place, lidar);
  if (here.points.cols() != there.points.cols()) return 0.0;
  const Eigen::ArrayXd gaps =
      (here.points - there.points).colwise().norm().transpose().array();
  return (gaps < 1e-3).cast<double>().mean();
}

TEST(MakeWorldTest, TwinPlacesLookTheSame) {
  std::set<std::string> seen;
  int num_odd = 0;
  for (uint64_t seed = 1; seed <= 24; ++seed) {
    WorldOptions options;
    options.kind = WorldKind::kSymmetric;
    options.seed = seed;
    options.tilt_sigma = 0.0;
    const World world = MakeWorld(options);
    ASSERT_TRUE(world.symmetry.has_value());
    const double share = ShareThatAgrees(world);
    if (world.variant.find("_odd_") != std::string::npos) {
      ++num_odd;
    } else {
      seen.insert(world.variant);
      EXPECT_GT(share, 0.99) << world.variant << ", seed " << seed;
    }
    // No other place matches.
    World shifted = world;
    shifted.symmetry->translation.x() += 0.7;
    EXPECT_LT(ShareThatAgrees(shifted), 0.9) << world.variant;
  }
  EXPECT_THAT(
      seen,
      ::testing::UnorderedElementsAre(
          "hall_half_turn", "periodic_corridor", "colonnade", "terrace"));
  EXPECT_GT(num_odd, 4);
}

TEST(MakeWorldTest, CorridorsHoldPositionByTheirFeaturesAlone) {
  WorldOptions options;
  options.kind = WorldKind::kCorridor;
  for (const uint64_t seed : {1, 2, 3, 4, 5}) {
    options.seed = seed;
    options.num_features = 0;
    const size_t smooth = MakeWorld(options).scene.triangles.size();
    options.num_features = 30;
    const size_t rich = MakeWorld(options).scene.triangles.size();
    EXPECT_LE(smooth, 16u) << "seed " << seed;
    EXPECT_GT(rich, 200u) << "seed " << seed;
  }
}

// Another floor has the same walls and other objects.
TEST(MakeWorldTest, FloorsShareTheirWalls) {
  WorldOptions options;
  options.kind = WorldKind::kHall;
  const World ground = MakeWorld(options);
  options.floor = 1;
  const World first = MakeWorld(options);
  EXPECT_EQ(ground.world_from_source.ToMatrix(),
            first.world_from_source.ToMatrix());
  ASSERT_NE(ground.scene.vertices.size(), first.scene.vertices.size());
  const size_t num_walls = 300;
  for (size_t i = 0; i < num_walls; ++i) {
    EXPECT_EQ(ground.scene.vertices[i], first.scene.vertices[i]);
  }
}

TEST(WorldOptionsTest, InvalidOptionsAreNamed) {
  std::string error;
  WorldOptions options;
  options.kind = WorldKind::kHall;
  options.distance = 60.0;
  EXPECT_FALSE(options.IsValid(&error));
  EXPECT_THAT(error, HasSubstr("distance = 60 in a hall, must be <= 50"));
  options = {};
  options.yaw = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(options.IsValid(&error));
  EXPECT_THAT(error, HasSubstr("yaw = inf"));
  options = {};
  options.tilt = 0.5;
  EXPECT_FALSE(options.IsValid(&error));
  EXPECT_THAT(error, HasSubstr("tilt = 0.5, must be"));
}

TEST(MakeSensorTest, BeamTablesAreThoseOfTheDataSheets) {
  std::string error;
  const auto vlp = MakeSensor("vlp16", &error);
  ASSERT_TRUE(vlp.has_value());
  ASSERT_EQ(vlp->elevations.size(), 16u);
  for (size_t i = 0; i < 16; ++i) {
    EXPECT_NEAR(vlp->elevations[i],
                (15.0 - 2.0 * static_cast<double>(i)) * kDegree,
                1e-12);
  }
  const auto os1 = MakeSensor("os1_64", &error);
  ASSERT_TRUE(os1.has_value());
  ASSERT_EQ(os1->elevations.size(), 64u);
  EXPECT_NEAR(os1->elevations.front(), 16.6 * kDegree, 1e-12);
  EXPECT_NEAR(os1->elevations.back(), -16.6 * kDegree, 1e-12);
  EXPECT_NEAR(os1->azimuth_offsets[0], 3.164 * kDegree, 1e-12);
  const auto os1_128 = MakeSensor("os1_128", &error);
  ASSERT_TRUE(os1_128.has_value());
  ASSERT_EQ(os1_128->elevations.size(), 128u);
  EXPECT_NEAR(os1_128->elevations.front(), 22.5 * kDegree, 1e-12);
  EXPECT_NEAR(os1_128->elevations.back(), -22.5 * kDegree, 1e-12);
  ASSERT_EQ(os1_128->azimuth_offsets.size(), 128u);
  const auto tls = MakeSensor("tls", &error);
  ASSERT_TRUE(tls.has_value());
  EXPECT_EQ(tls->num_columns, 5143);
  ASSERT_EQ(tls->elevations.size(), 2143u);
  EXPECT_NEAR(tls->elevations[1] - tls->elevations[0], 0.07 * kDegree, 1e-12);
  EXPECT_LT(tls->elevations.back(), 90.0 * kDegree);
  EXPECT_EQ(MakeSensor("hdl64e", &error)->elevations, Hdl64Elevations());
  EXPECT_FALSE(MakeSensor("radar", &error).has_value());
  EXPECT_THAT(error,
              HasSubstr("hdl64e vlp16 os1_64 os1_128 livox tls depth_camera"));
  for (const std::string& name : SensorNames()) {
    EXPECT_TRUE(MakeSensor(name, &error)->IsValid(&error)) << error;
  }
}

// Every n-th beam and column.
LidarOptions Thinned(LidarOptions options, size_t n) {
  std::vector<double> elevations;
  for (size_t i = 0; i < options.elevations.size(); i += n) {
    elevations.push_back(options.elevations[i]);
  }
  options.elevations = elevations;
  options.num_columns /= static_cast<int>(n);
  return options;
}

TEST(TerrestrialTest, TheSphereAboveMinus60DegIsSeenEvenly) {
  WorldOptions options;
  options.kind = WorldKind::kHall;
  const World world = MakeWorld(options);
  const LidarOptions lidar = Thinned(Exact("tls"), 20);
  const PointCloud cloud = ScanAt(world, world.world_from_target, lidar);
  // In a closed hall every ray has an echo but those that fade at grazing
  // incidence: 10 of 11 million when not thinned.
  const double num_rays = static_cast<double>(lidar.elevations.size()) *
                          static_cast<double>(lidar.num_columns);
  EXPECT_GT(static_cast<double>(cloud.points.cols()), 0.9 * num_rays);
  int num_above = 0, num_below = 0;
  for (Eigen::Index i = 0; i < cloud.points.cols(); ++i) {
    const double elevation =
        std::asin(cloud.points.col(i).normalized().z()) / kDegree;
    EXPECT_GT(elevation, -60.1);
    if (elevation > 80.0) ++num_above;
    if (elevation < -50.0) ++num_below;
  }
  // 10 of 150 deg each.
  EXPECT_NEAR(num_above / num_rays, 10.0 / 150.0, 0.01);
  EXPECT_NEAR(num_below / num_rays, 10.0 / 150.0, 0.01);
}

// As many as the issue of every sensor asks for.
TEST(TerrestrialTest, AStreetHasAboutSixMillionPoints) {
  const World world = MakeWorld(WorldOptions());
  constexpr size_t kThin = 20;
  std::string error;
  const LidarOptions lidar =
      Thinned(MakeSensor("tls", &error).value_or(LidarOptions()), kThin);
  const PointCloud cloud = ScanAt(world, world.world_from_target, lidar);
  const double num_points =
      static_cast<double>(cloud.points.cols()) * kThin * kThin;
  EXPECT_GT(num_points, 4.5e6);
  EXPECT_LT(num_points, 7.5e6);
}

// Cells of one degree that a livox scan has a point in.
std::set<std::pair<int, int>> SeenCells(const PointCloud& cloud) {
  std::set<std::pair<int, int>> cells;
  for (Eigen::Index i = 0; i < cloud.points.cols(); ++i) {
    const Eigen::Vector3d d = cloud.points.col(i).normalized();
    cells.emplace(
        static_cast<int>(std::floor(std::atan2(d.y(), d.x()) / kDegree)),
        static_cast<int>(std::floor(std::asin(d.z()) / kDegree)));
  }
  return cells;
}

TEST(LivoxTest, TheViewIsNarrowAndThePatternDoesNotRepeat) {
  WorldOptions options;
  options.kind = WorldKind::kHall;
  const World world = MakeWorld(options);
  std::string error;
  const auto scene = LidarScene::Create(world.scene, &error);
  ASSERT_NE(scene, nullptr) << error;
  const LidarOptions lidar = Exact("livox");
  std::set<std::pair<int, int>> all;
  std::vector<size_t> num_seen;
  for (uint64_t frame = 0; frame < 6; ++frame) {
    const PointCloud cloud =
        scene->Scan(world.world_from_target, lidar, {1, frame}, 2);
    EXPECT_GT(cloud.points.cols(), 20000);
    EXPECT_LE(cloud.points.cols(), 24000);
    for (Eigen::Index i = 0; i < cloud.points.cols(); ++i) {
      const Eigen::Vector3d d = cloud.points.col(i).normalized();
      ASSERT_LE(std::abs(std::atan2(d.y(), d.x())), 35.2 * kDegree + 1e-9);
      ASSERT_LE(std::abs(std::asin(d.z())), 38.6 * kDegree + 1e-9);
    }
    const auto cells = SeenCells(cloud);
    num_seen.push_back(cells.size());
    all.insert(cells.begin(), cells.end());
  }
  // Frame by frame the view fills; a pattern that repeats would not fill it.
  const double area = M_PI * 35.2 * 38.6;  // [deg^2]
  EXPECT_LT(static_cast<double>(num_seen.front()), 0.75 * area);
  EXPECT_GT(static_cast<double>(all.size()),
            1.3 * static_cast<double>(num_seen.front()));
  EXPECT_GT(static_cast<double>(all.size()), 0.85 * area);
}

TEST(DepthCameraTest, PixelsAreThoseOfAPinhole) {
  const LidarOptions lidar = Exact("depth_camera");
  const size_t last = lidar.elevations.size() - 1;
  const auto columns = static_cast<size_t>(lidar.num_columns);
  // Corners of the image are at the halves of both views, but for half a pixel.
  const Ray corner = RayOf(lidar, 0, 0, 0.3);
  EXPECT_NEAR(corner.direction.y() / corner.direction.x(),
              std::tan(29.0 * kDegree),
              2e-3);
  EXPECT_NEAR(corner.direction.z() / corner.direction.x(),
              std::tan(22.5 * kDegree),
              2e-3);
  const Ray other = RayOf(lidar, last, columns - 1, 0.7);
  EXPECT_NEAR(other.direction.x(), corner.direction.x(), 1e-12);
  EXPECT_NEAR(other.direction.y(), -corner.direction.y(), 1e-12);
  EXPECT_NEAR(other.direction.z(), -corner.direction.z(), 1e-12);
  EXPECT_EQ(other.fraction, 0.5);  // All at once.
  // Even steps on the image plane, not in angle.
  const auto at = [&](size_t column) {
    const Eigen::Vector3d d = RayOf(lidar, 240, column, 0.0).direction;
    return d.y() / d.x();
  };
  EXPECT_NEAR(at(0) - at(1), at(319) - at(320), 1e-12);
}

TEST(DepthCameraTest, ErrorsGrowWithTheSquareOfTheRange) {
  WorldOptions options;
  options.kind = WorldKind::kRoom;
  options.distance = 1.0;
  const World world = MakeWorld(options);
  std::string error;
  LidarOptions noisy =
      MakeSensor("depth_camera", &error).value_or(LidarOptions());
  noisy.dropout_rate = 0.0;
  noisy.max_range = 1000.0;  // No echo is missed.
  LidarOptions exact = noisy;
  exact.range_sigma_growth = 0.0;
  const PointCloud truth = ScanAt(world, world.world_from_target, exact);
  const PointCloud cloud = ScanAt(world, world.world_from_target, noisy);
  ASSERT_EQ(truth.points.cols(), cloud.points.cols());
  ASSERT_GT(truth.points.cols(), 250000);
  double near_sum = 0.0, far_sum = 0.0;
  int num_near = 0, num_far = 0;
  for (Eigen::Index i = 0; i < truth.points.cols(); ++i) {
    const double range = truth.points.col(i).norm();
    const double unit =
        (cloud.points.col(i).norm() - range) / (0.0014 * range * range);
    (range < 2.0 ? near_sum : far_sum) += unit * unit;
    ++(range < 2.0 ? num_near : num_far);
  }
  ASSERT_GT(num_near, 1000);
  ASSERT_GT(num_far, 1000);
  EXPECT_NEAR(near_sum / num_near, 1.0, 0.15);
  EXPECT_NEAR(far_sum / num_far, 1.0, 0.15);
}

// Two views of one room overlap, and agree at the true pose.
TEST(RoomTest, ViewsOverlapAtTheTruePose) {
  int num_close = 0;
  for (const uint64_t seed : {1, 2, 3, 4}) {
    WorldOptions options;
    options.kind = WorldKind::kRoom;
    options.seed = seed;
    options.distance = 0.7;
    options.yaw = 0.3;
    const World world = MakeWorld(options);
    EXPECT_EQ(world.sensor, "depth_camera");
    const LidarOptions lidar = Exact(world.sensor);
    const PointCloud source = ScanAt(world, world.world_from_source, lidar);
    const PointCloud target = ScanAt(world, world.world_from_target, lidar);
    ASSERT_GT(source.points.cols(), 150000) << seed;
    ASSERT_GT(target.points.cols(), 150000) << seed;
    EXPECT_LT(target.points.colwise().norm().maxCoeff(), 8.0);
    const Rigid3 target_from_source =
        Inverse(world.world_from_target) * world.world_from_source;
    const KdTree tree(target.points);
    int num_near = 0, num_all = 0;
    for (Eigen::Index i = 0; i < source.points.cols(); i += 100) {
      const Eigen::Vector3d point =
          target_from_source * Eigen::Vector3d(source.points.col(i));
      ++num_all;
      if (tree.Nearest(point, 1)[0].squared_distance < 0.05 * 0.05) ++num_near;
    }
    if (num_near > 0.3 * num_all) ++num_close;
  }
  EXPECT_GE(num_close, 3);
}

TEST(RayPatternTest, WhatIsOutOfRangeIsNamed) {
  std::string error;
  LidarOptions livox = Exact("livox");
  EXPECT_TRUE(livox.IsValid(&error)) << error;
  livox.height = 179.0 * kDegree;
  EXPECT_FALSE(livox.IsValid(&error));
  EXPECT_THAT(error, HasSubstr("with half of height = "));
  LidarOptions camera = Exact("depth_camera");
  camera.width = M_PI;
  EXPECT_FALSE(camera.IsValid(&error));
  EXPECT_THAT(error, HasSubstr("of a camera, must be < pi"));
  camera = Exact("depth_camera");
  camera.range_sigma_growth = -1.0;
  EXPECT_FALSE(camera.IsValid(&error));
  EXPECT_THAT(error, HasSubstr("range_sigma_growth = -1, must be finite"));
}

}  // namespace
}  // namespace quatro::worlds_test
