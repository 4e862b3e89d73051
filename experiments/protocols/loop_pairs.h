// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Places that a drive comes by again. With p_i the true position of frame i and
// s_i the length of the true path up to it, frames i > j are a loop of a bin
// [a, b) if
//
//   i - j > min_frame_gap,  s_i - s_j >= min_path,  a <= |p_i - p_j| < b. (1)
//
// The later frame is the source, the earlier one the target. The paper tells
// neither gap nor path for its loops (Tables I and III): 100 frames are 10 s of
// a lidar at 10 Hz, and the path keeps out who waits at a light for longer. The
// lists kitti_lc have a gap of 250.

#ifndef QUATRO_EXPERIMENTS_PROTOCOLS_LOOP_PAIRS_H_
#define QUATRO_EXPERIMENTS_PROTOCOLS_LOOP_PAIRS_H_

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "experiments/datasets/pair_selection.h"
#include "experiments/datasets/sequence_data.h"
#include "experiments/protocols/distance_bin.h"

namespace quatro {

struct LoopOptions {
  int min_frame_gap = 100;
  double min_path = 50.0;  // [m]

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

struct Loop {
  int source = 0;  // Frames.
  int target = 0;
  double distance = 0.0;  // |p_i - p_j| [m]
};

// All loops of (1), by source and then target.
std::vector<Loop> FindLoops(const SequenceData& data,
                            const DistanceBin& bin,
                            const LoopOptions& options);

struct LoopPairOptions {
  LoopOptions loop;
  std::vector<DistanceBin> bins = TableThreeBins();

  // Of each bin; 0: as many as there are.
  int max_pairs_per_bin = 100;

  // In each bin, with one frame as the source; 0: as many as there are. Pairs
  // of one source are alike. KITTI 07 has but 86 sources at 9-12 m.
  int max_pairs_per_source = 1;
  uint64_t seed = 1;

  bool IsValid(std::string* error) const;
};

// Bin by bin in the order given, and by source in each. The targets are drawn
// evenly (draw_evenly.h) from all that a source has in the bin, and the pairs
// then from those of all sources. What is drawn for a bin depends on nothing
// but the sequence, its bounds, the numbers and the seed. Nullopt with *error
// set if the options are invalid; bins with fewer pairs than asked for are
// noted.
std::optional<PairSelection> SelectLoopPairs(const SequenceData& data,
                                             const LoopPairOptions& options,
                                             std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PROTOCOLS_LOOP_PAIRS_H_
