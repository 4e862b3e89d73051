// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/tables/timing_table.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>

namespace quatro {
namespace {

constexpr double kMilliseconds = 1e3;

bool IsFrontEnd(const std::string& stage) {
  return stage == "voxels" || stage == "features" || stage == "matching";
}

// The stages of all results in the order of execution. A new stage is inserted
// before the first known stage that follows it.
std::vector<std::string> StagesOf(const std::vector<PairResult>& results) {
  std::vector<std::string> stages;
  for (const PairResult& result : results) {
    const auto& own = result.stage_times;
    for (std::size_t i = 0; i < own.size(); ++i) {
      const auto find = [&](const std::string& stage) {
        return std::find(stages.begin(), stages.end(), stage);
      };
      if (find(own[i].stage) != stages.end()) continue;
      auto place = stages.end();
      for (std::size_t k = i + 1; k < own.size(); ++k) {
        place = std::min(place, find(own[k].stage));
      }
      stages.insert(place, own[i].stage);
    }
  }
  return stages;
}

// Median over the pairs of the sum of the stages that satisfy `is_chosen`;
// nullopt if no pair has such a stage.
template <typename IsChosen>
std::optional<double> MedianOf(const std::vector<PairResult>& results,
                               const IsChosen& is_chosen) {
  std::vector<double> sums;
  bool has_any = false;
  for (const PairResult& result : results) {
    double sum = 0.0;
    for (const StageTime& time : result.stage_times) {
      if (!is_chosen(time.stage)) continue;
      has_any = true;
      sum += time.seconds;
    }
    sums.push_back(sum);
  }
  return has_any ? Median(sums) : std::nullopt;
}

}  // namespace

Table MakeTimingTable(const std::vector<PairResult>& results,
                      const TableOptions& options) {
  const auto stages =
      options.with_details ? StagesOf(results) : std::vector<std::string>();
  Table table;
  table.columns = {"method", "pairs"};
  for (const std::string& stage : stages) {
    table.columns.push_back("stage ms / " + stage);
  }
  table.columns.emplace_back("sum ms / front end");
  table.columns.emplace_back("sum ms / rest");
  AddColumns("sum ms / total", options, &table.columns);
  for (const std::string& method : MethodsOf(results)) {
    std::vector<PairResult> timed;
    std::vector<double> totals;
    for (const PairResult& result : results) {
      if (result.method != method || !IsReadable(result)) continue;
      timed.push_back(result);
      totals.push_back(result.total_seconds);
    }
    std::vector<std::string> row = {method, std::to_string(timed.size())};
    const auto add = [&](const std::optional<double>& seconds) {
      row.push_back(seconds ? NumberCell(kMilliseconds * *seconds, 2) : "");
    };
    for (const std::string& stage : stages) {
      add(MedianOf(timed, [&](const std::string& s) { return s == stage; }));
    }
    add(MedianOf(timed, IsFrontEnd));
    add(MedianOf(timed, [](const std::string& s) { return !IsFrontEnd(s); }));
    AddCells(Median(totals),
             options.with_intervals ? BootstrapMedian(totals, options.bootstrap)
                                    : std::nullopt,
             kMilliseconds,
             2,
             options,
             &row);
    table.rows.push_back(row);
  }
  return table;
}

}  // namespace quatro
