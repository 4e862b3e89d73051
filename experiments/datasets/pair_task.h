// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// One registration of an experiment, before anything is read: which two scans
// or which matched points, what is true of them, and which part of a table they
// count in.

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
  double std = 0.0;  // Of each roll and pitch [rad].
};

struct PairTask {
  // Names it within its run, for people as well: "00/004413-000850".
  std::string name;

  // A table has a row for each set and a column for each bin, or the other way
  // round: "00" and "8-10 m"; "hd_b1" and "yaw 90 deg".
  std::string set;
  std::string bin;

  // Files of scans. One that can't be read makes this task unreadable, and no
  // other.
  std::string source;
  std::string target;

  // In place of the files: draws matched points, the same ones each time. Set
  // for all tasks of a run or for none.
  std::function<MatchedProblem()> make_problem;

  // The source is turned about its z axis by so much after it is read [rad].
  // Truth and INS below are of the turned scan.
  double added_yaw = 0.0;

  // Nullopt: the scans share no place.
  std::optional<Rigid3> true_target_from_source;

  std::optional<PairIns> ins;

  // Leaves a 3D view for the report (experiments/report/pair_view.h).
  bool keeps_view = false;
};

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_DATASETS_PAIR_TASK_H_
