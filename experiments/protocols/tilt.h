// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// How much less than its heading the rest of a ground vehicle's rotation
// changes between two visits of a place, on which the paper builds. The true
// rotation of a pair is split as
//
//   R = R_z(yaw) R_y(pitch) R_x(roll),   tilt = angle of R_y(pitch) R_x(roll),
//
// which is an angle of 0 .. pi; yaw is in [-pi, pi].

#ifndef QUATRO_EXPERIMENTS_PROTOCOLS_TILT_H_
#define QUATRO_EXPERIMENTS_PROTOCOLS_TILT_H_

#include <string>
#include <vector>

#include "experiments/datasets/sequence_data.h"
#include "experiments/protocols/loop_pairs.h"

namespace quatro {

struct RelativeTilting {
  std::string set;
  Loop loop;
  double yaw = 0.0;    // [rad]
  double roll = 0.0;   // [rad]
  double pitch = 0.0;  // [rad]
  double tilt = 0.0;   // [rad]
};

// Of all loops in the bin.
std::vector<RelativeTilting> MeasureTilts(const SequenceData& data,
                                          const DistanceBin& bin,
                                          const LoopOptions& options);

// A line of CSV each, under one of names: set, source, target, distance_m,
// yaw_deg, rollpitch_deg, roll_deg, pitch_deg.
std::string FormatTilts(const std::vector<RelativeTilting>& tilts);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PROTOCOLS_TILT_H_
