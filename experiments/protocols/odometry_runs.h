// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Odometries over the drives of a data set at several frame intervals, the
// paper's Table II. A run is one method on one drive at one interval. It writes
// two files,
//
//   OUTPUT/odometry/00_aloam_3.txt    KITTI poses of the sensor, one line per
//                                     frame of the run; the first one is the
//                                     identity
//   OUTPUT/odometry/00_aloam_3.json   method, interval, frames, drift, time
//
// and writes the second when it is complete. A run that has this file is not
// repeated; an interrupted run starts over.
//
// The drift is that of the sensor's poses. The drift of cam0, which KITTI
// measures, differs because of the lever arm between them, by some decimeters
// in 100 m.

#ifndef QUATRO_EXPERIMENTS_PROTOCOLS_ODOMETRY_RUNS_H_
#define QUATRO_EXPERIMENTS_PROTOCOLS_ODOMETRY_RUNS_H_

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiments/datasets/sequence_data.h"
#include "experiments/odometry/table_two.h"
#include "features/io/cloud_io.h"
#include "robust/registration/registration.h"

namespace quatro {

struct OdometryRunOptions {
  std::vector<std::string> methods = {"quatro"};  // odometry_methods.h
  std::vector<int> intervals = {1, 3, 5};
  int max_frames = 0;  // Per drive, from its start; 0: all.
  RegistrationOptions registration;
  ReadCloudOptions reading;

  // Returns false and says why in *error if a value is out of range or a method
  // is unknown.
  bool IsValid(std::string* error) const;
};

struct OdometryResult {
  std::string drive;
  DriftEntry drift;                    // Percentages: NaN below 100 m.
  double path_length = 0.0;            // [m]
  double end_translation_error = 0.0;  // [m]
};

struct OdometryRunProgress {
  std::string drive;
  std::string method;
  int interval = 1;
  int num_done = 0;  // Scans of this run.
  int num_scans = 0;
};

// Runs by drive, interval and method. Returns nullopt with *error set if the
// options are invalid, a frame has no true pose, or a file cannot be written or
// belongs to another experiment.
std::optional<std::vector<OdometryResult>> RunOdometries(
    const std::vector<SequenceData>& drives,
    const OdometryRunOptions& options,
    const std::string& output,
    const std::function<void(const OdometryRunProgress&)>& progress,
    std::string* error);

// The means over the drives, or the values of a single drive, for
// MakeTableTwo(). A method without a segment of 100 m in any drive is left out.
std::vector<DriftEntry> MeanDrifts(const std::vector<OdometryResult>& results);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PROTOCOLS_ODOMETRY_RUNS_H_
