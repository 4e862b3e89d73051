// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Revisited places in a drive. With the true position p_i of frame i and the
// length s_i of the true path up to it, frames i > j are a loop of the bin [a,
// b) if
//
//   i - j > min_frame_gap,  s_i - s_j >= min_path,  a <= |p_i - p_j| < b. (1)
//
// The later frame is the source, the earlier one the target. The paper states
// neither a gap nor a path for its loops (Tables I and III). At 10 Hz, 100
// frames are 10 s. The minimum path excludes a vehicle that waits at a traffic
// light for longer. The kitti_lc lists have a gap of 250 frames.
//
// With min_pair_spacing = d > 0 only some frames are used: the first one, and
// each that is at least d along the path after the last one used. Two loops
// then differ by at least d along the path in source or target.

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
  double min_path = 50.0;         // [m]
  double min_pair_spacing = 0.0;  // d [m]

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

struct Loop {
  int source = 0;  // Frame numbers.
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

  // The number of pairs per bin; 0: all.
  int max_pairs_per_bin = 100;

  // The number of pairs per source frame and bin; 0: all. Pairs with the same
  // source are similar. KITTI 07 has only 86 sources at 9-12 m.
  int max_pairs_per_source = 1;
  uint64_t seed = 1;

  bool IsValid(std::string* error) const;
};

// Pairs by bin in the given order, and by source within a bin. Targets are
// drawn evenly (draw_evenly.h) from all targets of a source in the bin, and
// then pairs from those of all sources. The pairs of a bin depend only on the
// sequence, the bounds of the bin, the numbers and the seed. Returns nullopt
// with *error set if the options are invalid. Bins with fewer pairs than
// requested are noted.
std::optional<PairSelection> SelectLoopPairs(const SequenceData& data,
                                             const LoopPairOptions& options,
                                             std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PROTOCOLS_LOOP_PAIRS_H_
