// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A sequence of NAVER LABS' indoor localization data sets (HD_B1 is
// HyundaiDepartmentStore/B1), in the text form of kapture in which they are
// distributed. These files are read from the first of FOLDER, FOLDER/mapping
// and FOLDER/release/mapping that contains sensors/:
//
//   sensors/records_lidar.txt   stamp, lidar, path below sensors/records_data
//   sensors/trajectories.txt    stamp, device, qw, qx, qy, qz, tx, ty, tz
//   sensors/rigs.txt            rig, device, qw, qx, qy, qz, tx, ty, tz;
//                               optional
//   sensors/records_ins.txt     stamp, ins, roll, pitch, yaw [rad]; only from
//                               quatro_simulate (naver_layout.h)
//
// Values are separated by commas, spaces around them are ignored, and so are
// lines that are empty or start with #. Stamps are integers. A pose is device
// from world, and a rig entry is device from rig, so that
//
//   W_i = (lidar_from_rig rig_from_world_i)^-1,                           (1)
//
// without lidar_from_rig if the trajectory is the lidar's own. Frames are
// numbered from 0 in order of their stamps. sensors.txt, images and the older
// form with a groundtruth.hdf5 are not read.
//
// Scans are used as stored. On NAVER LABS' robot, lidar0 looks down, so that a
// rotation about its z axis is one about the vertical. lidar1 lies on its side,
// so that a yaw alone cannot register its scans.

#ifndef QUATRO_EXPERIMENTS_DATASETS_NAVER_H_
#define QUATRO_EXPERIMENTS_DATASETS_NAVER_H_

#include <optional>
#include <string>

#include "experiments/datasets/sequence_data.h"

namespace quatro {

struct NaverOptions {
  std::string folder;

  // The name of the lidar. Empty: the first by name; a note is added if there
  // are others.
  std::string lidar;

  // The name of the set. Empty: the folder's name, or the name of its parent if
  // the folder's name is generic, such as release or mapping.
  std::string name;

  double ins_std = 0.0087;  // [rad]

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// Returns nullopt with one line in *error, which names file and line, if one of
// these files cannot be read or the lidar has no records. Single missing scans
// and poses are counted and noted.
std::optional<SequenceData> ReadNaver(const NaverOptions& options,
                                      std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_DATASETS_NAVER_H_
