// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Where the time goes: medians over the pairs [ms]. No other table of results
// has times, so all others are the same wherever the run was made.

#ifndef QUATRO_EXPERIMENTS_TABLES_TIMING_TABLE_H_
#define QUATRO_EXPERIMENTS_TABLES_TIMING_TABLE_H_

#include <vector>

#include "experiments/metrics/pair_result.h"
#include "experiments/tables/result_groups.h"
#include "experiments/tables/table.h"

namespace quatro {

// A row a method, over its readable pairs: how many; with options.with_details
// the median of each stage,
// in the order in which methods go through them; of voxels, features and
// matching together ("front end") and of the other stages ("rest"); and of the
// whole, with its bootstrap interval. A stage that a pair did not get to counts
// as 0 ms there, and one that no pair of a method has is an empty cell.
Table MakeTimingTable(const std::vector<PairResult>& results,
                      const TableOptions& options);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_TABLES_TIMING_TABLE_H_
