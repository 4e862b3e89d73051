// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/tables/success_table.h"

#include <optional>
#include <string>

namespace quatro {
namespace {

constexpr char kAll[] = "all";

// Adds only the success rate, without averages, which need the bootstrap.
void AddSuccess(const std::vector<PairResult>& results,
                const TableOptions& options,
                std::vector<std::string>* row) {
  long num_posed = 0;
  long num_successes = 0;
  for (const PairResult& result : results) {
    if (!IsReadable(result) || !HasTruth(result)) continue;
    ++num_posed;
    num_successes += result.IsWithin(options.limits[0].translation,
                                     options.limits[0].rotation);
  }
  std::optional<double> rate;
  if (num_posed > 0) {
    rate = static_cast<double>(num_successes) / static_cast<double>(num_posed);
  }
  AddCells(
      rate,
      WilsonInterval(num_successes, num_posed, options.bootstrap.confidence),
      100.0,
      2,
      options,
      row);
}

void AddPublished(const std::vector<PublishedRate>& published,
                  const std::vector<std::string>& sets,
                  const TableOptions& options,
                  Table* table) {
  std::vector<std::string> methods;
  for (const PublishedRate& rate : published) {
    if (methods.empty() || methods.back() != rate.method) {
      methods.push_back(rate.method);
    }
  }
  for (const std::string& method : methods) {
    std::vector<std::string> row = {method, "quoted"};
    bool has_any = false;
    for (const std::string& set : sets) {
      std::optional<double> percent;
      for (const PublishedRate& rate : published) {
        if (rate.method == method && rate.set == set) percent = rate.percent;
      }
      has_any = has_any || percent;
      AddCells(percent, std::nullopt, 1.0, 2, options, &row);
    }
    if (has_any) table->rows.push_back(row);
  }
}

}  // namespace

Table MakeSuccessTable(const std::vector<PairResult>& results,
                       const TableOptions& options,
                       const std::vector<PublishedRate>& published) {
  std::vector<std::string> columns = SetsOf(results);
  const std::size_t num_sets = columns.size();
  if (num_sets > 1) columns.emplace_back(kAll);
  Table table;
  table.columns = {"method", "origin"};
  for (const std::string& column : columns) {
    AddColumns(column, options, &table.columns);
  }
  for (const std::string& method : MethodsOf(results)) {
    std::vector<std::string> row = {method, "measured"};
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const auto set = i < num_sets ? std::optional(columns[i]) : std::nullopt;
      AddSuccess(
          SelectResults(results, method, set, std::nullopt), options, &row);
    }
    table.rows.push_back(row);
  }
  if (options.with_quoted) AddPublished(published, columns, options, &table);
  return table;
}

}  // namespace quatro
