// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Pairs of neighboring frames in a drive: frame i + k to frame i, for an
// interval k. The paper's odometry (Table II: k = 1, 3, 5) and its added yaw (k
// = 5) register such pairs.

#ifndef QUATRO_EXPERIMENTS_PROTOCOLS_INTERVAL_PAIRS_H_
#define QUATRO_EXPERIMENTS_PROTOCOLS_INTERVAL_PAIRS_H_

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "experiments/datasets/pair_selection.h"
#include "experiments/datasets/sequence_data.h"

namespace quatro {

struct IntervalPairOptions {
  std::vector<int> intervals = {1, 3, 5};  // k
  int first_frame = -1;                    // -1: the frame of the first scan.
  int last_frame = -1;                     // Largest i + k; -1: the last frame.

  // If true, i - first_frame is a multiple of k, so that the pairs form a
  // chain, as in an odometry.
  bool is_chain = false;

  // The number of pairs per interval, drawn evenly by the seed; 0: all.
  int max_pairs = 0;
  uint64_t seed = 1;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// Pairs by interval, with bins such as "interval 3". Pairs with a frame without
// a pose are counted and left out before drawing. Returns nullopt with *error
// set if the options are invalid.
std::optional<PairSelection> SelectIntervalPairs(
    const SequenceData& data,
    const IntervalPairOptions& options,
    std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PROTOCOLS_INTERVAL_PAIRS_H_
