// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Times by stage: medians over the pairs [ms]. No other table of results
// contains times, so the others do not depend on the machine.

#ifndef QUATRO_EXPERIMENTS_TABLES_TIMING_TABLE_H_
#define QUATRO_EXPERIMENTS_TABLES_TIMING_TABLE_H_

#include <vector>

#include "experiments/metrics/pair_result.h"
#include "experiments/tables/result_groups.h"
#include "experiments/tables/table.h"

namespace quatro {

// One row per method, over its readable pairs: the number of pairs; with
// options.with_details the median of each stage, in the order of execution; the
// medians of voxels, features and matching together ("front end") and of the
// other stages ("rest"); and the median of the total with its bootstrap
// interval. A stage that a pair did not reach counts as 0 ms; a stage that no
// pair of a method has is an empty cell.
Table MakeTimingTable(const std::vector<PairResult>& results,
                      const TableOptions& options);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_TABLES_TIMING_TABLE_H_
