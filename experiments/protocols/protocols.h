// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Protocols that register pairs of scans, by name: from the drives of a data
// set, or a list of pairs, to tasks.
//
//   loop: places that a drive comes by again, by distance (Tables I and III)
//
//   interval: frame i + k onto frame i (Table II's pairs)
//
//   yaw: interval pairs with sources turned by 0 .. 180 deg
//
//   timing: loop pairs, one at a time on one thread
//
//   pairs: a list

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

// Those above but `pairs`, which needs no drives.
std::vector<std::string> DriveProtocolNames();

struct ProtocolOptions {
  std::string name = "loop";
  std::vector<DistanceBin> bins = TableThreeBins();  // Of loop and timing.
  int min_frame_gap = 100;                           // Of loops.
  double min_path = 50.0;                            // Of loops [m].
  std::vector<int> intervals = {1, 3, 5};  // Of interval; yaw takes the last.
  double yaw_step_deg = 30.0;              // Of yaw.

  // Of each drive, and of each bin or interval; 0: all there are.
  int max_pairs = 100;
  int max_pairs_per_source = 1;  // Of loop and timing; 0: all there are.
  uint64_t seed = 1;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// Drive by drive. Nullopt with *error set if the options are invalid.
std::optional<PairSelection> SelectPairs(
    const std::vector<SequenceData>& drives,
    const ProtocolOptions& options,
    std::string* error);

// "0-2,4-6" in metres. Nullopt with *error set.
std::optional<std::vector<DistanceBin>> ParseBins(const std::string& text,
                                                  std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PROTOCOLS_PROTOCOLS_H_
