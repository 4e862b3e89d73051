// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A sequence of NAVER LABS' indoor localization data sets (HD_B1 is
// HyundaiDepartmentStore/B1), in the text form of kapture in which they are
// distributed. Of FOLDER, FOLDER/mapping or FOLDER/release/mapping, the first
// that has a sensors/, these are read:
//
//   sensors/records_lidar.txt   stamp, lidar, path below sensors/records_data
//   sensors/trajectories.txt    stamp, device, qw, qx, qy, qz, tx, ty, tz
//   sensors/rigs.txt            rig, device, qw, qx, qy, qz, tx, ty, tz; may be
//                               missing
//   sensors/records_ins.txt     stamp, ins, roll, pitch, yaw [rad]; of
//                               quatro_simulate alone (naver_layout.h)
//
// Values are separated by commas, blanks around them do not count, and lines
// that are empty or start with # are passed over. Stamps are integers. A pose
// is device from world, that of a rig is device from rig, so that
//
//   W_i = (lidar_from_rig rig_from_world_i)^-1,                           (1)
//
// or without the first where the trajectory is the lidar's own. Frames are
// numbered from 0 in order of their stamps. sensors.txt, images and the older
// form with a groundtruth.hdf5 are not read.
//
// Scans stay as they are stored. On NAVER LABS' robot lidar0 looks down, so
// that a turn about its z is one about the vertical; lidar1 lies on its side,
// where no yaw alone will do.

#ifndef QUATRO_EXPERIMENTS_DATASETS_NAVER_H_
#define QUATRO_EXPERIMENTS_DATASETS_NAVER_H_

#include <optional>
#include <string>

#include "experiments/datasets/sequence_data.h"

namespace quatro {

struct NaverOptions {
  std::string folder;

  // Of the lidar. Empty: the first by name, noted if there are others.
  std::string lidar;

  // Of the set. Empty: the folder's name; of names such as release and mapping
  // that of the folder around them.
  std::string name;

  double ins_std = 0.0087;  // [rad]

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// Nullopt with one line in *error, which names the file and the line, if one of
// these files can't be read or the lidar has no records. Single scans and poses
// that are missing are counted and noted.
std::optional<SequenceData> ReadNaver(const NaverOptions& options,
                                      std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_DATASETS_NAVER_H_
