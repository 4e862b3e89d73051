// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Scans of a simulated street with their true poses: in memory as a pair, or on
// disk as a sequence (kitti_layout.h) without an INS.
//
// The sensor is the model of lidar.h on a car that follows the ground of
// road.h. It is stationary during a scan.

#ifndef QUATRO_EXPERIMENTS_SIMULATOR_SIMULATOR_H_
#define QUATRO_EXPERIMENTS_SIMULATOR_SIMULATOR_H_

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "experiments/simulator/lidar.h"
#include "features/base/rigid3.h"
#include "features/io/point_cloud.h"

namespace quatro {

struct SimulatePairOptions {
  uint64_t seed = 1;           // Seed of street and noise.
  double distance = 10.0;      // Source ahead of the target [m].
  double yaw = 0.0;            // Rotation of the source car [rad].
  double lateral = 0.0;        // Shift to the left as seen from the target [m].
  double slope = 0.0;          // [rad]
  double tilt_sigma = 0.0052;  // Roll and pitch (suspension) [rad].
  int num_threads = 1;         // 0: all cores.
  LidarOptions lidar;

  bool IsValid(std::string* error) const;
};

struct SimulatedPair {
  PointCloud source;
  PointCloud target;
  Rigid3 true_target_from_source;
};

// Returns nullopt and sets *error if the options are invalid.
std::optional<SimulatedPair> SimulatePair(const SimulatePairOptions& options,
                                          std::string* error);

struct SimulateSequenceOptions {
  uint64_t seed = 1;
  int num_frames = 100;
  double frame_spacing = 1.0;  // [m]
  double slope = 0.0;          // [rad]
  double tilt_sigma = 0.0052;  // [rad]
  int num_threads = 1;         // 0: all cores.
  LidarOptions lidar;

  // Replaces an existing sequence.
  bool overwrite = false;

  bool IsValid(std::string* error) const;
};

// Called after each frame.
using SimulateProgress = std::function<void(int num_done, int num_frames)>;

// Writes the sequence beside `output_dir` and renames it when it is complete.
// Returns false and sets *error if the options are invalid, if the folder is
// not empty (with overwrite: contains anything but a sequence), or if it cannot
// be written. `progress` may be empty.
bool SimulateSequence(const SimulateSequenceOptions& options,
                      const std::string& output_dir,
                      const SimulateProgress& progress,
                      std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_SIMULATOR_SIMULATOR_H_
