// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Sets of simulated pairs, each pair in its own world.
//
// Pair i of a set depends only on the set's options and on i.

#ifndef QUATRO_EXPERIMENTS_SIMULATOR_PAIR_SETS_H_
#define QUATRO_EXPERIMENTS_SIMULATOR_PAIR_SETS_H_

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "experiments/simulator/worlds.h"
#include "features/base/rigid3.h"
#include "features/io/point_cloud.h"
#include "solvers/closed_form/gravity.h"

namespace quatro {

struct PairSetOptions {
  WorldKind world = WorldKind::kStreet;
  int num_pairs = 100;
  uint64_t seed = 1;

  // Ranges of uniform distributions: the distance between the places along the
  // path [m]; the yaw of the source in either direction [rad], limited to half
  // the field of view of a sensor that does not see all around; for hills, the
  // tilt [rad].
  double min_distance = 0.0;
  double max_distance = 30.0;
  double max_yaw = 3.15;
  double min_tilt = 0.035;
  double max_tilt = 0.26;

  // If true, the scans do not overlap and come from worlds of the same kind.
  bool no_overlap = false;

  // For corridors; negative: chosen by the seed (worlds.h).
  int num_features = -1;

  // A sensor of sensors.h, or `auto` for the sensor of the world.
  std::string sensor = "auto";

  double tilt_sigma = 0.0052;  // Roll and pitch (suspension) [rad].
  double ins_sigma = 0.0087;   // INS error in roll, pitch and yaw [rad].

  bool IsValid(std::string* error) const;

  // The name of the set and of its folder: the world's name, with _apart if
  // no_overlap.
  std::string Name() const;
};

struct SetPair {
  PointCloud source;
  PointCloud target;

  // Not set if the scans do not overlap.
  std::optional<Rigid3> true_target_from_source;
  std::optional<Rigid3> twin_target_from_source;

  Attitude source_ins;  // As measured.
  Attitude target_ins;
  Rigid3 world_from_source;  // Each in its own world.
  Rigid3 world_from_target;
  std::string variant, sensor, apart;
  uint64_t seed = 0;  // Seed of the source's world.
  uint64_t target_seed = 0;
};

// Simulates pair `index` of the set. Returns nullopt and sets *error if the
// options are invalid.
std::optional<SetPair> SimulateSetPair(const PairSetOptions& options,
                                       int index,
                                       std::string* error);

// Sets for calibrating a verdict: `scale` times 750 pairs with overlap (250
// streets and 100 each of crossings, hills, corridors, halls and symmetric
// worlds) and as many without.
std::vector<PairSetOptions> CalibrationSets(uint64_t seed, double scale);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_SIMULATOR_PAIR_SETS_H_
