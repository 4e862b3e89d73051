// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/tables/error_table.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "experiments/tables/published_figures.h"
#include "experiments/tables/summary_cells.h"
#include "features/base/degree.h"

namespace quatro {
namespace {

void AddErrors(const std::vector<PairResult>& results,
               const TableOptions& options,
               std::vector<std::string>* row) {
  std::vector<double> translation, rotation;
  for (const PairResult& result : results) {
    if (!result.error) continue;
    translation.push_back(result.error->translation);
    rotation.push_back(result.error->rotation);
  }
  const auto add = [&](const std::vector<double>& errors, double scale) {
    AddCells(Mean(errors),
             options.with_intervals ? BootstrapMean(errors, options.bootstrap)
                                    : std::nullopt,
             scale,
             3,
             options,
             row);
  };
  add(translation, 1.0);
  add(rotation, kRadian);
}

void AddPublished(const std::vector<std::string>& bins,
                  const TableOptions& options,
                  Table* table) {
  const auto published = PublishedTableThree();
  std::vector<std::string> methods;
  for (const PublishedErrors& errors : published) {
    if (methods.empty() || methods.back() != errors.method) {
      methods.push_back(errors.method);
    }
  }
  for (const std::string& method : methods) {
    std::vector<std::string> row = {method, "quoted"};
    bool has_any = false;
    for (const std::string& bin : bins) {
      const auto found = std::find_if(
          published.begin(), published.end(), [&](const auto& errors) {
            return errors.method == method && errors.bin == bin;
          });
      const bool is_there = found != published.end();
      has_any = has_any || is_there;
      AddCells(is_there ? std::optional(found->translation) : std::nullopt,
               std::nullopt,
               1.0,
               3,
               options,
               &row);
      AddCells(is_there ? std::optional(found->rotation_deg) : std::nullopt,
               std::nullopt,
               1.0,
               3,
               options,
               &row);
    }
    if (has_any) table->rows.push_back(row);
  }
}

}  // namespace

Table MakeErrorTable(const std::vector<PairResult>& results,
                     const TableOptions& options) {
  const std::vector<std::string> bins = BinsOf(results);
  Table table;
  table.columns = {"method", "origin"};
  for (const std::string& bin : bins) {
    AddColumns(bin + " / t_avg m", options, &table.columns);
    AddColumns(bin + " / r_avg deg", options, &table.columns);
  }
  for (const std::string& method : MethodsOf(results)) {
    std::vector<std::string> row = {method, "measured"};
    for (const std::string& bin : bins) {
      AddErrors(
          SelectResults(results, method, std::nullopt, bin), options, &row);
    }
    table.rows.push_back(row);
  }
  if (options.with_quoted) AddPublished(bins, options, &table);
  return table;
}

Table MakeBinTable(const std::vector<PairResult>& results,
                   const TableOptions& options) {
  Table table;
  table.columns = {"method", "bin"};
  AddSummaryColumns(options, &table.columns);
  const auto bins = BinsOf(results);
  for (const std::string& method : MethodsOf(results)) {
    for (const std::string& bin : bins) {
      const auto of_bin = SelectResults(results, method, std::nullopt, bin);
      if (of_bin.empty()) continue;
      std::vector<std::string> row = {method, bin};
      AddSummaryCells(of_bin, options, &row);
      table.rows.push_back(row);
    }
  }
  return table;
}

}  // namespace quatro
