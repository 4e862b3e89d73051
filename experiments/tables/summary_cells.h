// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// All metrics of a group of pairs as the cells of a row.

#ifndef QUATRO_EXPERIMENTS_TABLES_SUMMARY_CELLS_H_
#define QUATRO_EXPERIMENTS_TABLES_SUMMARY_CELLS_H_

#include <string>
#include <vector>

#include "experiments/tables/result_groups.h"

namespace quatro {

// Counts, success at each limit [%], and averages and medians over the
// successes and then over all answers, as the names say.
void AddSummaryColumns(const TableOptions& options,
                       std::vector<std::string>* columns);
void AddSummaryCells(const std::vector<PairResult>& results,
                     const TableOptions& options,
                     std::vector<std::string>* row);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_TABLES_SUMMARY_CELLS_H_
