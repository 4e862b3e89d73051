// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// One registration of an experiment, before any data is read: the two scans or
// matched points, the true pose, and the part of a table in which it counts.

#ifndef QUATRO_EXPERIMENTS_DATASETS_PAIR_TASK_H_
#define QUATRO_EXPERIMENTS_DATASETS_PAIR_TASK_H_

#include <functional>
#include <optional>
#include <string>

#include "experiments/simulator/synthetic.h"
#include "features/base/rigid3.h"
#include "solvers/closed_form/gravity.h"

namespace quatro {

struct PairIns {
  Attitude source;
  Attitude target;
  double std = 0.0;  // Each of roll and pitch [rad].
};

struct PairTask {
  // Identifies the task within its run, in readable form: "00/004413-000850".
  std::string name;

  // A table has a row for each set and a column for each bin, or vice versa:
  // "00" and "8-10 m"; "hd_b1" and "yaw 90 deg".
  std::string set;
  std::string bin;

  // Scan files. If one cannot be read, only this task becomes unreadable.
  std::string source;
  std::string target;

  // Replaces the files: generates matched points, the same on each call. Set
  // for all tasks of a run or for none.
  std::function<MatchedProblem()> make_problem;

  // The source is rotated about its z axis by this angle after reading [rad].
  // The true pose and the INS below are those of the rotated scan.
  double added_yaw = 0.0;

  // Not set if the scans share no place or the pose is unknown.
  std::optional<Rigid3> true_target_from_source;
  bool is_truth_known = true;

  std::optional<PairIns> ins;

  // Stores a 3D view for the report (experiments/report/pair_view.h).
  bool keeps_view = false;
};

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_DATASETS_PAIR_TASK_H_
