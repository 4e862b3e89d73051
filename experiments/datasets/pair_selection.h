// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// What a protocol or a list of pairs makes: the tasks in order, and what was
// left out or is missing, a line each, for people.

#ifndef QUATRO_EXPERIMENTS_DATASETS_PAIR_SELECTION_H_
#define QUATRO_EXPERIMENTS_DATASETS_PAIR_SELECTION_H_

#include <string>
#include <vector>

#include "experiments/datasets/pair_task.h"

namespace quatro {

struct PairSelection {
  std::vector<PairTask> tasks;

  // Pairs for which a pose is missing, so that they are no tasks.
  int num_without_pose = 0;

  // Files of scans that are not there, each once, though many tasks may name
  // it; those tasks stay.
  int num_missing_scans = 0;

  std::vector<std::string> notes;
};

// Counts and notes the files that tasks name and that are not there.
void CountMissingScans(PairSelection* selection);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_DATASETS_PAIR_SELECTION_H_
