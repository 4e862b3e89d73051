// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A sequence of KITTI odometry, or one that quatro_simulate wrote:
//
//   FOLDER/velodyne/000000.bin ...   or .ply, .pcd; the name is the frame
//   FOLDER/calib.txt                 Tr: velodyne points into cam0
//   FOLDER/poses.txt                 as SemanticKITTI and quatro_simulate have
//                                    it; or, as the benchmark has it,
//   FOLDER/../../poses/NAME.txt      where NAME is that of FOLDER
//   FOLDER/oxts/data/..., FOLDER/calib_imu_to_velo.txt   if there (oxts.h)
//
// Poses are those of cam0, so that those of the sensor are
//
//   W_i = Tr^-1 P_i Tr,                                                   (1)
//
// rotations replaced by the nearest (kitti_poses.h). Frames are lines of the
// poses, from 0.
//
// The INS is the first of these that is there: ins_poses; oxts, moved to the
// sensor by calib_imu_to_velo.txt, or taken as the sensor's without one; the
// benchmark's own poses, if the true ones are of a poses.txt. KITTI's poses and
// oxts come from one GPS and INS: errors against the former say nothing of the
// latter.

#ifndef QUATRO_EXPERIMENTS_DATASETS_KITTI_ODOMETRY_H_
#define QUATRO_EXPERIMENTS_DATASETS_KITTI_ODOMETRY_H_

#include <optional>
#include <string>
#include <vector>

#include "experiments/datasets/sequence_data.h"

namespace quatro {

struct KittiOdometryOptions {
  // That of one sequence; or with `sequence`, one that holds it as
  // sequences/NAME, dataset/sequences/NAME or NAME.
  std::string folder;
  std::string sequence;

  // Empty: where the layout has them.
  std::string poses;
  std::string calibration;

  // A second file of poses whose attitudes are the INS. Empty: see above.
  std::string ins_poses;

  double ins_std = 0.0087;  // Taken for any of them [rad].

  // Does not list velodyne/, which need not be there.
  bool poses_only = false;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// The names that `sequence` may have in a folder, sorted; none if it holds no
// sequences.
std::vector<std::string> ListKittiSequences(const std::string& folder);

// Nullopt with one line in *error, which names the file and the line, if the
// scans can't be listed or poses or calibration can't be read. Single scans and
// poses that are missing are counted and noted.
std::optional<SequenceData> ReadKittiOdometry(
    const KittiOdometryOptions& options, std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_DATASETS_KITTI_ODOMETRY_H_
