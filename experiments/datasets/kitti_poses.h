// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Poses in the format of KITTI odometry. Each line is one frame, with 12
// numbers, the rows of a 3x4 matrix
//
//   P_i = cam0 of frame i in cam0 of frame 0.
//
// The calibration Tr moves points of the lidar into cam0. With world_from_scan
// of experiments/odometry/odometry.h,
//
//   P_i = Tr world_from_scan_i Tr^-1.                                      (1)
//
// Files store rotations with about six digits. Each rotation is replaced by the
// nearest valid one when it is read.

#ifndef QUATRO_EXPERIMENTS_DATASETS_KITTI_POSES_H_
#define QUATRO_EXPERIMENTS_DATASETS_KITTI_POSES_H_

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "features/base/rigid3.h"

namespace quatro {

// Returns the nearest rigid motion, or nullopt if an entry of the left block
// differs by more than 1e-3 from the nearest rotation.
std::optional<Rigid3> NearestRigid3(const Eigen::Matrix<double, 3, 4>& matrix);

// Returns nullopt with one line in *error, which names file, line and reason,
// unless each line has 12 finite numbers that form a rigid motion. Blank lines
// are allowed only at the end.
std::optional<std::vector<Rigid3>> ReadKittiPoses(const std::string& path,
                                                  std::string* error);

std::string FormatKittiPoses(const std::vector<Rigid3>& poses);

// Reads Tr from a calib.txt.
std::optional<Rigid3> ReadKittiCalibration(const std::string& path,
                                           std::string* error);

// Equation (1).
std::vector<Rigid3> MoveToCam0(const std::vector<Rigid3>& world_from_scan,
                               const Rigid3& cam0_from_lidar);

// The poses of the given frames. Returns nullopt with *error set if one is
// missing.
std::optional<std::vector<Rigid3>> SelectFrames(
    const std::vector<Rigid3>& poses,
    const std::vector<int>& frames,
    std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_DATASETS_KITTI_POSES_H_
