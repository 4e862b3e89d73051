// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// One pair of scans, read once, described and matched once, by each of several
// methods.

#ifndef QUATRO_EXPERIMENTS_RUNNER_RUN_TASK_H_
#define QUATRO_EXPERIMENTS_RUNNER_RUN_TASK_H_

#include <optional>
#include <string>
#include <vector>

#include "experiments/datasets/pair_task.h"
#include "experiments/metrics/pair_result.h"
#include "experiments/programs/own_method.h"
#include "experiments/report/pair_view.h"
#include "robust/registration/ins.h"
#include "robust/registration/registration.h"

namespace quatro {

struct RunMethods {
  // Of experiments/programs/methods.h, but no odometry, or of `own`.
  std::vector<std::string> names;
  std::vector<OwnMethod> own;

  // For all of them; the solver is replaced.
  RegistrationOptions options;

  // Take the options from each pair of clouds (robust/registration/presets.h),
  // but for threads and seed, which stay.
  bool use_auto_options = false;

  // Of what tasks keep for the report, but for the seed, which is that above.
  ViewOptions view = {};

  // How a method that needs an INS uses the pair's. A pair without one is
  // insufficient for it.
  InsMode ins_mode = InsMode::kFused;

  // Returns false and says why in *error for a name that is not known or comes
  // twice, or an option out of range.
  bool IsValid(std::string* error) const;
};

// What is known of the pair before any method.
PairResult BlankResult(const PairTask& task);

// What the method says of the pair, and its error if there is a truth.
void FillResult(const RegistrationSummary& summary,
                const std::optional<Rigid3>& true_target_from_source,
                PairResult* result);

struct TaskOutcome {
  // Of each method, in the order of the names.
  std::vector<PairResult> results;

  // Why, if a scan can't be read or used: then all are unreadable. Empty
  // otherwise.
  std::string note;

  // JSON of experiments/report/pair_view.h, of all methods; empty unless the
  // task keeps it and the scans could be used.
  std::string view;
};

// Of scans; of matched points see experiments/runner/run_problem.h.
TaskOutcome RunTask(const PairTask& task, const RunMethods& methods);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_RUNNER_RUN_TASK_H_
