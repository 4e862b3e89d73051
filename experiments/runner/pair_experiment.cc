// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/runner/pair_experiment.h"

#include <algorithm>
#include <filesystem>
#include <memory>

#include "experiments/runner/run_folder.h"

namespace quatro {
namespace {

namespace fs = std::filesystem;

std::string ShardFolder(const std::string& output, const Shard& shard) {
  if (shard.IsWhole()) return output;
  return output + "/shard_" + std::to_string(shard.index) + "_of_" +
         std::to_string(shard.count);
}

// Of all parts in the folder, sorted.
std::vector<std::string> ListShards(const std::string& output) {
  std::vector<std::string> shards;
  std::error_code status;
  for (fs::directory_iterator it(output, status), end; !status && it != end;
       it.increment(status)) {
    if (it->path().filename().string().starts_with("shard_")) {
      shards.push_back(it->path().string());
    }
  }
  std::sort(shards.begin(), shards.end());
  return shards;
}

}  // namespace

RunEnd RunPairExperiment(const PairExperiment& experiment,
                         const RunControl& control,
                         std::string* error) {
  const std::unique_ptr<RunFolder> folder =
      RunFolder::Open(ShardFolder(experiment.output, experiment.shard),
                      experiment.methods.names,
                      error);
  if (!folder) return RunEnd::kFailed;
  return RunTasks(TakeShard(experiment.tasks, experiment.shard),
                  experiment.methods,
                  control,
                  folder.get(),
                  error);
}

bool MergeShards(const PairExperiment& experiment, std::string* error) {
  const std::vector<std::string> shards = ListShards(experiment.output);
  if (shards.empty()) {
    *error = experiment.output + ": holds no parts (shard_1_of_2 and so on)";
    return false;
  }
  const std::vector<std::string>& methods = experiment.methods.names;
  const auto whole = RunFolder::Open(experiment.output, methods, error);
  if (!whole) return false;
  for (const std::string& path : shards) {
    const auto shard = RunFolder::Open(path, methods, error);
    if (!shard) return false;
    const auto results = ReadResultCsv(path + "/rows.csv", error);
    if (!results) return false;
    for (auto first = results->begin(); first != results->end();
         first += static_cast<std::ptrdiff_t>(methods.size())) {
      const std::vector<PairResult> pair(
          first, first + static_cast<std::ptrdiff_t>(methods.size()));
      if (whole->Has(pair.front().pair)) continue;
      if (!whole->Append(pair, "", error)) return false;
    }
  }
  std::vector<std::string> names;
  for (const PairTask& task : experiment.tasks) names.push_back(task.name);
  return whole->Finish(names, error);
}

}  // namespace quatro
