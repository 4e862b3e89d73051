// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A whole experiment on pairs: tasks by methods, in one folder or shared out,
//
//   OUTPUT/                 the run's folder (experiments/runner/run_folder.h)
//   OUTPUT/shard_2_of_5/    that of a part, for --merge to put together
//
// each with manifest.json, what makes its results. Where all pairs are done,
// OUTPUT gets tables/, of experiments/tables/run_tables.h, and report.html, of
// experiments/report/run_report.h, too.

#ifndef QUATRO_EXPERIMENTS_RUNNER_PAIR_EXPERIMENT_H_
#define QUATRO_EXPERIMENTS_RUNNER_PAIR_EXPERIMENT_H_

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "experiments/datasets/pair_task.h"
#include "experiments/runner/manifest.h"
#include "experiments/runner/run_task.h"
#include "experiments/runner/runner.h"
#include "experiments/tables/result_groups.h"

namespace quatro {

struct PairExperiment {
  std::vector<PairTask> tasks;
  RunMethods methods;
  std::string output;
  Shard shard;

  // So many tasks, the first of the list, keep a 3D view.
  std::size_t num_views = 0;

  // Without the data; its tasks are put in as the flag "tasks".
  Manifest manifest;
};

// Of name, turn, truth and INS of each.
std::string ChecksumOf(const std::vector<PairTask>& tasks);

// Runs, or goes on with, the experiment's part. Fails if the folder's manifest
// is that of other results.
RunEnd RunPairExperiment(const PairExperiment& experiment,
                         const RunControl& control,
                         std::string* error);

// Puts the parts that are in the output together, as if it had been run at
// once. Returns false and sets *error, which names the part or the first pair
// that is missing; what is there is kept.
bool MergeShards(const PairExperiment& experiment, std::string* error);

// From results.csv of the whole, tables/NAME.csv and .tex, and report.html if
// there is a template for it. *summary is the table for a terminal.
bool WriteTables(const std::string& output,
                 const TableOptions& options,
                 const std::optional<std::string>& report_template,
                 std::string* summary,
                 std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_RUNNER_PAIR_EXPERIMENT_H_
