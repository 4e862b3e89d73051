// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/simulator/pair_sets.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "experiments/simulator/lidar.h"
#include "experiments/simulator/sensors.h"
#include "features/base/random.h"

namespace quatro {
namespace {

// Two cars this far apart have disjoint ranges [m].
constexpr double kFarApart = 300.0;

// The attitude of the sensor relative to gravity and the world's x axis, with
// an error.
Attitude Measure(const Rigid3& world_from_sensor,
                 double sigma,
                 Random& random) {
  const Eigen::Matrix3d& R = world_from_sensor.rotation;
  Attitude attitude;
  attitude.roll = std::atan2(R(2, 1), R(2, 2)) + sigma * random.Normal();
  attitude.pitch = std::atan2(-R(2, 0), std::hypot(R(2, 1), R(2, 2))) +
                   sigma * random.Normal();
  attitude.yaw = Yaw(R) + sigma * random.Normal();
  return attitude;
}

// A second world for a pair without overlap; returns the kind of separation.
std::string OtherWorld(const PairSetOptions& set,
                       Random& random,
                       WorldOptions* world) {
  const bool may_be_far =
      set.world == WorldKind::kStreet || set.world == WorldKind::kHill;
  const bool has_floors = set.world == WorldKind::kHall ||
                          set.world == WorldKind::kCorridor ||
                          set.world == WorldKind::kRoom;
  const bool is_same_world = random.Uniform() < 1.0 / 3.0;
  if (is_same_world && may_be_far) {
    world->distance = kFarApart;
    return "far_apart";
  }
  if (is_same_world && has_floors) {
    world->floor = 1;
    return "other_floor";
  }
  world->seed = random.Next();
  return "other_seed";
}

// The largest yaw of the source: that of the options, or half of a narrow field
// of view.
double MaxYaw(const PairSetOptions& options) {
  std::string ignored;
  const bool is_usual = options.sensor == "auto";
  if (is_usual && options.world != WorldKind::kRoom) return options.max_yaw;
  const auto lidar =
      MakeSensor(is_usual ? "depth_camera" : options.sensor, &ignored);
  const bool is_narrow = lidar && lidar->width < 2.0 * M_PI;
  return is_narrow ? std::min(options.max_yaw, 0.5 * lidar->width)
                   : options.max_yaw;
}

}  // namespace

std::string PairSetOptions::Name() const {
  return std::string(WorldName(world)) + (no_overlap ? "_apart" : "");
}

bool PairSetOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  std::string lower;
  WorldOptions options;
  options.kind = world;
  options.tilt_sigma = tilt_sigma;
  options.num_features = num_features;
  options.distance = max_distance;
  options.tilt = max_tilt;
  if (num_pairs < 1 || num_pairs > 1000000) {
    problem << "num_pairs = " << num_pairs << ", must be in [1, 1000000]";
  } else if (!(min_distance >= 0.0 && min_distance <= max_distance)) {
    problem << "min_distance = " << min_distance
            << ", must be in [0, max_distance = " << max_distance << "]";
  } else if (!(max_distance <= 50.0)) {
    problem << "max_distance = " << max_distance << ", must be <= 50";
  } else if (!(max_yaw >= 0.0 && max_yaw <= 3.15)) {
    problem << "max_yaw = " << max_yaw << ", must be in [0, pi]";
  } else if (!(min_tilt >= 0.0 && min_tilt <= max_tilt)) {
    problem << "min_tilt = " << min_tilt
            << ", must be in [0, max_tilt = " << max_tilt << "]";
  } else if (!(ins_sigma >= 0.0 && ins_sigma <= 0.2)) {
    problem << "ins_sigma = " << ins_sigma << ", must be in [0, 0.2]";
  } else if (sensor != "auto" && !MakeSensor(sensor, &lower)) {
    problem << "sensor = " << lower << " auto";
  } else if (!options.IsValid(&lower)) {
    problem << (lower.starts_with("distance") ? "max_" : "") << lower;
  }
  *error = problem.str();
  return error->empty();
}

