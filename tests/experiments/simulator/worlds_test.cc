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
#include <vector>

#include "experiments/simulator/lidar.h"
#include "experiments/simulator/road.h"
#include "experiments/simulator/sensors.h"

namespace quatro {
namespace {

using ::testing::HasSubstr;

constexpr double kDegree = M_PI / 180.0;

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
  EXPECT_EQ(MakeSensor("hdl64e", &error)->elevations, Hdl64Elevations());
  EXPECT_FALSE(MakeSensor("radar", &error).has_value());
  EXPECT_THAT(error, HasSubstr("hdl64e vlp16 os1_64"));
  for (const std::string& name : SensorNames()) {
    EXPECT_TRUE(MakeSensor(name, &error)->IsValid(&error)) << error;
  }
}

}  // namespace
}  // namespace quatro
