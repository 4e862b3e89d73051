// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A whole experiment on pairs: tasks and methods, in one folder or split into
// parts,
//
//   OUTPUT/                 the run's folder (experiments/runner/run_folder.h)
//   OUTPUT/shard_2_of_5/    the folder of a part, for --merge
//
// each with a manifest.json. When all pairs are done, OUTPUT also gets tables/,
// from experiments/tables/run_tables.h, and report.html, from
// experiments/report/run_report.h.

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

  // The number of tasks, from the start of the list, that keep a 3D view.
  std::size_t num_views = 0;

  // The manifest without the data; the tasks are added as the flag "tasks".
  Manifest manifest;
};

// Checksum of the name, set, bin, added yaw, true pose and INS of each task.
std::string ChecksumOf(const std::vector<PairTask>& tasks);

// Runs or resumes the part `shard` of the experiment. Fails if the manifest in
// its folder has other inputs.
RunEnd RunPairExperiment(const PairExperiment& experiment,
                         const RunControl& control,
                         std::string* error);

// Merges the parts in the output folder, as if the experiment had been run at
// once. If a part is invalid or a pair is missing, returns false and names it
// in *error; existing data is kept.
bool MergeShards(const PairExperiment& experiment, std::string* error);

// Writes tables/NAME.csv and .tex from the complete results.csv, and
// report.html if there is a template. *summary is the table for the terminal.
bool WriteTables(const std::string& output,
                 const TableOptions& options,
                 const std::optional<std::string>& report_template,
                 std::string* summary,
                 std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_RUNNER_PAIR_EXPERIMENT_H_
