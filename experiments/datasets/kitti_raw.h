// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A drive of KITTI raw:
//
//   FOLDER/velodyne_points/data/0000000000.bin ...   the name is the frame
//   FOLDER/oxts/data/0000000000.txt ...              (oxts.h)
//   calib_imu_to_velo.txt                            in FOLDER or its parent
//
// The true poses are those of the INS. With I = velodyne_from_imu from
// calib_imu_to_velo.txt,
//
//   W_i = world_from_imu_i I^-1.                                          (1)
//
// They are accurate over a few hundred frames, and off by up to some meters
// where a drive revisits a place. There is no separate INS, because the INS is
// the ground truth here.

#ifndef QUATRO_EXPERIMENTS_DATASETS_KITTI_RAW_H_
#define QUATRO_EXPERIMENTS_DATASETS_KITTI_RAW_H_

#include <optional>
#include <string>

#include "experiments/datasets/sequence_data.h"

namespace quatro {

// Returns nullopt with one line in *error, which names file and line, if there
// are no scans or if oxts or calibration cannot be read. Single missing scans
// and readings are counted and noted.
std::optional<SequenceData> ReadKittiRaw(const std::string& folder,
                                         std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_DATASETS_KITTI_RAW_H_
