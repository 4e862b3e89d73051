// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A sequence on disk in the layout of KITTI odometry, with the INS of KITTI
// raw:
//
//   velodyne/000000.bin ...   float32 x y z intensity, sensor frame [m]
//   poses.txt                 P_i, 3x4 row by row: cam0 of frame i in cam0 of
//                             frame 0
//   calib.txt                 P0 .. P3, and Tr: sensor points into cam0
//   times.txt                 [s]
//   oxts/data/0000000000.txt  30 numbers per frame, see FormatOxts()
//
// Points of frame i are moved into frame j by
//
//   x_in_j = Tr^-1 P_j^-1 P_i Tr x_in_i.                                  (1)

#ifndef QUATRO_EXPERIMENTS_SIMULATOR_KITTI_LAYOUT_H_
#define QUATRO_EXPERIMENTS_SIMULATOR_KITTI_LAYOUT_H_

#include <memory>
#include <string>

#include "experiments/simulator/sequence_writer.h"
#include "features/base/rigid3.h"

namespace quatro {

// One line: lat lon alt [deg, deg, m] roll pitch yaw [rad] vn ve vf vl vu [m/s]
// ax ay az af al au [m/s^2] wx wy wz wf wl wu [rad/s], two accuracies and five
// states. Positions use the Mercator projection of KITTI's development kit,
// with the scale of a latitude of 49 deg.
std::string FormatOxts(const InsReading& reading);

// The mounting of cam0 in simulated sequences: x right, y down, z forward.
Rigid3 Cam0FromSensor();

// Returns nullptr and sets *error if the folder cannot be created.
std::unique_ptr<SequenceWriter> MakeKittiWriter(const std::string& output_dir,
                                                bool overwrite,
                                                std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_SIMULATOR_KITTI_LAYOUT_H_
