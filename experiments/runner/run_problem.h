// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Matched points with a known answer, drawn once, by each of several methods:
// what experiments/runner/run_task.h does for scans. There is no front end and
// no geometry, so that a verdict has the matches alone to go by.

#ifndef QUATRO_EXPERIMENTS_RUNNER_RUN_PROBLEM_H_
#define QUATRO_EXPERIMENTS_RUNNER_RUN_PROBLEM_H_

#include <string>

#include "experiments/datasets/pair_task.h"
#include "experiments/runner/run_task.h"

namespace quatro {

// Returns false and says in *error which method does not work on matched points
// alone, or needs an INS.
bool CanRunProblems(const RunMethods& methods, std::string* error);

// `task` makes a problem and `methods` can run it. The noise bound is that of
// the options, whatever the problem was drawn with.
TaskOutcome RunProblem(const PairTask& task, const RunMethods& methods);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_RUNNER_RUN_PROBLEM_H_
