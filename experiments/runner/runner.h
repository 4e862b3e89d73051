// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Runs a list of tasks with a list of methods and stores completed pairs in a
// folder (experiments/runner/run_folder.h). Except for times, results.csv does
// not depend on threads, interruptions or the split into parts.

#ifndef QUATRO_EXPERIMENTS_RUNNER_RUNNER_H_
#define QUATRO_EXPERIMENTS_RUNNER_RUNNER_H_

#include <functional>
#include <string>
#include <vector>

#include "experiments/datasets/pair_task.h"
#include "experiments/runner/run_folder.h"
#include "experiments/runner/run_task.h"

namespace quatro {

// Part k of n, with k from 1: tasks k - 1, k - 1 + n, k - 1 + 2 n, ... 1/1 is
// the whole.
struct Shard {
  int index = 1;
  int count = 1;

  bool IsWhole() const { return count == 1; }
};

// Parses "k/n". Returns nullopt with *error set unless 1 <= k <= n.
std::optional<Shard> ParseShard(const std::string& text, std::string* error);

std::vector<PairTask> TakeShard(const std::vector<PairTask>& tasks,
                                const Shard& shard);

enum class RunEnd {
  kDone,     // results.csv is complete.
  kStopped,  // On request; the same call resumes.
  kFailed,   // Completed pairs are kept; *error says why.
};

struct RunControl {
  // The number of pairs that run at once, each with options.num_threads.
  int num_workers = 1;

  // Called before each pair.
  std::function<bool()> should_stop;

  // Called after each pair, never from two threads at once. `num_done` includes
  // pairs that were completed earlier.
  std::function<void(int num_done, int num_tasks)> progress;
};

// Runs the tasks that the folder lacks. Names of tasks must differ.
RunEnd RunTasks(const std::vector<PairTask>& tasks,
                const RunMethods& methods,
                const RunControl& control,
                RunFolder* folder,
                std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_RUNNER_RUNNER_H_
