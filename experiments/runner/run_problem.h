// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Runs several methods on matched points with a known pose, which are generated
// once. For scans, see experiments/runner/run_task.h. There is no front end and
// no geometry, so the verdict uses only the matches.

#ifndef QUATRO_EXPERIMENTS_RUNNER_RUN_PROBLEM_H_
#define QUATRO_EXPERIMENTS_RUNNER_RUN_PROBLEM_H_

#include <string>

#include "experiments/datasets/pair_task.h"
#include "experiments/runner/run_task.h"

namespace quatro {

// Returns false and names in *error the method that does not work on matched
// points or needs an INS.
bool CanRunProblems(const RunMethods& methods, std::string* error);

// `task` makes a problem and `methods` can solve it. The noise bound is that of
// the options, regardless of the noise of the problem.
TaskOutcome RunProblem(const PairTask& task, const RunMethods& methods);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_RUNNER_RUN_PROBLEM_H_
