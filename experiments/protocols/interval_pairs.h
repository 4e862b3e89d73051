// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Neighbours in a drive: frame i + k onto frame i, for an interval k. The
// paper's odometry (Table II: k = 1, 3, 5) and its added yaw (k = 5) register
// such pairs.

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
  int first_frame = 0;
  int last_frame = -1;  // Of i + k; -1: the last.

  // i is a multiple of k more than first_frame, so that the pairs are a chain,
  // as an odometry's are.
  bool is_chain = false;

  // Of each interval, drawn evenly by the seed; 0: as many as there are.
  int max_pairs = 0;
  uint64_t seed = 1;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// Interval by interval, bins "interval 3". Pairs of which a frame has no pose
// are counted before any are drawn, and are no tasks. Nullopt with *error set
// if the options are invalid.
std::optional<PairSelection> SelectIntervalPairs(
    const SequenceData& data,
    const IntervalPairOptions& options,
    std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PROTOCOLS_INTERVAL_PAIRS_H_
