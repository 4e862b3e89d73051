// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Table II of the Quatro paper: drift of odometries at frame intervals 1, 3 and
// 5. A row is of one origin, which it names: measured in this run, computed
// from poses in a file (any program's), or quoted from the paper, where it is
// of KITTI 00 and of the original programs. A method that is measured or has a
// file stands beside its quoted row and never takes figures from it.

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

  // Only of measured ones.
  std::optional<int> num_lost;
  std::optional<double> median_seconds;  // A scan.
};

// The figures of the paper, on KITTI 00.
std::vector<DriftEntry> QuotedTableTwo();

// What another program, or this one, left in a file of KITTI poses: one line
// for each of `frames`, the frames of the run, or one for every frame of the
// drive. Nullopt and one line in *error otherwise. `true_poses` are those of
// the drive.
std::optional<DriftEntry> DriftOfPoseFile(const std::string& method,
                                          int interval,
                                          const std::string& path,
                                          const std::vector<Rigid3>& true_poses,
                                          const std::vector<int>& frames,
                                          std::string* error);

// A row a method and origin, in the order in which they first come; a pair of
// columns an interval.
Table MakeTableTwo(const std::vector<DriftEntry>& entries);

// The drift alone, as the paper has it, without what depends on the machine;
// and that in LaTeX.
Table MakeDriftTable(const std::vector<DriftEntry>& entries);
std::string FormatTableTwoLatex(const std::vector<DriftEntry>& entries);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_ODOMETRY_TABLE_TWO_H_
