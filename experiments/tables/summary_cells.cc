// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/tables/summary_cells.h"

#include <cmath>
#include <cstddef>
#include <optional>

#include "features/base/degree.h"

namespace quatro {
namespace {

void AddAverageColumns(const std::string& of,
                       const TableOptions& options,
                       std::vector<std::string>* columns) {
  for (const char* const name :
       {"t_avg m", "r_avg deg", "t median m", "r median deg"}) {
    AddColumns(of + " / " + name, options, columns);
  }
  if (!options.with_details) return;
  columns->push_back(of + " / yaw avg deg");
  columns->push_back(of + " / t_avg as printed m2");
}

void AddAverageCells(const ErrorAverages& averages,
                     const TableOptions& options,
                     std::vector<std::string>* row) {
  AddCells(averages.translation,
           averages.translation_interval,
           1.0,
           3,
           options,
           row);
  AddCells(
      averages.rotation, averages.rotation_interval, kRadian, 3, options, row);
  AddCells(averages.median_translation,
           averages.median_translation_interval,
           1.0,
           3,
           options,
           row);
  AddCells(averages.median_rotation,
           averages.median_rotation_interval,
           kRadian,
           3,
           options,
           row);
  if (!options.with_details) return;
  row->push_back(averages.yaw ? NumberCell(kRadian * *averages.yaw, 3) : "");
  row->push_back(NumberCell(averages.translation_as_printed, 4));
}

}  // namespace

void AddSummaryColumns(const TableOptions& options,
                       std::vector<std::string>* columns) {
  for (const char* const name : {"pairs",
                                 "unreadable",
                                 "apart",
                                 "no truth",
                                 "answers",
                                 "registered",
                                 "false registrations"}) {
    columns->push_back(name);
  }
  for (const SuccessLimit& limit : options.limits) {
    AddColumns("success % / " + limit.Name(), options, columns);
  }
  AddAverageColumns("successes", options, columns);
  if (!options.with_details) return;
  AddAverageColumns("all answers", options, columns);
}

void AddSummaryCells(const std::vector<PairResult>& results,
                     const TableOptions& options,
                     std::vector<std::string>* row) {
  const RegistrationMetrics metrics = ComputeMetrics(
      results,
      options.limits,
      options.with_intervals ? std::optional(options.bootstrap) : std::nullopt);
  for (const long count : {metrics.num_pairs,
                           metrics.num_unreadable,
                           metrics.num_apart,
                           metrics.num_unknown,
                           metrics.num_answers,
                           metrics.num_registered}) {
    row->push_back(std::to_string(count));
  }
  const bool has_truth = metrics.num_posed + metrics.num_apart > 0;
  row->push_back(has_truth || metrics.num_unknown == 0
                     ? std::to_string(metrics.num_wrong_registered)
                     : "");
  for (std::size_t i = 0; i < options.limits.size(); ++i) {
    AddCells(metrics.SuccessRate(i),
             metrics.success_intervals[i],
             100.0,
             2,
             options,
             row);
  }
  AddAverageCells(metrics.of_successes, options, row);
  if (!options.with_details) return;
  AddAverageCells(metrics.of_all, options, row);
}

}  // namespace quatro
