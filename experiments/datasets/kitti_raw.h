// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A drive of KITTI raw:
//
//   FOLDER/velodyne_points/data/0000000000.bin ...   the name is the frame
//   FOLDER/oxts/data/0000000000.txt ...              (oxts.h)
//   calib_imu_to_velo.txt                            in FOLDER or around it
//
// The true poses are those of the INS, with I of that file (velodyne from IMU),
//
//   W_i = world_from_imu_i I^-1.                                          (1)
//
// They are good over a few hundred frames and off by up to metres where a drive
// comes by again. There is no INS to be had beside them: it is the truth here.

#ifndef QUATRO_EXPERIMENTS_DATASETS_KITTI_RAW_H_
#define QUATRO_EXPERIMENTS_DATASETS_KITTI_RAW_H_

#include <optional>
#include <string>

#include "experiments/datasets/sequence_data.h"

namespace quatro {

// Nullopt with one line in *error, which names the file and the line, if there
// are no scans or oxts and calibration can't be read. Single scans and readings
// that are missing are counted and noted.
std::optional<SequenceData> ReadKittiRaw(const std::string& folder,
                                         std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_DATASETS_KITTI_RAW_H_
