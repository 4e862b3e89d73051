// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/runner/run_task.h"

#include <algorithm>
#include <optional>

#include "experiments/methods.h"
#include "features/cloud_io.h"
#include "robust/presets.h"

namespace quatro {
namespace {

// What is known of the pair before any method.
PairResult BlankResult(const PairTask& task) {
  PairResult result;
  result.pair = task.name;
  result.set = task.set;
  result.bin = task.bin;
  if (task.true_target_from_source) {
    const Rigid3& truth = *task.true_target_from_source;
    const double yaw = Yaw(truth.rotation);
    result.distance = truth.translation.norm();
    result.true_yaw = yaw;
    result.true_tilt = AngleBetween(RotationZ(yaw), truth.rotation);
  }
  return result;
}

void Fill(const RegistrationSummary& summary,
          const PairTask& task,
          PairResult* result) {
  result->status = StatusName(summary.verdict.status);
  result->target_from_source = summary.target_from_source();
  if (result->target_from_source && task.true_target_from_source) {
    result->error = MeasureError(*task.true_target_from_source,
                                 *result->target_from_source);
  }
  result->probability = summary.verdict.probability;
  result->num_matches = summary.matched_source.cols();
  result->num_consistent = summary.solution.num_consistent;
  result->num_inliers = summary.solution.num_translation_inliers;
  result->stage_times = summary.stage_times;
  result->total_seconds = summary.total_seconds;
}

std::vector<PairResult> AllUnreadable(const PairResult& blank,
                                      const std::vector<std::string>& names) {
  std::vector<PairResult> results(names.size(), blank);
  for (std::size_t i = 0; i < names.size(); ++i) {
    results[i].method = names[i];
    results[i].status = "unreadable";
  }
  return results;
}

}  // namespace

bool RunMethods::IsValid(std::string* error) const {
  if (names.empty()) {
    *error = "no method is named";
    return false;
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!FindPairSolver(names[i], own, error)) return false;
    if (std::count(names.begin(), names.end(), names[i]) > 1) {
      *error = "method " + names[i] + " comes twice";
      return false;
    }
  }
  return options.IsValid(error);
}

std::vector<PairResult> RunTask(const PairTask& task,
                                const RunMethods& methods,
                                std::string* note) {
  note->clear();
  const PairResult blank = BlankResult(task);
  std::string error;
  std::optional<PointCloud> source = ReadCloud(task.source, &error);
  std::optional<PointCloud> target;
  if (source) target = ReadCloud(task.target, &error);
  if (!target) {
    *note = error;
    return AllUnreadable(blank, methods.names);
  }
  if (task.added_yaw != 0.0) {
    source->points = RotationZ(task.added_yaw) * source->points;
  }

  RegistrationOptions options = methods.options;
  if (methods.use_auto_options) {
    options = MakeAutoOptions(*source, *target);
    options.seed = methods.options.seed;
    options.num_threads = methods.options.num_threads;
  }
  const MatchedClouds matched = MatchClouds(*source, *target, options);
  if (!matched.error.empty()) {
    *note = task.source + ", " + task.target + ": " + matched.error;
    return AllUnreadable(blank, methods.names);
  }

  std::vector<PairResult> results;
  for (const std::string& name : methods.names) {
    PairResult& result = results.emplace_back(blank);
    result.method = name;
    RegistrationOptions used = options;
    if (NeedsIns(name)) {
      if (!task.ins) {
        result.status = "insufficient";
        continue;
      }
      used.ins.mode = methods.ins_mode;
      used.ins.source_attitude = task.ins->source;
      used.ins.target_attitude = task.ins->target;
      used.ins.attitude_std = task.ins->std;
    }
    const RegistrationSummary summary = FindPairSolver(
        name, methods.own, &error)(*source, *target, matched, used);
    if (!summary.error.empty()) {
      *note = name + ": " + summary.error;
      result.status = "unreadable";
      continue;
    }
    Fill(summary, task, &result);
  }
  return results;
}

}  // namespace quatro
