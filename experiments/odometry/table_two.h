// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Table II of the Quatro paper: drift of odometries at frame intervals 1, 3 and
// 5. Each row names its origin: measured in this run, computed from poses in a
// file (of any program), or quoted from the paper, which used KITTI 00 and the
// original programs. A measured or computed row appears next to the quoted row
// of the same method and never takes numbers from it.

#ifndef QUATRO_EXPERIMENTS_ODOMETRY_TABLE_TWO_H_
#define QUATRO_EXPERIMENTS_ODOMETRY_TABLE_TWO_H_

#include <optional>
#include <string>
#include <vector>

#include "experiments/metrics/kitti_metrics.h"
#include "experiments/tables/table.h"
#include "features/base/rigid3.h"

namespace quatro {

enum class DriftOrigin { kMeasured, kFile, kQuoted };

struct DriftEntry {
  std::string method;
  int interval = 1;
  double translation_percent = 0.0;
  double rotation_deg_per_100m = 0.0;
  DriftOrigin origin = DriftOrigin::kMeasured;

  // Set for measured entries only.
  std::optional<int> num_lost;
  std::optional<double> median_seconds;  // Per scan.
};

// The paper's results on KITTI 00.
std::vector<DriftEntry> QuotedTableTwo();

// Drift of a file of KITTI poses, written by any program: one line for each of
// `frames`, the frames of the run, or one for every frame of the drive. Returns
// nullopt and one line in *error otherwise. `true_poses` covers the whole
// drive.
std::optional<DriftEntry> DriftOfPoseFile(const std::string& method,
                                          int interval,
                                          const std::string& path,
                                          const std::vector<Rigid3>& true_poses,
                                          const std::vector<int>& frames,
                                          std::string* error);

// One row per method and origin, in order of first occurrence; two columns per
// interval.
Table MakeTableTwo(const std::vector<DriftEntry>& entries);

// Only the drift, as in the paper, without values that depend on the machine;
// and the same table in LaTeX.
Table MakeDriftTable(const std::vector<DriftEntry>& entries);
std::string FormatTableTwoLatex(const std::vector<DriftEntry>& entries);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_ODOMETRY_TABLE_TWO_H_
