// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The relative tilt between two visits of a place. The paper assumes that a
// ground vehicle's rotation changes mostly in heading. The true rotation of a
// pair is split as
//
//   R = R_z(yaw) R_y(pitch) R_x(roll),   tilt = angle of R_y(pitch) R_x(roll),
//
// where the tilt is in [0, pi] and yaw in [-pi, pi].

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

// The tilts of all loops in the bin.
std::vector<RelativeTilting> MeasureTilts(const SequenceData& data,
                                          const DistanceBin& bin,
                                          const LoopOptions& options);

// CSV with a header line: set, source, target, distance_m, yaw_deg,
// rollpitch_deg, roll_deg, pitch_deg.
std::string FormatTilts(const std::vector<RelativeTilting>& tilts);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PROTOCOLS_TILT_H_
