// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Errors by bin: bins of distance (Table III of the Quatro paper and its
// figure) or of the added yaw.

#ifndef QUATRO_EXPERIMENTS_TABLES_ERROR_TABLE_H_
#define QUATRO_EXPERIMENTS_TABLES_ERROR_TABLE_H_

#include <vector>

#include "experiments/metrics/pair_result.h"
#include "experiments/tables/result_groups.h"
#include "experiments/tables/table.h"

namespace quatro {

// Table III. Columns: method, origin, and for each bin t_avg and r_avg over all
// answers, as in the paper (metrics/registration_metrics.h). The paper's rows
// follow if a bin has the name of one of its bins.
Table MakeErrorTable(const std::vector<PairResult>& results,
                     const TableOptions& options);

// One row per method and bin: number of pairs, success at each limit, and
// averages and medians of the errors over all answers and over the successes.
Table MakeBinTable(const std::vector<PairResult>& results,
                   const TableOptions& options);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_TABLES_ERROR_TABLE_H_
