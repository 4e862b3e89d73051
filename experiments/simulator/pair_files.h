// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Sets of simulated pairs (pair_sets.h) on disk:
//
//   street/000000_source.bin ...       float32 x y z intensity, sensor frame
//   pairs.csv            set,source,target,tx,ty,tz,qx,qy,qz,qw,distance_m,
//                        yaw_deg,rollpitch_deg, then the columns below
//   pairs_negative.csv   pairs without overlap: the same columns without a pose
//   rows/                the line of each pair, written after its scans
//   settings.json        the options of the sets
//
// Both lists continue with the columns
//
//   world,variant,sensor,seed,apart   the simulation; apart: other_seed,
//                                     far_apart or other_floor for a pair
//                                     without overlap. The set of other_floor
//                                     is WORLD_floor: walls and pillars are the
//                                     same, so that a pose fits
//   source_rpy_deg,target_rpy_deg     "roll,pitch,yaw" of the sensors as an INS
//                                     measures them, for the flags of that name
//   ins_std_deg                       of each of these angles
//   twin_tx ... twin_qw               in worlds with a symmetry: the other pose
//                                     at which the scans fit. If nothing breaks
//                                     the symmetry, the set is WORLD_twin
//
// The files do not depend on threads, on the number of pairs, or on files that
// existed before.

#ifndef QUATRO_EXPERIMENTS_SIMULATOR_PAIR_FILES_H_
#define QUATRO_EXPERIMENTS_SIMULATOR_PAIR_FILES_H_

#include <functional>
#include <string>
#include <vector>

#include "experiments/simulator/pair_sets.h"

namespace quatro {

// Called after each pair of any set.
using PairProgress = std::function<void(int num_done, int num_pairs)>;

// Simulates the pairs that the folder lacks, `num_threads` at a time (0: all
// cores), and writes the lists when all exist. Returns false and sets *error if
// options are invalid, if two sets have the same name, if the folder contains
// other files or sets with other options, or if it cannot be written. More
// pairs of the same sets can be added later.
bool WritePairSets(const std::vector<PairSetOptions>& sets,
                   const std::string& output_dir,
                   int num_threads,
                   const PairProgress& progress,
                   std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_SIMULATOR_PAIR_FILES_H_
