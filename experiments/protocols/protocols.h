// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Protocols that register pairs of scans, by name. They select tasks from the
// drives of a data set or from a list of pairs.
//
//   loop      revisited places, by distance (Tables I and III)
//   interval  frame i + k to frame i (pairs of Table II)
//   yaw       interval pairs with sources rotated by 0 .. 180 deg
//   timing    loop pairs, one at a time on one thread
//   pairs     a list

#ifndef QUATRO_EXPERIMENTS_PROTOCOLS_PROTOCOLS_H_
#define QUATRO_EXPERIMENTS_PROTOCOLS_PROTOCOLS_H_

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "experiments/datasets/pair_selection.h"
#include "experiments/datasets/sequence_data.h"
#include "experiments/protocols/distance_bin.h"

namespace quatro {

// All protocols except `pairs`, which needs no drives.
std::vector<std::string> DriveProtocolNames();

struct ProtocolOptions {
  std::string name = "loop";
  std::vector<DistanceBin> bins = TableThreeBins();  // Loop and timing.
  int min_frame_gap = 100;                           // Loops.
  double min_path = 50.0;                            // Loops [m].
  double min_pair_spacing = 0.0;                     // Loops [m].
  std::vector<int> intervals = {1, 3, 5};  // Interval; yaw takes the last.
  double yaw_step_deg = 30.0;              // Yaw.

  // The maximum per drive and per bin or interval; 0: all.
  int max_pairs = 100;
  int max_pairs_per_source = 1;  // Loop and timing; 0: all.
  uint64_t seed = 1;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// Pairs by drive. Returns nullopt with *error set if the options are invalid.
std::optional<PairSelection> SelectPairs(
    const std::vector<SequenceData>& drives,
    const ProtocolOptions& options,
    std::string* error);

// Parses bins such as "0-2,4-6" [m]. Returns nullopt with *error set if the
// text is invalid.
std::optional<std::vector<DistanceBin>> ParseBins(const std::string& text,
                                                  std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PROTOCOLS_PROTOCOLS_H_
