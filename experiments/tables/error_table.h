// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Errors by bin: of distance (Table III of the Quatro paper and its figure), of
// the added yaw.

#ifndef QUATRO_EXPERIMENTS_TABLES_ERROR_TABLE_H_
#define QUATRO_EXPERIMENTS_TABLES_ERROR_TABLE_H_

#include <vector>

#include "experiments/metrics/pair_result.h"
#include "experiments/tables/result_groups.h"
#include "experiments/tables/table.h"

namespace quatro {

// Table III: columns method, origin, and of each bin t_avg and r_avg over all
// answers, as the paper has them (metrics/registration_metrics.h); then the
// paper's rows, if a bin has the name of one there.
Table MakeErrorTable(const std::vector<PairResult>& results,
                     const TableOptions& options);

// A row a method and bin: how many pairs, success at each limit, and averages
// and medians of the errors over all answers and over the successes.
Table MakeBinTable(const std::vector<PairResult>& results,
                   const TableOptions& options);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_TABLES_ERROR_TABLE_H_
