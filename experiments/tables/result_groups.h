// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Common parts of the result tables: the methods, sets and bins, and the
// conversion of values to cells.

#ifndef QUATRO_EXPERIMENTS_TABLES_RESULT_GROUPS_H_
#define QUATRO_EXPERIMENTS_TABLES_RESULT_GROUPS_H_

#include <optional>
#include <string>
#include <vector>

#include "experiments/metrics/intervals.h"
#include "experiments/metrics/pair_result.h"
#include "experiments/metrics/registration_metrics.h"

namespace quatro {

struct TableOptions {
  // At least one limit; Table I uses the first.
  std::vector<SuccessLimit> limits = UsualLimits();

  BootstrapOptions bootstrap = {};

  // Adds two columns after each value, "<value> low" and "<value> high"; for
  // CSV rather than print.
  bool with_intervals = false;

  // Adds averages over all answers, averages of the yaw error, t_avg as printed
  // in the paper, and the time of each stage; for CSV rather than print.
  bool with_details = true;

  // True for pairs of scans, false for matched points; pairs of scans 9-12 m
  // apart form Table I.
  bool are_scans = true;

  // Adds the paper's rows if a set or a bin has the paper's name.
  bool with_quoted = true;
};

// Names in order of first occurrence.
std::vector<std::string> MethodsOf(const std::vector<PairResult>& results);
std::vector<std::string> SetsOf(const std::vector<PairResult>& results);
std::vector<std::string> BinsOf(const std::vector<PairResult>& results);

// Results of a method, a set and a bin; nullopt selects all.
std::vector<PairResult> SelectResults(const std::vector<PairResult>& results,
                                      const std::optional<std::string>& method,
                                      const std::optional<std::string>& set,
                                      const std::optional<std::string>& bin);

// Results whose true distance is in [min, max) [m].
std::vector<PairResult> SelectDistance(const std::vector<PairResult>& results,
                                       double min,
                                       double max);

// Removes results whose method, set, pair and true yaw already occurred in
// another bin. Overlapping distance bins share pairs; added yaws make new ones.
std::vector<PairResult> WithoutRepeats(const std::vector<PairResult>& results);

// Formats a value; empty for nullopt and for values that are not finite.
std::string NumberCell(const std::optional<double>& value, int digits);

// Adds a value times `scale`, and the ends of its interval if `options` has
// intervals.
void AddCells(const std::optional<double>& value,
              const std::optional<Interval>& interval,
              double scale,
              int digits,
              const TableOptions& options,
              std::vector<std::string>* row);

// Adds the names of the columns that AddCells() fills.
void AddColumns(const std::string& name,
                const TableOptions& options,
                std::vector<std::string>* columns);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_TABLES_RESULT_GROUPS_H_
