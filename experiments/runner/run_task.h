// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Runs several methods on one pair of scans, which is read, described and
// matched once.

#ifndef QUATRO_EXPERIMENTS_RUNNER_RUN_TASK_H_
#define QUATRO_EXPERIMENTS_RUNNER_RUN_TASK_H_

#include <optional>
#include <string>
#include <vector>

#include "experiments/datasets/pair_task.h"
#include "experiments/metrics/pair_result.h"
#include "experiments/report/pair_view.h"
#include "experiments/runner/own_method.h"
#include "features/io/cloud_io.h"
#include "robust/registration/ins.h"
#include "robust/registration/registration.h"

namespace quatro {

struct RunMethods {
  // Names from experiments/programs/methods.h, except odometries, or `own`.
  std::vector<std::string> names;
  std::vector<OwnMethod> own;

  // Options for all methods; the solver is replaced.
  RegistrationOptions options;

  // Computes the options from each pair of clouds
  // (robust/registration/presets.h), except for threads and seed.
  bool use_auto_options = false;

  ReadCloudOptions reading;

  // Options of the 3D views that tasks keep for the report; their seed is that
  // of `options`.
  ViewOptions view = {};

  // How a method that needs an INS uses the pair's INS. A pair without INS is
  // insufficient for such a method.
  InsMode ins_mode = InsMode::kFused;

  // Returns false and says why in *error if a name is unknown or listed twice,
  // or an option is out of range.
  bool IsValid(std::string* error) const;
};

// The values that do not depend on a method.
PairResult BlankResult(const PairTask& task);

// Sets the result of the method and, if the true pose is known, its error.
void FillResult(const RegistrationSummary& summary,
                const std::optional<Rigid3>& true_target_from_source,
                PairResult* result);

struct TaskOutcome {
  // One result per method, in the order of the names.
  std::vector<PairResult> results;

  // The reason if a scan cannot be read or used, in which case all results are
  // unreadable, or if a method reports an error. Empty otherwise.
  std::string note;

  // JSON of experiments/report/pair_view.h with all methods; empty unless the
  // task keeps a view and the scans could be used.
  std::string view;
};

// For scans; for matched points see experiments/runner/run_problem.h.
TaskOutcome RunTask(const PairTask& task, const RunMethods& methods);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_RUNNER_RUN_TASK_H_
