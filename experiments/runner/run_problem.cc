// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/runner/run_problem.h"

#include <optional>

#include "experiments/programs/methods.h"
#include "experiments/simulator/synthetic.h"
#include "features/base/stopwatch.h"
#include "robust/verdict/verdict.h"

namespace quatro {
namespace {

PoseSolver FindSolver(const std::string& name,
                      const RunMethods& methods,
                      std::string* error) {
  QuatroOptions options = methods.options.quatro;
  options.seed = methods.options.seed;
  options.num_threads = methods.options.num_threads;
  for (const OwnMethod& own : methods.own) {
    if (own.name == name) return own.make(options);
  }
  return MakeSolver(name, options, error);
}

}  // namespace

bool CanRunProblems(const RunMethods& methods, std::string* error) {
  if (!methods.IsValid(error)) return false;
  for (const std::string& name : methods.names) {
    if (NeedsIns(name)) {
      *error = "method " + name + " needs an INS, but matched points have none";
      return false;
    }
    if (!FindSolver(name, methods, error)) return false;
  }
  return true;
}

TaskOutcome RunProblem(const PairTask& task, const RunMethods& methods) {
  const MatchedProblem problem = task.make_problem();
  const PairResult blank = BlankResult(task);
  VerdictOptions verdict = methods.options.verdict;
  verdict.rival.seed = methods.options.seed;
  verdict.rival.num_threads = methods.options.num_threads;
  TaskOutcome outcome;
  for (const std::string& name : methods.names) {
    std::string error;
    const PoseSolver solver = FindSolver(name, methods, &error);
    Stopwatch stopwatch;
    RegistrationSummary summary;
    summary.solution = solver(problem.source, problem.target);
    summary.stage_times = summary.solution.stage_times;
    summary.total_seconds = stopwatch.Lap();
    summary.matched_source = problem.source;
    summary.matched_target = problem.target;
    summary.verdict = Judge(problem.source,
                            problem.target,
                            summary.solution,
                            methods.options.quatro.noise_bound,
                            /*geometry=*/std::nullopt,
                            verdict);
    PairResult& result = outcome.results.emplace_back(blank);
    result.method = name;
    FillResult(summary, problem.true_target_from_source, &result);
  }
  return outcome;
}

}  // namespace quatro
