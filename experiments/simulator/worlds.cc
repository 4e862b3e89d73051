// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/simulator/worlds.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "experiments/simulator/road.h"
#include "experiments/simulator/rooms.h"
#include "experiments/simulator/street.h"

namespace quatro {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::pair<WorldKind, const char*> kNames[] = {
    {WorldKind::kStreet, "street"},
    {WorldKind::kCrossing, "crossing"},
    {WorldKind::kHill, "hill"},
    {WorldKind::kCorridor, "corridor"},
    {WorldKind::kHall, "hall"},
    {WorldKind::kSymmetric, "symmetric"},
    {WorldKind::kRoom, "room"}};

constexpr double kMaxDistanceInRoom = 3.0;  // [m]

constexpr double kOnCar = Road::kSensorHeight;
constexpr double kOnCart = 0.9;  // [m]

// The pose of a sensor above a level floor, with random roll and pitch.
Rigid3 OnFloor(const Vector2d& xy,
               double height,
               double yaw,
               double tilt_sigma,
               Random& random) {
  const Eigen::AngleAxisd pitch(tilt_sigma * random.Normal(),
                                Vector3d::UnitY());
  const Eigen::AngleAxisd roll(tilt_sigma * random.Normal(), Vector3d::UnitX());
  return {RotationZ(yaw) * (pitch * roll).toRotationMatrix(),
          Vector3d(xy.x(), xy.y(), height)};
}

RoadOptions RoadFor(const WorldOptions& options) {
  RoadOptions road;
  road.seed = options.seed;
  road.tilt_sigma = options.tilt_sigma;
  road.length = 2.0 * kMargin + options.distance;
  return road;
}

World MakeStreetWorld(const WorldOptions& options, Random& random) {
  const Road road(RoadFor(options));
  return {
      MakeStreet(road),
      road.WorldFromSensor(
          kMargin + options.distance, Uniform(random, -1.5, 1.5), options.yaw),
      road.WorldFromSensor(kMargin, 0.0, 0.0),
      std::nullopt,
      "along",
      "hdl64e"};
}

World MakeCrossingWorld(const WorldOptions& options, Random& random) {
  RoadOptions road_options = RoadFor(options);
  const bool turns = random.Uniform() < 0.5;
  const double before = turns ? Uniform(random, 0.0, 0.6) * options.distance
                              : Uniform(random, 0.0, options.distance);
  road_options.crossing = kMargin + before;
  const Road road(road_options);
  World world = {MakeStreet(road),
                 {},
                 road.WorldFromSensor(kMargin, 0.0, 0.0),
                 std::nullopt,
                 turns ? "turned" : "passed",
                 "hdl64e"};
  if (turns) {
    // The straight distance between the places is `options.distance`.
    const double side = random.Uniform() < 0.5 ? 1.0 : -1.0;
    const double away =
        std::sqrt(options.distance * options.distance - before * before);
    world.world_from_source =
        road.WorldFromSensor(kMargin + before + Uniform(random, -1.5, 1.5),
                             side * away,
                             options.yaw);
  } else {
    world.world_from_source = road.WorldFromSensor(
        kMargin + options.distance, Uniform(random, -1.5, 1.5), options.yaw);
  }
  return world;
}

World MakeHillWorld(const WorldOptions& options, Random& random) {
  constexpr double kMaxBank = 0.1;  // [rad]
  constexpr double kFootprint = 1.5;
  RoadOptions road = RoadFor(options);
  const double bank =
      std::min(kMaxBank, 0.7 * options.tilt) * Uniform(random, -1.0, 1.0);
  const double sign = random.Uniform() < 0.5 ? 1.0 : -1.0;
  // cos(tilt) = cos(climb) cos(bank)
  const double climb =
      sign *
      std::acos(std::clamp(std::cos(options.tilt) / std::cos(bank), -1.0, 1.0));
  road.curve_begin = kMargin + kFootprint;
  road.curve_end = kMargin + std::max(4.0, options.distance - kFootprint);
  road.curve_climb = climb;
  road.curve_bank = bank;
  road.slope = -climb / 2.0 + Uniform(random, -0.02, 0.02);
  const Road hill(road);
  return {MakeStreet(hill),
          hill.WorldFromSensor(road.curve_begin - kFootprint +
                                   std::max(options.distance, 4.0 + kFootprint),
                               Uniform(random, -1.5, 1.5),
                               options.yaw),
          hill.WorldFromSensor(kMargin, 0.0, 0.0),
          std::nullopt,
          climb < 0.0 ? "crest" : "sag",
          "hdl64e"};
}

std::string SensorOfCart(Random& random) {
  return random.Uniform() < 0.5 ? "vlp16" : "os1_64";
}

// Places both sensors `options.distance` apart along x, centered on `middle`.
void PlaceAlongX(const WorldOptions& options,
                 double middle,
                 double max_y,
                 double height,
                 double target_yaw,
                 Random& random,
                 World* world) {
  const double sign = random.Uniform() < 0.5 ? 1.0 : -1.0;
  const double y = Uniform(random, -1.0, 1.0) * max_y;
  const double source_y = Uniform(random, -1.0, 1.0) * max_y;
  world->world_from_target =
      OnFloor({middle - sign * options.distance / 2.0, y},
              height,
              target_yaw,
              options.tilt_sigma,
              random);
  world->world_from_source =
      OnFloor({middle + sign * options.distance / 2.0, source_y},
              height,
              target_yaw + options.yaw,
              options.tilt_sigma,
              random);
}

World MakeCorridorWorld(const WorldOptions& options, Random& random) {
  CorridorOptions corridor;
  corridor.seed = options.seed;
  corridor.contents_seed = Mix(options.seed ^ Mix(options.floor));
  corridor.is_outdoors = random.Uniform() < 0.4;
  World world;
  double max_y;
  if (corridor.is_outdoors) {
    corridor.length = 300.0;
    corridor.width = Uniform(random, 9.0, 15.0);
    corridor.height = Uniform(random, 2.5, 6.0);
    max_y = 1.5;
    world.variant = "between_walls";
    world.sensor = "hdl64e";
  } else {
    corridor.length = options.distance + Uniform(random, 25.0, 110.0);
    corridor.width = Uniform(random, 1.8, 4.5);
    corridor.height = Uniform(random, 2.4, 3.4);
    max_y = corridor.width / 2.0 - 0.8;
    world.variant = "indoors";
    world.sensor = SensorOfCart(random);
  }
  const double density =
      random.Uniform() < 0.2 ? 0.0 : Uniform(random, 0., 0.5);
  corridor.num_features = options.num_features >= 0
                              ? options.num_features
                              : static_cast<int>(density * corridor.length);
  world.scene = MakeCorridor(corridor);
  const double slack = (corridor.length - options.distance) / 2.0 - 5.0;
  PlaceAlongX(options,
              corridor.is_outdoors ? 0.0 : Uniform(random, -slack, slack),
              max_y,
              corridor.is_outdoors ? kOnCar : kOnCart,
              Uniform(random, -M_PI, M_PI),
              random,
              &world);
  world.variant += "_" + std::to_string(corridor.num_features);
  return world;
}

// Two points `distance` apart within +-half, with the target within +-reach.
std::pair<Vector2d, Vector2d> DrawPlaces(const Vector2d& half,
                                         const Vector2d& reach,
                                         double distance,
                                         Random& random) {
  for (;;) {
    const Vector2d target(Uniform(random, -reach.x(), reach.x()),
                          Uniform(random, -reach.y(), reach.y()));
    const double azimuth = Uniform(random, -M_PI, M_PI);
    const Vector2d source =
        target + distance * Vector2d(std::cos(azimuth), std::sin(azimuth));
    if (std::abs(source.x()) < half.x() && std::abs(source.y()) < half.y()) {
      return {source, target};
    }
  }
}

// In half of the worlds, adds a few objects within max_y of the x axis, which
// break the symmetry slightly.
void AddOddThingsTo(double max_y, Random& random, World* world) {
  if (random.Uniform() < 0.5) return;
  const auto num_things = 1 + static_cast<int>(random.Below(4));
  AddOddThings(num_things,
               {world->world_from_source.translation.head<2>(),
                world->world_from_target.translation.head<2>()},
               max_y,
               random,
               world->scene);
  world->variant += "_odd_" + std::to_string(num_things);
}

World MakeHallWorld(const WorldOptions& options,
                    bool has_half_turn,
                    Random& random) {
  constexpr double kFromWall = 1.5;  // [m]
  HallOptions hall;
  hall.seed = options.seed;
  hall.contents_seed = Mix(options.seed ^ Mix(options.floor));
  hall.has_half_turn = has_half_turn;
  hall.length = std::max(Uniform(random, 18.0, 50.0),
                         (has_half_turn ? 1.8 : 1.0) * options.distance + 8.0);
  hall.width = Uniform(random, 0.4, 0.8) * hall.length;
  hall.height = Uniform(random, 3.0, 8.0);
  const Vector2d half =
      Vector2d(hall.length, hall.width) / 2.0 - Vector2d::Constant(kFromWall);
  // With a half turn, the target is near the center, so that the source and its
  // twin are about equally far from it.
  const Vector2d reach = has_half_turn ? Vector2d(0.1 * half) : half;
  const auto [source, target] =
      DrawPlaces(half, reach, options.distance, random);
  hall.places = {source, target};
  World world;
  world.variant = has_half_turn ? "hall_half_turn" : "hall";
  world.sensor = SensorOfCart(random);
  const double yaw = Uniform(random, -M_PI, M_PI);
  world.world_from_target =
      OnFloor(target, kOnCart, yaw, options.tilt_sigma, random);
  world.world_from_source =
      OnFloor(source, kOnCart, yaw + options.yaw, options.tilt_sigma, random);
  world.scene = MakeHall(hall);
  if (has_half_turn) {
    world.symmetry =
        Rigid3{Vector3d(-1.0, -1.0, 1.0).asDiagonal(), Vector3d::Zero()};
    AddOddThingsTo(half.y(), random, &world);
  }
  return world;
}

World MakeRoomWorld(const WorldOptions& options, Random& random) {
  constexpr double kFromWall = 1.6;  // Clear of furniture [m].
  RoomOptions room;
  room.seed = options.seed;
  room.contents_seed = Mix(options.seed ^ Mix(options.floor));
  room.length = std::max(Uniform(random, 5.0, 8.0),
                         options.distance + 2.0 * kFromWall + 1.0);
  room.width = Uniform(random, 4.5, 6.5);
  room.height = Uniform(random, 2.4, 3.2);
  const Vector2d half =
      Vector2d(room.length, room.width) / 2.0 - Vector2d::Constant(kFromWall);
  const auto [source, target] =
      DrawPlaces(half, half, options.distance, random);
  World world;
  world.variant = "room";
  world.sensor = "depth_camera";
  // Away from the nearer end of the room.
  const double yaw =
      (target.x() < 0.0 ? 0.0 : M_PI) + Uniform(random, -0.5, 0.5);
  world.world_from_target = OnFloor(
      target, Uniform(random, 1.0, 1.6), yaw, options.tilt_sigma, random);
  world.world_from_source = OnFloor(source,
                                    Uniform(random, 1.0, 1.6),
                                    yaw + options.yaw,
                                    options.tilt_sigma,
                                    random);
  world.scene = MakeRoom(room);
  return world;
}

World MakeSymmetricWorld(const WorldOptions& options, Random& random) {
  const uint64_t variant = random.Below(4);
  if (variant == 0) return MakeHallWorld(options, true, random);
  World world;
  double period = 0.0, height = kOnCart, max_y = 0.0, odd_max_y = 0.0;
  double yaw = Uniform(random, -M_PI, M_PI);
  if (variant == 1) {
    CorridorOptions corridor;
    corridor.seed = options.seed;
    corridor.length = 320.0;
    corridor.width = Uniform(random, 2.2, 6.0);
    corridor.height = Uniform(random, 2.5, 3.5);
    period = corridor.period = Uniform(random, 3.0, 9.0);
    max_y = corridor.width / 2.0 - 0.8;
    odd_max_y = corridor.width / 2.0 - 0.4;
    world.scene = MakeCorridor(corridor);
    world.variant = "periodic_corridor";
    world.sensor = SensorOfCart(random);
  } else if (variant == 2) {
    const Vector2d spacing(Uniform(random, 4.0, 9.0),
                           Uniform(random, 4.0, 9.0));
    period = spacing.x();
    max_y = 1.2;
    odd_max_y = 15.0;
    world.scene =
        MakeColonnade(options.seed, Uniform(random, 2.3, 4.0), spacing);
    // Between two rows of pillars.
    world.scene.Append(
        std::exchange(world.scene, {}),
        {Eigen::Matrix3d::Identity(), Vector3d(0.0, spacing.y() / 2.0, 0.0)});
    world.variant = "colonnade";
    world.sensor = SensorOfCart(random);
  } else {
    period = Uniform(random, 8.0, 14.0);
    height = kOnCar;
    max_y = 2.0;
    odd_max_y = 6.0;
    yaw = random.Uniform() < 0.5 ? 0.0 : M_PI;
    world.scene = MakeTerrace(options.seed, period);
    world.variant = "terrace";
    world.sensor = "hdl64e";
  }
  PlaceAlongX(options,
              Uniform(random, -period, period),
              max_y,
              height,
              yaw,
              random,
              &world);
  // Chooses the shift that brings the source closer to the target, where they
  // see more of the same structure.
  const double ahead = (world.world_from_source.translation -
                        world.world_from_target.translation)
                           .x();
  world.symmetry = Rigid3{Eigen::Matrix3d::Identity(),
                          Vector3d(ahead > 0.0 ? -period : period, 0.0, 0.0)};
  AddOddThingsTo(odd_max_y, random, &world);
  return world;
}

}  // namespace

