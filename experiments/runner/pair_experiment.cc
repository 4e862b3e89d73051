// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/runner/pair_experiment.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "experiments/report/run_report.h"
#include "experiments/runner/data_checksum.h"
#include "experiments/runner/run_folder.h"
#include "experiments/tables/run_tables.h"
#include "features/base/file.h"

namespace quatro {
namespace {

namespace fs = std::filesystem;

std::string ShardFolder(const std::string& output, const Shard& shard) {
  if (shard.IsWhole()) return output;
  return output + "/shard_" + std::to_string(shard.index) + "_of_" +
         std::to_string(shard.count);
}

// All parts in the folder, sorted.
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

void AppendBits(const Rigid3& pose, std::string* bytes) {
  const Eigen::Matrix4d matrix = pose.ToMatrix();
  bytes->append(reinterpret_cast<const char*>(matrix.data()), sizeof(matrix));
}

void AppendBits(const Attitude& attitude, std::string* bytes) {
  const double angles[] = {attitude.roll, attitude.pitch, attitude.yaw};
  bytes->append(reinterpret_cast<const char*>(angles), sizeof(angles));
}

// Adds the checksum of the tasks, and the scans that they name.
std::optional<Manifest> ManifestOf(const PairExperiment& experiment,
                                   std::string* error) {
  Manifest manifest = experiment.manifest;
  manifest.flags["tasks"] = ChecksumOf(experiment.tasks);
  std::vector<std::string> scans;
  for (const PairTask& task : experiment.tasks) {
    if (task.make_problem) continue;
    scans.push_back(task.source);
    scans.push_back(task.target);
  }
  const auto data = SummarizeData("", scans, {}, error);
  if (!data) return std::nullopt;
  manifest.data = *data;
  return manifest;
}

}  // namespace

std::string ChecksumOf(const std::vector<PairTask>& tasks) {
  std::string bytes;
  for (const PairTask& task : tasks) {
    bytes += task.name + '\n' + task.set + '\n' + task.bin + '\n';
    bytes += std::to_string(task.added_yaw) + '\n';
    if (task.true_target_from_source) {
      AppendBits(*task.true_target_from_source, &bytes);
    }
    if (!task.is_truth_known) bytes += "unknown\n";
    if (task.ins) {
      AppendBits(task.ins->source, &bytes);
      AppendBits(task.ins->target, &bytes);
      bytes += std::to_string(task.ins->std);
    }
  }
  char digits[32];
  std::snprintf(digits,
                sizeof(digits),
                "%016llx",
                static_cast<unsigned long long>(Fnv1a(bytes)));
  return digits;
}

RunEnd RunPairExperiment(const PairExperiment& experiment,
                         const RunControl& control,
                         std::string* error) {
  const std::unique_ptr<RunFolder> folder =
      RunFolder::Open(ShardFolder(experiment.output, experiment.shard),
                      experiment.methods.names,
                      error);
  if (!folder) return RunEnd::kFailed;
  const auto manifest = ManifestOf(experiment, error);
  if (!manifest || !TakeManifest(folder->path(), *manifest, error)) {
    return RunEnd::kFailed;
  }
  std::vector<PairTask> tasks = experiment.tasks;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    tasks[i].keeps_view = i < experiment.num_views;
  }
  RunMethods methods = experiment.methods;
  methods.view = MakeViewOptions(std::min(experiment.num_views, tasks.size()),
                                 methods.names.size());
  return RunTasks(TakeShard(tasks, experiment.shard),
                  methods,
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
  const auto manifest = ManifestOf(experiment, error);
  if (!manifest || !TakeManifest(experiment.output, *manifest, error)) {
    return false;
  }
  for (const std::string& path : shards) {
    const auto shard = RunFolder::Open(path, methods, error);
    if (!shard || !TakeManifest(path, *manifest, error)) return false;
    const auto results = ReadResultCsv(path + "/rows.csv", error);
    if (!results) return false;
    for (auto first = results->begin(); first != results->end();
         first += static_cast<std::ptrdiff_t>(methods.size())) {
      const std::vector<PairResult> pair(
          first, first + static_cast<std::ptrdiff_t>(methods.size()));
      if (whole->Has(pair.front().pair)) continue;
      std::string none;
      const auto view = ReadWholeFile(ViewPath(path, pair.front().pair), &none);
      if (!whole->Append(pair, "", view.value_or(""), error)) return false;
    }
  }
  std::vector<std::string> names;
  for (const PairTask& task : experiment.tasks) names.push_back(task.name);
  return whole->Finish(names, error);
}

bool WriteTables(const std::string& output,
                 const TableOptions& options,
                 const std::optional<std::string>& report_template,
                 std::string* summary,
                 std::string* error) {
  const auto results = ReadResultCsv(output + "/results.csv", error);
  if (!results) return false;
  const std::string folder = output + "/tables";
  std::error_code status;
  fs::create_directories(folder, status);
  if (status) {
    *error = folder + ": " + status.message();
    return false;
  }
  const std::vector<RunTable> tables = MakeRunTables(*results, options);
  for (const TableFile& file : FormatRunTables(tables)) {
    if (!WriteFileAtomically(folder + "/" + file.name, file.text, error)) {
      return false;
    }
  }
  for (const RunTable& table : tables) {
    if (table.name == "summary") *summary = FormatTable(table.table);
  }
  return !report_template ||
         WriteRunReport(
             output, *results, options.limits, tables, *report_template, error);
}

}  // namespace quatro
