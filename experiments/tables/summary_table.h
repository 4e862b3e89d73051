// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Every metric of every method on any list of pairs, and the significance of
// differences between methods.

#ifndef QUATRO_EXPERIMENTS_TABLES_SUMMARY_TABLE_H_
#define QUATRO_EXPERIMENTS_TABLES_SUMMARY_TABLE_H_

#include <string>
#include <vector>

#include "experiments/metrics/pair_result.h"
#include "experiments/tables/result_groups.h"
#include "experiments/tables/table.h"

namespace quatro {

// One row per method and set, and a row "all" per method if there are several
// sets.
Table MakeSummaryTable(const std::vector<PairResult>& results,
                       const TableOptions& options);

// Compares the method `reference` with each other method
// (metrics/paired_test.h) at the first limit. p-values are not adjusted for
// their number.
Table MakeSignificanceTable(const std::vector<PairResult>& results,
                            const std::string& reference,
                            const TableOptions& options);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_TABLES_SUMMARY_TABLE_H_
