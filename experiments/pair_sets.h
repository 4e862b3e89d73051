// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Sets of simulated pairs on disk, each pair in a world of its own:
//
//   street/000000_source.bin ...       float32 x y z intensity, sensor frame
//   pairs.csv            set,source,target,tx,ty,tz,qx,qy,qz,qw,distance_m,
//                        yaw_deg,rollpitch_deg, then what is below
//   pairs_negative.csv   the same without a pose: scans with nothing in common
//   rows/                a pair's line; that it is there says its scans are
//   settings.json        what the sets were asked to be
//
// Both lists go on with
//
//   world,variant,sensor,seed,apart   what was simulated; apart: other_seed,
//                                     far_apart or other_floor of a negative
//   source_rpy_deg,target_rpy_deg     "roll,pitch,yaw" of the sensors as a
//   noisy
//                                     INS has them, for the flags of that name
//   ins_std_deg                       of each of these angles
//   twin_tx ... twin_qw               of worlds with a symmetry: the other pose
//                                     by which the scans fit
//
// Pair i of a set depends on the set's options and on i alone: not on threads,
// on the number of pairs, or on what was there before.

#ifndef QUATRO_EXPERIMENTS_PAIR_SETS_H_
#define QUATRO_EXPERIMENTS_PAIR_SETS_H_

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiments/worlds.h"
#include "features/point_cloud.h"
#include "solvers/gravity.h"
#include "solvers/rigid3.h"

namespace quatro {

struct PairSetOptions {
  WorldKind world = WorldKind::kStreet;
  int num_pairs = 100;
  uint64_t seed = 1;

  // Drawn evenly from these: how far apart the places are, along the way [m];
  // the turn of the source, either way [rad]; for hills, the tilt [rad].
  double min_distance = 0.0;
  double max_distance = 30.0;
  double max_yaw = 3.15;
  double min_tilt = 0.035;
  double max_tilt = 0.26;

  // Scans with nothing in common, from worlds that look alike.
  bool no_overlap = false;

  // Of corridors; negative: by the seed (worlds.h).
  int num_features = -1;

  // One of sensors.h, or `auto`: that of the world.
  std::string sensor = "auto";

  double tilt_sigma = 0.0052;  // Of roll and pitch on the springs [rad].
  double ins_sigma = 0.0087;   // Of the INS' roll, pitch and yaw [rad].

  bool IsValid(std::string* error) const;

  // Name of the set and of its folder: the world's, with _apart if no_overlap.
  std::string Name() const;
};

struct SetPair {
  PointCloud source;
  PointCloud target;

  // Nullopt if they have nothing in common.
  std::optional<Rigid3> true_target_from_source;
  std::optional<Rigid3> twin_target_from_source;

  Attitude source_ins;  // As measured.
  Attitude target_ins;
  Rigid3 world_from_source;  // Each in its own world.
  Rigid3 world_from_target;
  std::string variant, sensor, apart;
  uint64_t seed = 0;  // Of the source's world.
  uint64_t target_seed = 0;
};

// Pair `index` of the set. Returns nullopt and sets *error if the options are
// invalid.
std::optional<SetPair> SimulateSetPair(const PairSetOptions& options,
                                       int index,
                                       std::string* error);

// For a verdict's calibration: `scale` of 750 pairs with common ground (250
// streets, 100 crossings, 100 each of the other kinds of world) and as many
// without.
std::vector<PairSetOptions> CalibrationSets(uint64_t seed, double scale);

// Called after each pair, of any set.
using PairProgress = std::function<void(int num_done, int num_pairs)>;

// Simulates the pairs that the folder lacks, `num_threads` at a time (0: as
// many as the machine has), and writes the lists when all are there. Returns
// false and sets *error if options are invalid, if two sets have one name, if
// the folder holds something else or sets of other options, or if it can't be
// written. More pairs of the same sets may be asked for later.
bool WritePairSets(const std::vector<PairSetOptions>& sets,
                   const std::string& output_dir,
                   int num_threads,
                   const PairProgress& progress,
                   std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PAIR_SETS_H_
