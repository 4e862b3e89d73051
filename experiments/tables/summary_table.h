// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Every metric of every method on any list of pairs, and which differences
// between methods chance would not make.

#ifndef QUATRO_EXPERIMENTS_TABLES_SUMMARY_TABLE_H_
#define QUATRO_EXPERIMENTS_TABLES_SUMMARY_TABLE_H_

#include <string>
#include <vector>

#include "experiments/metrics/pair_result.h"
#include "experiments/tables/result_groups.h"
#include "experiments/tables/table.h"

namespace quatro {

// A row a method and set, and one "all" of a method's sets if there are
// several.
Table MakeSummaryTable(const std::vector<PairResult>& results,
                       const TableOptions& options);

// The method `reference` against each other one (metrics/paired_test.h) at the
// first limit. p-values are not adjusted for how many there are.
Table MakeSignificanceTable(const std::vector<PairResult>& results,
                            const std::string& reference,
                            const TableOptions& options);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_TABLES_SUMMARY_TABLE_H_
