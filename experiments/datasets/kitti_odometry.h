// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A sequence of KITTI odometry, or one written by quatro_simulate:
//
//   FOLDER/velodyne/000000.bin ...   or .ply, .pcd; the name is the frame
//   FOLDER/calib.txt                 Tr: velodyne points into cam0
//   FOLDER/poses.txt                 as in SemanticKITTI and quatro_simulate,
//                                    or, as in the benchmark,
//   FOLDER/../../poses/NAME.txt      where NAME is the name of FOLDER
//   FOLDER/oxts/data/..., FOLDER/calib_imu_to_velo.txt   optional (oxts.h)
//
// The poses are those of cam0. The poses of the sensor are
//
//   W_i = Tr^-1 P_i Tr,                                                   (1)
//
// with rotations replaced by the nearest ones (kitti_poses.h). Frame i is line
// i of the poses, from 0.
//
// The INS is the first available of these: ins_poses; oxts, moved to the sensor
// by calib_imu_to_velo.txt, or without that file taken as the sensor's own; the
// benchmark's poses, if the true poses come from another file. KITTI's poses
// and oxts come from the same GPS and INS, so errors relative to the poses say
// nothing about the oxts.

#ifndef QUATRO_EXPERIMENTS_DATASETS_KITTI_ODOMETRY_H_
#define QUATRO_EXPERIMENTS_DATASETS_KITTI_ODOMETRY_H_

#include <optional>
#include <string>
#include <vector>

#include "experiments/datasets/sequence_data.h"

namespace quatro {

struct KittiOdometryOptions {
  // The folder of one sequence, or, if `sequence` is set, a folder that
  // contains it as sequences/NAME, dataset/sequences/NAME or NAME.
  std::string folder;
  std::string sequence;

  // Empty: the files of the layout above.
  std::string poses;
  std::string calibration;

  // A second file of poses, whose attitudes are used as the INS. Empty: the INS
  // is chosen as described above.
  std::string ins_poses;

  double ins_std = 0.0087;  // For any INS [rad].

  // Does not list velodyne/, which may then be missing.
  bool poses_only = false;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// The valid values of `sequence` for a folder, sorted. Empty if the folder
// contains no sequences.
std::vector<std::string> ListKittiSequences(const std::string& folder);

// Returns nullopt with one line in *error, which names file and line, if the
// scans cannot be listed or poses or calibration cannot be read. Single missing
// scans and poses are counted and noted.
std::optional<SequenceData> ReadKittiOdometry(
    const KittiOdometryOptions& options, std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_DATASETS_KITTI_ODOMETRY_H_
