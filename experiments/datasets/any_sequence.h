// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A sequence of whatever layout its folder has:
//
//   velodyne_points/    KITTI raw (kitti_raw.h)
//   sensors/, mapping/sensors/ or release/mapping/sensors/
//                       NAVER LABS (naver.h)
//   anything else       KITTI odometry (kitti_odometry.h)

#ifndef QUATRO_EXPERIMENTS_DATASETS_ANY_SEQUENCE_H_
#define QUATRO_EXPERIMENTS_DATASETS_ANY_SEQUENCE_H_

#include <optional>
#include <string>

#include "experiments/datasets/sequence_data.h"

namespace quatro {

struct AnySequenceOptions {
  std::string folder;

  // Empty, or the name of one below `folder`: of KITTI odometry as
  // kitti_odometry.h looks for it, of the others FOLDER/NAME.
  std::string sequence;

  double ins_std = 0.0087;  // [rad]
};

// As the reader of that layout.
std::optional<SequenceData> ReadAnySequence(const AnySequenceOptions& options,
                                            std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_DATASETS_ANY_SEQUENCE_H_
