// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Two places in a simulated world, as needed for a registration problem:
//
//   true_target_from_source = world_from_target^-1 world_from_source.       (1)
//
//   street     a residential street, with both places along it (street.h)
//   crossing   where four streets meet; the source is in another street than
//              the target, or in the same street beyond the crossing
//   hill       a street over a crest or through a sag, so that the two cars
//              are tilted relative to each other
//   corridor   in a building or between walls beside a road, with few or no
//              features that distinguish places along it (rooms.h)
//   hall       a large room with pillars and furniture
//   room       a room of a few meters with a handheld depth camera, which looks
//              from near one wall across the room; distances up to 3 m
//   symmetric  a hall with a half turn, a colonnade, or a periodic corridor or
//              terrace; in half of the worlds, a few objects break the
//              symmetry. With the symmetry S, the scans also fit at
//
//   twin_target_from_source = world_from_target^-1 S world_from_source.     (2)

#ifndef QUATRO_EXPERIMENTS_SIMULATOR_WORLDS_H_
#define QUATRO_EXPERIMENTS_SIMULATOR_WORLDS_H_

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "experiments/simulator/scene.h"
#include "features/base/rigid3.h"

namespace quatro {

enum class WorldKind {
  kStreet,
  kCrossing,
  kHill,
  kCorridor,
  kHall,
  kSymmetric,
  kRoom
};

const char* WorldName(WorldKind kind);
std::optional<WorldKind> WorldByName(const std::string& name);
std::vector<std::string> WorldNames();

struct WorldOptions {
  WorldKind kind = WorldKind::kStreet;
  uint64_t seed = 1;
  double distance = 10.0;  // Between the places, along the path [m].
  double yaw = 0.0;        // Rotation of the source [rad].

  // For hills: the angle between the ground normals at the two places [rad].
  double tilt = 0.1;

  // Standard deviation of the vehicle's roll and pitch on its suspension [rad].
  double tilt_sigma = 0.0052;

  // For corridors: the number of distinguishing features; negative: chosen by
  // the seed, with none in about a fifth of the corridors.
  int num_features = -1;

  // For halls, rooms and corridors: the number of the floor. Floors have the
  // same walls and pillars but different objects.
  uint64_t floor = 0;

  bool IsValid(std::string* error) const;
};

struct World {
  Scene scene;
  Rigid3 world_from_source;  // Poses of the sensors.
  Rigid3 world_from_target;

  // S of (2), if there is a symmetry.
  std::optional<Rigid3> symmetry;

  std::string variant;  // Variant of the kind, e.g. colonnade.
  std::string sensor;   // Usual sensor in such places (sensors.h).
};

// `options` must be valid.
World MakeWorld(const WorldOptions& options);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_SIMULATOR_WORLDS_H_
