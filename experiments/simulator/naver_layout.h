// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A drive on disk in the layout of NAVER LABS' indoor data sets (kapture 1.1),
// with one lidar:
//
//   sensors/sensors.txt          lidar0, , lidar
//   sensors/records_lidar.txt    stamp, lidar0, lidar0/000000.pcd
//   sensors/trajectories.txt     stamp, lidar0, qw, qx, qy, qz, tx, ty, tz
//   sensors/records_ins.txt      stamp, ins0, roll, pitch, yaw
//   sensors/records_data/lidar0/000000.pcd ...
//
// Poses are lidar from world, the inverse of ours. Stamps are in microseconds,
// angles in radians. The INS is a custom record type, which kapture allows;
// NAVER LABS' data sets have none.

#ifndef QUATRO_EXPERIMENTS_SIMULATOR_NAVER_LAYOUT_H_
#define QUATRO_EXPERIMENTS_SIMULATOR_NAVER_LAYOUT_H_

#include <memory>
#include <string>

#include "experiments/simulator/sequence_writer.h"

namespace quatro {

// Returns nullptr and sets *error if the folder cannot be created.
std::unique_ptr<SequenceWriter> MakeNaverWriter(const std::string& output_dir,
                                                bool overwrite,
                                                std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_SIMULATOR_NAVER_LAYOUT_H_
