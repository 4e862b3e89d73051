// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/tables/curve_tables.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <tuple>

#include "experiments/metrics/registration_metrics.h"
#include "experiments/tables/result_groups.h"
#include "features/base/degree.h"

namespace quatro {
namespace {

using RecallFunction = std::vector<double> (*)(const std::vector<PairResult>&,
                                               const std::vector<double>&);

void AddRecall(const std::vector<PairResult>& results,
               const std::string& name,
               int num_steps,
               double step,
               double unit,
               RecallFunction recall_of,
               Table* table) {
  std::vector<double> grid;
  std::vector<std::vector<std::string>> rows;
  for (int i = 0; i <= num_steps; ++i) {
    grid.push_back(step * i * unit);
    rows.push_back({name, NumberCell(step * i, 2)});
  }
  for (const std::string& method : MethodsOf(results)) {
    const auto recall = recall_of(
        SelectResults(results, method, std::nullopt, std::nullopt), grid);
    for (std::size_t i = 0; i < grid.size(); ++i) {
      rows[i].push_back(NumberCell(100.0 * recall[i], 2));
    }
  }
  table->rows.insert(table->rows.end(), rows.begin(), rows.end());
}

void AddHistogram(const std::vector<double>& angles,
                  const std::string& name,
                  double width,
                  std::size_t num_bins,
                  Table* table) {
  std::vector<long> counts(num_bins);
  for (const double angle : angles) {
    const auto bin = static_cast<std::size_t>(angle / kDegree / width);
    ++counts[std::min(bin, num_bins - 1)];
  }
  for (std::size_t i = 0; i < num_bins; ++i) {
    const auto low = static_cast<double>(i) * width;
    table->rows.push_back({name,
                           NumberCell(low, 2),
                           NumberCell(low + width, 2),
                           std::to_string(counts[i])});
  }
}

}  // namespace

Table MakeRecallTable(const std::vector<PairResult>& results) {
  Table table;
  table.columns = {"error", "at most"};
  for (const std::string& method : MethodsOf(results)) {
    table.columns.push_back(method);
  }
  AddRecall(results, "translation m", 60, 0.05, 1.0, TranslationRecall, &table);
  AddRecall(results, "rotation deg", 60, 0.25, kDegree, RotationRecall, &table);
  return table;
}

Table MakeTiltTable(const std::vector<PairResult>& results) {
  constexpr double kTiltWidth = 0.25;  // [deg]
  std::set<std::tuple<std::string, std::string, std::string>> seen;
  std::vector<double> tilts, yaws;
  for (const PairResult& result : results) {
    if (!result.true_tilt || !result.true_yaw ||
        !seen.emplace(result.set, result.bin, result.pair).second) {
      continue;
    }
    tilts.push_back(*result.true_tilt);
    yaws.push_back(std::abs(*result.true_yaw));
  }
  Table table;
  table.columns = {"angle", "from deg", "to deg", "pairs"};
  if (tilts.empty()) return table;
  const double largest = *std::max_element(tilts.begin(), tilts.end());
  AddHistogram(tilts,
               "tilt",
               kTiltWidth,
               static_cast<std::size_t>(largest / kDegree / kTiltWidth) + 1,
               &table);
  AddHistogram(yaws, "yaw", 10.0, 18, &table);
  return table;
}

}  // namespace quatro
