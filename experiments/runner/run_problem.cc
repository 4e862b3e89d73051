// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/runner/run_problem.h"

#include "experiments/programs/methods.h"
#include "experiments/simulator/synthetic.h"

namespace quatro {

bool CanRunProblems(const RunMethods& methods, std::string* error) {
  if (!methods.IsValid(error)) return false;
  for (const std::string& name : methods.names) {
    if (NeedsIns(name)) {
      *error = "method " + name + " needs an INS, but matched points have none";
      return false;
    }
    if (!FindMatchSolver(name, methods.own, error)) return false;
  }
  return true;
}

TaskOutcome RunProblem(const PairTask& task, const RunMethods& methods) {
  const MatchedProblem problem = task.make_problem();
  const PairResult blank = BlankResult(task);
  TaskOutcome outcome;
  for (const std::string& name : methods.names) {
    std::string error;
    const RegistrationSummary summary =
        FindMatchSolver(name, methods.own, &error)(
            {problem.source, problem.target}, methods.options);
    PairResult& result = outcome.results.emplace_back(blank);
    result.method = name;
    FillResult(summary, problem.true_target_from_source, &result);
  }
  return outcome;
}

}  // namespace quatro
