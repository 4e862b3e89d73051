// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// One drive of a data set, before any scan is read. With the true pose W_i of
// frame i, points of frame i are moved into frame j by
//
//   x_in_j = W_j^-1 W_i x_in_i.                                           (1)
//
// Frames keep the numbers of the data set, which need not be consecutive. Each
// reader has its own file in this folder.

#ifndef QUATRO_EXPERIMENTS_DATASETS_SEQUENCE_DATA_H_
#define QUATRO_EXPERIMENTS_DATASETS_SEQUENCE_DATA_H_

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiments/datasets/pair_task.h"
#include "features/base/rigid3.h"
#include "solvers/closed_form/gravity.h"

namespace quatro {

struct SequenceData {
  std::string name;  // "00"

  // The scan file of each frame that has a scan or a pose, whether or not the
  // file exists.
  std::map<int, std::string> scans;

  std::map<int, Rigid3> world_from_sensor;  // True poses, in one world.

  // The attitude (world from sensor) from an INS, in one world, which may
  // differ from the world of the true poses. Empty, or available for some
  // frames.
  std::map<int, Attitude> ins;
  double ins_std = 0.0;  // Each of roll and pitch [rad].

  int num_missing_scans = 0;  // Frames with a pose but no file.
  int num_missing_poses = 0;  // Frames with a file but no pose.

  // Notes for the user about missing data and choices made, one per line.
  std::vector<std::string> notes;
};

// Adds scan paths for frames that have a pose but no scan, counts frames
// without a scan and frames without a pose, and notes both.
void CountMissing(const std::function<std::string(int frame)>& path_of_scan,
                  SequenceData* data);

// The first frame whose file exists. If no file exists, the first frame, or 0
// if there are no frames.
int FirstScan(const SequenceData& data);

// "3, 7-9 and 12": consecutive frames become a range. Only the first five
// entries are listed, then "... (41 in all)". `frames` must be sorted.
std::string FormatFrames(const std::vector<int>& frames);

// A task with the true pose by (1), named "00/004413-000850", with set "00" and
// no bin, and with the INS if both frames have one. Returns nullopt if either
// frame has no pose.
std::optional<PairTask> MakePairTask(const SequenceData& data,
                                     int source_frame,
                                     int target_frame);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_DATASETS_SEQUENCE_DATA_H_
