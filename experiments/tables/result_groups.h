// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// What the tables of results share: which methods, sets and bins there are, and
// how a figure becomes cells.

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
  // At least one; that of Table I comes first.
  std::vector<SuccessLimit> limits = UsualLimits();

  BootstrapOptions bootstrap = {};

  // Two more columns after each figure, "<figure> low" and "<figure> high": for
  // CSV rather than for print.
  bool with_intervals = false;

  // Averages over all answers beside those over the successes, of yaw, and as
  // printed; each stage's time: for CSV rather than for print, too.
  bool with_details = true;

  // Pairs of scans, and not matched points: those 9-12 m apart make Table I.
  bool are_scans = true;

  // Rows of what the paper has, where a set or a bin has the paper's name.
  bool with_quoted = true;
};

// In the order in which they first come.
std::vector<std::string> MethodsOf(const std::vector<PairResult>& results);
std::vector<std::string> SetsOf(const std::vector<PairResult>& results);
std::vector<std::string> BinsOf(const std::vector<PairResult>& results);

// Those of a method, a set and a bin; nullopt for any.
std::vector<PairResult> SelectResults(const std::vector<PairResult>& results,
                                      const std::optional<std::string>& method,
                                      const std::optional<std::string>& set,
                                      const std::optional<std::string>& bin);

// Those whose true distance is in [min, max) [m].
std::vector<PairResult> SelectDistance(const std::vector<PairResult>& results,
                                       double min,
                                       double max);

// Without those whose method, set, pair and true yaw came before, in another
// bin: overlapping bins of distance share pairs, added yaws make new ones.
std::vector<PairResult> WithoutRepeats(const std::vector<PairResult>& results);

// Empty for nullopt and for what is not finite.
std::string NumberCell(const std::optional<double>& value, int digits);

// A figure times `scale`, and its interval's ends if `options` has them.
void AddCells(const std::optional<double>& value,
              const std::optional<Interval>& interval,
              double scale,
              int digits,
              const TableOptions& options,
              std::vector<std::string>* row);

// Its names.
void AddColumns(const std::string& name,
                const TableOptions& options,
                std::vector<std::string>* columns);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_TABLES_RESULT_GROUPS_H_
