// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/runner/runner.h"

#include <charconv>
#include <mutex>
#include <unordered_set>

#include "experiments/runner/run_problem.h"
#include "features/base/cloud_text.h"
#include "features/base/parallel.h"

namespace quatro {

std::optional<Shard> ParseShard(const std::string& text, std::string* error) {
  Shard shard;
  const char* const end = text.data() + text.size();
  const auto index = std::from_chars(text.data(), end, shard.index);
  const bool has_slash =
      index.ec == std::errc() && index.ptr != end && *index.ptr == '/';
  if (has_slash) {
    const auto count = std::from_chars(index.ptr + 1, end, shard.count);
    if (count.ec == std::errc() && count.ptr == end && shard.index >= 1 &&
        shard.index <= shard.count) {
      return shard;
    }
  }
  *error = Quoted(text) + ", must be k/n with 1 <= k <= n";
  return std::nullopt;
}

std::vector<PairTask> TakeShard(const std::vector<PairTask>& tasks,
                                const Shard& shard) {
  std::vector<PairTask> taken;
  for (auto i = static_cast<std::size_t>(shard.index - 1); i < tasks.size();
       i += static_cast<std::size_t>(shard.count)) {
    taken.push_back(tasks[i]);
  }
  return taken;
}

RunEnd RunTasks(const std::vector<PairTask>& tasks,
                const RunMethods& methods,
                const RunControl& control,
                RunFolder* folder,
                std::string* error) {
  std::vector<std::string> names;
  std::vector<const PairTask*> missing;
  std::unordered_set<std::string> seen;
  for (const PairTask& task : tasks) {
    if (!seen.insert(task.name).second) {
      *error = "pair " + task.name + " is listed twice";
      return RunEnd::kFailed;
    }
    names.push_back(task.name);
    if (!folder->Has(task.name)) missing.push_back(&task);
  }

  std::mutex mutex;
  RunEnd end = RunEnd::kDone;
  int num_done = static_cast<int>(tasks.size() - missing.size());
  ParallelFor(control.num_workers,
              static_cast<Eigen::Index>(missing.size()),
              1,
              [&](Eigen::Index begin, Eigen::Index) {
                {
                  const std::lock_guard<std::mutex> lock(mutex);
                  if (end == RunEnd::kDone && control.should_stop &&
                      control.should_stop()) {
                    end = RunEnd::kStopped;
                  }
                  if (end != RunEnd::kDone) return;
                }
                const PairTask& task =
                    *missing[static_cast<std::size_t>(begin)];
                const TaskOutcome outcome = task.make_problem
                                                ? RunProblem(task, methods)
                                                : RunTask(task, methods);
                const std::lock_guard<std::mutex> lock(mutex);
                if (end == RunEnd::kFailed) return;
                if (!folder->Append(
                        outcome.results, outcome.note, outcome.view, error)) {
                  end = RunEnd::kFailed;
                  return;
                }
                ++num_done;
                if (control.progress) {
                  control.progress(num_done, static_cast<int>(tasks.size()));
                }
              });
  if (end == RunEnd::kDone && !folder->Finish(names, error)) {
    return RunEnd::kFailed;
  }
  return end;
}

}  // namespace quatro
