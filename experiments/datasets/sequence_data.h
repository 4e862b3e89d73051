// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// What a data set holds of one drive, before any scan is read. With W_i the
// true pose of frame i, points of frame i are moved into frame j by
//
//   x_in_j = W_j^-1 W_i x_in_i.                                           (1)
//
// Frames are numbered as the data set numbers them, and need not follow each
// other. Each reader is a file of its own beside this one.

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

  // Of each frame that has a scan or a pose, the file of its scan, there or
  // not.
  std::map<int, std::string> scans;

  std::map<int, Rigid3> world_from_sensor;  // True, of one world.

  // World from sensor as an INS has it, again of one world, which need not be
  // that of the true poses. Empty, or of some frames.
  std::map<int, Attitude> ins;
  double ins_std = 0.0;  // Of each roll and pitch [rad].

  int num_missing_scans = 0;  // Frames with a pose whose file is not there.
  int num_missing_poses = 0;  // Frames with a file but without a pose.

  // What was missing and what was chosen, a line each, for people.
  std::vector<std::string> notes;
};

// Gives a path to frames that have a pose and no scan, counts both kinds of
// missing ones, and notes them.
void CountMissing(const std::function<std::string(int frame)>& path_of_scan,
                  SequenceData* data);

// "3, 7-9 and 12": runs of two or more are joined; after five of them,
// "... (41 in all)". `frames` must be sorted.
std::string FormatFrames(const std::vector<int>& frames);

// Source onto target by (1), named "00/004413-000850", of the set "00" and of
// no bin, with the INS where both frames have one. Nullopt if either frame has
// no pose.
std::optional<PairTask> MakePairTask(const SequenceData& data,
                                     int source_frame,
                                     int target_frame);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_DATASETS_SEQUENCE_DATA_H_
