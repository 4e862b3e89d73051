// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Table I of the Quatro paper: success by sequence [%], with Wilson's
// intervals.

#ifndef QUATRO_EXPERIMENTS_TABLES_SUCCESS_TABLE_H_
#define QUATRO_EXPERIMENTS_TABLES_SUCCESS_TABLE_H_

#include <vector>

#include "experiments/metrics/pair_result.h"
#include "experiments/tables/published_figures.h"
#include "experiments/tables/result_groups.h"
#include "experiments/tables/table.h"

namespace quatro {

// Columns: method, origin, each set and, if there are several, "all" for their
// union. Rows: one per method for the first of options.limits, then one for
// each method of `published` that has a value in one of the columns. The
// paper's pairs are 9-12 m apart; select these results with SelectResults.
Table MakeSuccessTable(
    const std::vector<PairResult>& results,
    const TableOptions& options,
    const std::vector<PublishedRate>& published = PublishedTableOne());

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_TABLES_SUCCESS_TABLE_H_
