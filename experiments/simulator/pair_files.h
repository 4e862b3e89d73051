// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Sets of simulated pairs (pair_sets.h) on disk:
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
//                                     far_apart or other_floor of a negative.
//                                     The last are of a set WORLD_floor: walls
//                                     and pillars are alike, so a pose does fit
//   source_rpy_deg,target_rpy_deg     "roll,pitch,yaw" of the sensors as an INS
//                                     has them, for the flags of that name
//   ins_std_deg                       of each of these angles
//   twin_tx ... twin_qw               of worlds with a symmetry: the other pose
//                                     by which the scans fit. Where nothing
//                                     breaks the symmetry the set is WORLD_twin
//
// What is written does not depend on threads, on the number of pairs, or on
// what was there before.

#ifndef QUATRO_EXPERIMENTS_SIMULATOR_PAIR_FILES_H_
#define QUATRO_EXPERIMENTS_SIMULATOR_PAIR_FILES_H_

#include <functional>
#include <string>
#include <vector>

#include "experiments/simulator/pair_sets.h"

namespace quatro {

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

#endif  // QUATRO_EXPERIMENTS_SIMULATOR_PAIR_FILES_H_