std::optional<SetPair> SimulateSetPair(const PairSetOptions& options,
                                       int index,
                                       std::string* error) {
  if (!options.IsValid(error)) return std::nullopt;
  const auto set_key =
      2 * static_cast<uint64_t>(options.world) + (options.no_overlap ? 1 : 0);
  Random random(
      Mix(Mix(Mix(options.seed) ^ set_key) ^ static_cast<uint64_t>(index)));
  WorldOptions world_options;
  world_options.kind = options.world;
  world_options.seed = random.Next() >> 11;  // So that it fits into a double.
  world_options.distance =
      Uniform(random, options.min_distance, options.max_distance);
  const double max_yaw = MaxYaw(options);
  world_options.yaw = Uniform(random, -max_yaw, max_yaw);
  world_options.tilt = Uniform(random, options.min_tilt, options.max_tilt);
  world_options.tilt_sigma = options.tilt_sigma;
  world_options.num_features = options.num_features;

  SetPair pair;
  pair.seed = pair.target_seed = world_options.seed;
  const World world = MakeWorld(world_options);
  std::optional<World> other;  // World of the source, if different.
  if (options.no_overlap) {
    WorldOptions other_options = world_options;
    pair.apart = OtherWorld(options, random, &other_options);
    pair.seed = other_options.seed;
    other = MakeWorld(other_options);
  }
  // If the pair is far_apart, both places are in `other`, one long street.
  const World& of_source = other ? *other : world;
  const World& of_target = pair.apart == "far_apart" ? *other : world;
  pair.sensor = options.sensor == "auto" ? of_target.sensor : options.sensor;
  pair.variant = of_source.variant;
  const auto lidar = MakeSensor(pair.sensor, error);
  if (!lidar) return std::nullopt;

  const Rigid3& world_from_source = of_source.world_from_source;
  const Rigid3& world_from_target = of_target.world_from_target;
  pair.world_from_source = world_from_source;
  pair.world_from_target = world_from_target;
  const uint64_t noise_seed = random.Next();
  auto scene = LidarScene::Create(of_source.scene, error);
  if (scene == nullptr) return std::nullopt;
  pair.source = scene->Scan(world_from_source, *lidar, {noise_seed, 1}, 1);
  if (&of_source != &of_target) {
    scene = LidarScene::Create(of_target.scene, error);
    if (scene == nullptr) return std::nullopt;
  }
  pair.target = scene->Scan(world_from_target, *lidar, {noise_seed, 0}, 1);
  pair.source_ins = Measure(world_from_source, options.ins_sigma, random);
  pair.target_ins = Measure(world_from_target, options.ins_sigma, random);
  if (!options.no_overlap) {
    pair.true_target_from_source =
        Inverse(world_from_target) * world_from_source;
    if (world.symmetry) {
      pair.twin_target_from_source =
          Inverse(world_from_target) * *world.symmetry * world_from_source;
    }
  }
  return pair;
}

std::vector<PairSetOptions> CalibrationSets(uint64_t seed, double scale) {
  std::vector<PairSetOptions> sets;
  for (const bool no_overlap : {false, true}) {
    for (const auto& [world, num_pairs] :
         {std::pair(WorldKind::kStreet, 250),
          std::pair(WorldKind::kCrossing, 100),
          std::pair(WorldKind::kHill, 100),
          std::pair(WorldKind::kCorridor, 100),
          std::pair(WorldKind::kHall, 100),
          std::pair(WorldKind::kSymmetric, 100)}) {
      PairSetOptions set;
      set.world = world;
      set.num_pairs =
          std::max(1, static_cast<int>(std::lround(num_pairs * scale)));
      set.seed = seed;
      set.no_overlap = no_overlap;
      if (world == WorldKind::kHill) set.min_distance = 8.0;
      if (world == WorldKind::kHall) set.max_distance = 15.0;
      if (world == WorldKind::kSymmetric) set.max_distance = 15.0;
      sets.push_back(set);
    }
  }
  return sets;
}

}  // namespace quatro
