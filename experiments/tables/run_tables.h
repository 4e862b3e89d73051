// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// All tables of a run, as files in its folder. They depend only on the results;
// only the timing table contains times.

#ifndef QUATRO_EXPERIMENTS_TABLES_RUN_TABLES_H_
#define QUATRO_EXPERIMENTS_TABLES_RUN_TABLES_H_

#include <string>
#include <vector>

#include "experiments/metrics/pair_result.h"
#include "experiments/tables/result_groups.h"
#include "experiments/tables/table.h"

namespace quatro {

struct RunTable {
  std::string name;     // "table_one", used for its files.
  std::string caption;  // For readers.
  Table table;          // For printing.
  Table with_intervals;
};

struct TableFile {
  std::string name;  // "table_one.csv"
  std::string text;
};

// The tables that have rows, among
//
//   table_one      success by set in the bin "9-12 m" or, without it, at true
//                  distances of 9-12 m
//   kitti_lc       success within 2 m and 5 deg by bin, if the bins are those
//                  of the lists, 0-10, 10-20 and 20-30 m
//   table_three    t_avg and r_avg of set 06 at 0-2, 4-6 and 8-10 m
//   summary        every metric by set; by_bin has the same by bin
//   significance   quatro, or else the first method, against the others
//   recall, tilt   for figures
//   timing         medians by stage
//
// A pair in two bins counts once, except in by_bin and table_three.
std::vector<RunTable> MakeRunTables(const std::vector<PairResult>& results,
                                    const TableOptions& options);

// For each table a CSV with intervals and LaTeX without them; for figures only
// the CSV.
std::vector<TableFile> FormatRunTables(const std::vector<RunTable>& tables);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_TABLES_RUN_TABLES_H_
