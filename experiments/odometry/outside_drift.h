// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Results for the rows of experiments/odometry/table_two.h: from a run of ours,
// or from files that other programs wrote.

#ifndef QUATRO_EXPERIMENTS_ODOMETRY_OUTSIDE_DRIFT_H_
#define QUATRO_EXPERIMENTS_ODOMETRY_OUTSIDE_DRIFT_H_

#include <optional>
#include <string>
#include <vector>

#include "experiments/datasets/sequence.h"
#include "experiments/metrics/kitti_metrics.h"
#include "experiments/odometry/table_two.h"

namespace quatro {

struct OutsideResult {
  std::string method;
  std::string path;  // KITTI poses.
};

// Parses "NAME=PATH,NAME=PATH"; empty text gives no results. Returns nullopt
// with *error set if a part has no name or no path.
std::optional<std::vector<OutsideResult>> ParseOutside(const std::string& text,
                                                       std::string* error);

DriftEntry MeasuredEntry(const std::string& method,
                         int interval,
                         const OdometryRun& run,
                         const KittiDrift& drift);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_ODOMETRY_OUTSIDE_DRIFT_H_
