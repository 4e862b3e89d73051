// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/runner/run_task.h"

#include <algorithm>
#include <new>
#include <optional>
#include <utility>

#include "experiments/programs/methods.h"
#include "robust/registration/presets.h"

namespace quatro {
namespace {

TaskOutcome AllUnreadable(const PairResult& blank,
                          const std::vector<std::string>& names,
                          const std::string& note) {
  TaskOutcome outcome;
  outcome.note = note;
  outcome.results.assign(names.size(), blank);
  for (std::size_t i = 0; i < names.size(); ++i) {
    outcome.results[i].method = names[i];
    outcome.results[i].status = "unreadable";
  }
  return outcome;
}

std::string ViewOf(const PairTask& task,
                   const MatchedClouds& matched,
                   const RegistrationOptions& options,
                   ViewOptions view,
                   const std::vector<MethodAnswer>& answers) {
  view.seed = options.seed;
  return FormatPairView({task.name,
                         task.source,
                         task.target,
                         matched.source.tree->points(),
                         matched.target.tree->points(),
                         task.true_target_from_source,
                         options.noise_bound},
                        answers,
                        view);
}

}  // namespace

PairResult BlankResult(const PairTask& task) {
  PairResult result;
  result.pair = task.name;
  result.set = task.set;
  result.bin = task.bin;
  result.is_truth_known = task.is_truth_known;
  if (task.true_target_from_source) {
    const Rigid3& truth = *task.true_target_from_source;
    const double yaw = Yaw(truth.rotation);
    result.distance = truth.translation.norm();
    result.true_yaw = yaw;
    result.true_tilt = AngleBetween(RotationZ(yaw), truth.rotation);
  }
  return result;
}

void FillResult(const RegistrationSummary& summary,
                const std::optional<Rigid3>& true_target_from_source,
                PairResult* result) {
  result->status = StatusName(summary.verdict.status);
  result->target_from_source = summary.target_from_source();
  if (result->target_from_source && true_target_from_source) {
    result->error =
        MeasureError(*true_target_from_source, *result->target_from_source);
  }
  result->probability = summary.verdict.probability;
  result->num_matches = summary.matched_source.cols();
  result->num_consistent = summary.solution.num_consistent;
  result->num_inliers = summary.solution.num_translation_inliers;
  result->stage_times = summary.stage_times;
  result->total_seconds = summary.total_seconds;
}

bool RunMethods::IsValid(std::string* error) const {
  if (names.empty()) {
    *error = "there is no method";
    return false;
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!FindPairSolver(names[i], own, error)) return false;
    if (std::count(names.begin(), names.end(), names[i]) > 1) {
      *error = "method " + names[i] + " is listed twice";
      return false;
    }
  }
  return reading.IsValid(error) && options.IsValid(error);
}

TaskOutcome RunTask(const PairTask& task, const RunMethods& methods) {
  const PairResult blank = BlankResult(task);
  std::string error;
  std::optional<PointCloud> source =
      ReadCloud(task.source, methods.reading, &error);
  std::optional<PointCloud> target;
  if (source) target = ReadCloud(task.target, methods.reading, &error);
  if (!target) {
    // The scan is not at fault. The run ends, and can be resumed with more
    // memory.
    if (error.ends_with("fit in memory")) throw std::bad_alloc();
    return AllUnreadable(blank, methods.names, error);
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
    return AllUnreadable(
        blank,
        methods.names,
        task.source + ", " + task.target + ": " + matched.error);
  }

  TaskOutcome outcome;
  std::vector<MethodAnswer> answers;  // Kept only for the view.
  for (const std::string& name : methods.names) {
    PairResult& result = outcome.results.emplace_back(blank);
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
    RegistrationSummary summary = FindPairSolver(name, methods.own, &error)(
        *source, *target, &matched, used);
    if (!summary.error.empty()) {
      outcome.note = name + ": " + summary.error;
      result.status = "unreadable";
      continue;
    }
    FillResult(summary, task.true_target_from_source, &result);
    if (task.keeps_view) answers.push_back({name, std::move(summary)});
  }
  if (!answers.empty()) {
    outcome.view = ViewOf(task, matched, options, methods.view, answers);
  }
  return outcome;
}

}  // namespace quatro
