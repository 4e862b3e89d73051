// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Scans of a simulated street with their true poses: in memory as a pair, or
// on disk as a sequence (kitti_layout.h) without an INS.
//
// The sensor is the model of lidar.h on a car that follows the ground of
// road.h. It does not move during a scan.

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
  uint64_t seed = 1;       // Of the street and of the noise.
  double distance = 10.0;  // The source is this far ahead of the target [m].
  double yaw = 0.0;        // Turns the car of the source [rad].
  double lateral = 0.0;    // Moves it to the left, seen from the target [m].
  double slope = 0.0;      // [rad]
  double tilt_sigma = 0.0052;  // Of roll and pitch on the springs [rad].
  int num_threads = 1;         // 0: as many as the machine has.
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
  int num_threads = 1;         // 0: as many as the machine has.
  LidarOptions lidar;

  // Replaces a sequence that is there already.
  bool overwrite = false;

  bool IsValid(std::string* error) const;
};

// Called after each frame.
using SimulateProgress = std::function<void(int num_done, int num_frames)>;

// Writes the sequence beside `output_dir` and renames it when it is complete.
// Returns false and sets *error if the options are invalid, if the folder
// holds anything (with overwrite: anything but a sequence), or if it can't be
// written. `progress` may be empty.
bool SimulateSequence(const SimulateSequenceOptions& options,
                      const std::string& output_dir,
                      const SimulateProgress& progress,
                      std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_SIMULATOR_SIMULATOR_H_
