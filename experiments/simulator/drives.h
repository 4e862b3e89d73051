// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Simulated drives that replace sequences of KITTI odometry and a building of
// NAVER LABS, by name:
//
//   00, 05  many loops, in both directions
//   02      long, hilly, with many gaps between houses
//   06      one long block, revisited in the same direction
//   07      one small block
//   08      two blocks, revisited in the opposite direction
//   hd_b1   halls and corridors, VLP-16
//
// Their paths are similar in shape to those of their namesakes. They are only
// as realistic as the simulator (measured by
// experiments/scripts/compare_kitti.py). They are written in the layout of
// kitti_layout.h or naver_layout.h, with the readings of an INS.

#ifndef QUATRO_EXPERIMENTS_SIMULATOR_DRIVES_H_
#define QUATRO_EXPERIMENTS_SIMULATOR_DRIVES_H_

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiments/simulator/scene.h"
#include "experiments/simulator/sequence_writer.h"
#include "features/base/rigid3.h"

namespace quatro {

std::vector<std::string> DriveNames();

struct DriveOptions {
  std::string name = "00";
  uint64_t seed = 1;            // Seed of world, noise and traffic.
  int num_frames = 0;           // 0: to the end of the path.
  double frame_spacing = 1.0;   // [m], at 10 Hz.
  std::string sensor = "auto";  // See sensors.h; auto: by the drive.

  // If true, the sensor moves during a scan, and points are not corrected for
  // it.
  bool has_sweep_motion = false;

  int num_moving_cars = 15;    // In a city.
  double tilt_sigma = 0.0052;  // Roll and pitch (suspension) [rad].

  // Errors of the INS in roll, pitch and yaw: noise per frame, and a constant
  // bias per drive [rad].
  double ins_sigma = 0.0009;
  double ins_bias_sigma = 0.005;

  std::string layout = "kitti";  // Or naver.
  int num_threads = 1;           // 0: as many as the machine has.
  bool overwrite = false;

  bool IsValid(std::string* error) const;
};

struct Drive {
  Scene scene;
  std::vector<Rigid3> world_from_sensor;  // Per frame.
  std::string sensor;

  // The moving objects in frame i.
  std::function<Scene(int frame)> moving;
};

// `options` must be valid.
Drive MakeDrive(const DriveOptions& options);

// The INS at each frame of a drive.
std::vector<InsReading> MeasureDrive(const Drive& drive,
                                     const DriveOptions& options);

// Like SimulateSequence() of simulator.h.
bool SimulateDrive(const DriveOptions& options,
                   const std::string& output_dir,
                   const std::function<void(int, int)>& progress,
                   std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_SIMULATOR_DRIVES_H_
