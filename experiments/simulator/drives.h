// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Drives that stand in for sequences of KITTI odometry and for a building of
// NAVER LABS', by name:
//
//   00, 05  many loops, both ways        02  long, hilly, between gaps
//   06      one long block, same way     07  one small block
//   08      two blocks, the other way    hd_b1  halls and corridors, VLP-16
//
// They are simulated, and as good as the simulator
// (experiments/scripts/compare_kitti.py says how good); what they share with
// their namesakes is the shape of the way. Written in the layout of
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
  uint64_t seed = 1;            // Of the world, the noise and the traffic.
  int num_frames = 0;           // 0: to the end of the way.
  double frame_spacing = 1.0;   // [m]; at 10 Hz.
  std::string sensor = "auto";  // One of sensors.h; auto: that of the name.

  // Points are where the moving sensor saw them, without a correction.
  bool has_sweep_motion = false;

  int num_moving_cars = 15;    // In a city.
  double tilt_sigma = 0.0052;  // Of roll and pitch on the springs [rad].

  // Of the INS' roll, pitch and yaw: noise of each frame, and what is the same
  // for all of a drive [rad].
  double ins_sigma = 0.0009;
  double ins_bias_sigma = 0.005;

  std::string layout = "kitti";  // Or naver.
  int num_threads = 1;           // 0: as many as the machine has.
  bool overwrite = false;

  bool IsValid(std::string* error) const;
};

struct Drive {
  Scene scene;
  std::vector<Rigid3> world_from_sensor;  // Of each frame.
  std::string sensor;

  // What else is there in frame i.
  std::function<Scene(int frame)> moving;
};

// `options` must be valid.
Drive MakeDrive(const DriveOptions& options);

// The INS at each frame of a drive.
std::vector<InsReading> MeasureDrive(const Drive& drive,
                                     const DriveOptions& options);

// As SimulateSequence() of simulator.h.
bool SimulateDrive(const DriveOptions& options,
                   const std::string& output_dir,
                   const std::function<void(int, int)>& progress,
                   std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_SIMULATOR_DRIVES_H_
