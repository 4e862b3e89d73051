// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Reads a sequence in any of the supported layouts, which the folder's contents
// select:
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

  // Empty, or the name of a sequence below `folder`. KITTI odometry searches
  // for it as kitti_odometry.h describes; the other layouts use FOLDER/NAME.
  std::string sequence;

  double ins_std = 0.0087;  // [rad]
};

// See the reader of the selected layout.
std::optional<SequenceData> ReadAnySequence(const AnySequenceOptions& options,
                                            std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_DATASETS_ANY_SEQUENCE_H_
