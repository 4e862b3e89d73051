// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Two places in a simulated world, as a registration problem needs them:
//
//   true_target_from_source = world_from_target^-1 world_from_source.       (1)
//
//   street     a residential street, along which both places are (street.h)
//   crossing   four streets; the source has turned into another one, or has
//              passed the crossing
//   hill       a street over a crest or through a sag, so that the two cars are
//              tilted against each other
//   corridor   in a building or between walls beside a road, with few things
//              that tell where along it one is, or none (rooms.h)
//   hall       a large room with pillars and furniture
//   symmetric  a hall with a half turn, a colonnade, or a periodic corridor or
//              terrace, exact but for a few things in every other world: with
//              its symmetry S, the scans fit as well by
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
  kSymmetric
};

const char* WorldName(WorldKind kind);
std::optional<WorldKind> WorldByName(const std::string& name);
std::vector<std::string> WorldNames();

struct WorldOptions {
  WorldKind kind = WorldKind::kStreet;
  uint64_t seed = 1;
  double distance = 10.0;  // Between the places, along the way [m].
  double yaw = 0.0;        // The source is turned by it [rad].

  // Of a hill: between the grounds of the two places [rad].
  double tilt = 0.1;

  // Standard deviation of the carrier's roll and pitch on its ground [rad].
  double tilt_sigma = 0.0052;

  // Of a corridor: what tells where along it one is; negative: by the seed,
  // none in every fifth.
  int num_features = -1;

  // Of halls and corridors in buildings: another floor, with the same walls and
  // pillars, has other things in it.
  uint64_t floor = 0;

  bool IsValid(std::string* error) const;
};

struct World {
  Scene scene;
  Rigid3 world_from_source;  // Of the sensors.
  Rigid3 world_from_target;

  // S of (2), if there is one.
  std::optional<Rigid3> symmetry;

  std::string variant;  // Which of the kind, e.g. colonnade.
  std::string sensor;   // One that is used in such places (sensors.h).
};

// `options` must be valid.
World MakeWorld(const WorldOptions& options);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_SIMULATOR_WORLDS_H_
