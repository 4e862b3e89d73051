// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The output of a protocol or a list of pairs: the tasks in order, and a note
// per line about omitted or missing data.

#ifndef QUATRO_EXPERIMENTS_DATASETS_PAIR_SELECTION_H_
#define QUATRO_EXPERIMENTS_DATASETS_PAIR_SELECTION_H_

#include <string>
#include <vector>

#include "experiments/datasets/pair_task.h"

namespace quatro {

struct PairSelection {
  std::vector<PairTask> tasks;

  // Pairs for which a pose is missing; they do not become tasks.
  int num_without_pose = 0;

  // Missing scan files, each counted once even if several tasks name it. Those
  // tasks are kept.
  int num_missing_scans = 0;

  std::vector<std::string> notes;
};

// Counts and notes the missing files that tasks name.
void CountMissingScans(PairSelection* selection);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_DATASETS_PAIR_SELECTION_H_
