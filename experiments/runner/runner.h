// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A list of tasks by a list of methods, into a folder that keeps what is done
// (experiments/runner/run_folder.h). What ends up in results.csv does not
// depend on threads, on interruptions or on how the tasks are shared out, but
// for its times.

#ifndef QUATRO_EXPERIMENTS_RUNNER_RUNNER_H_
#define QUATRO_EXPERIMENTS_RUNNER_RUNNER_H_

#include <functional>
#include <string>
#include <vector>

#include "experiments/datasets/pair_task.h"
#include "experiments/runner/run_folder.h"
#include "experiments/runner/run_task.h"

namespace quatro {

// Part k of n, k from 1: tasks k - 1, k - 1 + n, k - 1 + 2 n, ... 1/1: all.
struct Shard {
  int index = 1;
  int count = 1;

  bool IsWhole() const { return count == 1; }
};

// "k/n". Nullopt with *error set unless 1 <= k <= n.
std::optional<Shard> ParseShard(const std::string& text, std::string* error);

std::vector<PairTask> TakeShard(const std::vector<PairTask>& tasks,
                                const Shard& shard);

enum class RunEnd {
  kDone,     // results.csv is there.
  kStopped,  // As asked; the same call goes on from here.
  kFailed,   // What is done is kept; *error says why.
};

struct RunControl {
  // As many pairs at a time; each takes options.num_threads for itself.
  int num_workers = 1;

  // Asked before each pair.
  std::function<bool()> should_stop;

  // After each pair, with those that were there already counted as done; not
  // from two threads at once.
  std::function<void(int num_done, int num_tasks)> progress;
};

// Runs what the folder lacks. Names of tasks must differ.
RunEnd RunTasks(const std::vector<PairTask>& tasks,
                const RunMethods& methods,
                const RunControl& control,
                RunFolder* folder,
                std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_RUNNER_RUNNER_H_
