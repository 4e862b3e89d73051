// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/tables/summary_table.h"

#include <cmath>
#include <cstdio>
#include <optional>

#include "experiments/metrics/paired_test.h"
#include "experiments/tables/summary_cells.h"
#include "features/base/degree.h"

namespace quatro {
namespace {

// Uses powers of ten for values too small for four decimals.
std::string PCell(double p) {
  char text[32];
  std::snprintf(text, sizeof(text), p < 0.001 ? "%.1e" : "%.4f", p);
  return text;
}

}  // namespace

Table MakeSummaryTable(const std::vector<PairResult>& results,
                       const TableOptions& options) {
  Table table;
  table.columns = {"method", "set"};
  AddSummaryColumns(options, &table.columns);
  const auto sets = SetsOf(results);
  const auto add = [&](const std::string& method,
                       const std::optional<std::string>& set) {
    const auto selected = SelectResults(results, method, set, std::nullopt);
    if (selected.empty()) return;
    std::vector<std::string> row = {method, set.value_or("all")};
    AddSummaryCells(selected, options, &row);
    table.rows.push_back(row);
  };
  for (const std::string& method : MethodsOf(results)) {
    for (const std::string& set : sets) add(method, set);
    if (sets.size() > 1) add(method, std::nullopt);
  }
  return table;
}

Table MakeSignificanceTable(const std::vector<PairResult>& results,
                            const std::string& reference,
                            const TableOptions& options) {
  Table table;
  table.columns = {"method",
                   "against",
                   "pairs",
                   "only method correct",
                   "only other correct",
                   "success p",
                   "both answer",
                   "t difference m",
                   "t p",
                   "r difference deg",
                   "r p"};
  for (const std::string& other : MethodsOf(results)) {
    if (other == reference) continue;
    const PairedComparison comparison =
        ComparePaired(results, reference, other, options.limits[0]);
    const bool has_errors = comparison.num_both_answer > 0;
    const auto mean = [&](double difference) {
      return has_errors ? NumberCell(difference, 3) : "";
    };
    table.rows.push_back({reference,
                          other,
                          std::to_string(comparison.num_pairs),
                          std::to_string(comparison.num_only_first),
                          std::to_string(comparison.num_only_second),
                          PCell(comparison.success_p),
                          std::to_string(comparison.num_both_answer),
                          mean(comparison.mean_translation_difference),
                          PCell(comparison.translation_p),
                          mean(kRadian * comparison.mean_rotation_difference),
                          PCell(comparison.rotation_p)});
  }
  return table;
}

}  // namespace quatro