const char* WorldName(WorldKind kind) {
  for (const auto& [known, name] : kNames) {
    if (known == kind) return name;
  }
  return "";
}

std::optional<WorldKind> WorldByName(const std::string& name) {
  for (const auto& [kind, known] : kNames) {
    if (known == name) return kind;
  }
  return std::nullopt;
}

std::vector<std::string> WorldNames() {
  std::vector<std::string> names;
  for (const auto& [kind, name] : kNames) names.emplace_back(name);
  return names;
}

bool WorldOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  if (!(distance >= 0.0 && distance <= 1000.0)) {
    problem << "distance = " << distance << ", must be in [0, 1000]";
  } else if (kind != WorldKind::kStreet && kind != WorldKind::kHill &&
             !(distance <= 50.0)) {
    problem << "distance = " << distance << " in a " << WorldName(kind)
            << ", must be <= 50";
  } else if (kind == WorldKind::kRoom && !(distance <= kMaxDistanceInRoom)) {
    problem << "distance = " << distance
            << " in a room, must be <= " << kMaxDistanceInRoom;
  } else if (!std::isfinite(yaw)) {
    problem << "yaw = " << yaw << ", must be finite";
  } else if (!(tilt >= 0.0 && tilt <= 0.3)) {
    problem << "tilt = " << tilt << ", must be in [0, 0.3]";
  } else if (!(tilt_sigma >= 0.0 && tilt_sigma <= 0.2)) {
    problem << "tilt_sigma = " << tilt_sigma << ", must be in [0, 0.2]";
  } else if (num_features > 1000) {
    problem << "num_features = " << num_features << ", must be <= 1000";
  }
  *error = problem.str();
  return error->empty();
}

World MakeWorld(const WorldOptions& options) {
  Random random(Mix(Mix(options.seed) ^ static_cast<uint64_t>(options.kind)));
  switch (options.kind) {
    case WorldKind::kStreet:
      return MakeStreetWorld(options, random);
    case WorldKind::kCrossing:
      return MakeCrossingWorld(options, random);
    case WorldKind::kHill:
      return MakeHillWorld(options, random);
    case WorldKind::kCorridor:
      return MakeCorridorWorld(options, random);
    case WorldKind::kHall:
      return MakeHallWorld(options, false, random);
    case WorldKind::kSymmetric:
      return MakeSymmetricWorld(options, random);
    case WorldKind::kRoom:
      return MakeRoomWorld(options, random);
  }
  return {};
}

}  // namespace quatro
