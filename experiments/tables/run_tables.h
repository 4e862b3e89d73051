// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// All tables of a run, as files for its folder. Each is a function of the
// results alone; only those of timing have times in them.

#ifndef QUATRO_EXPERIMENTS_TABLES_RUN_TABLES_H_
#define QUATRO_EXPERIMENTS_TABLES_RUN_TABLES_H_

#include <string>
#include <vector>

#include "experiments/metrics/pair_result.h"
#include "experiments/tables/result_groups.h"
#include "experiments/tables/table.h"

namespace quatro {

struct RunTable {
  std::string name;     // "table_one": of its files.
  std::string caption;  // For people.
  Table table;          // For print.
  Table with_intervals;
};

struct TableFile {
  std::string name;  // "table_one.csv"
  std::string text;
};

// Those with rows, of
//
//   table_one      success by set in the bin "9-12 m" or, without it, at true
//                  distances of 9-12 m
//   kitti_lc       success within 2 m and 5 deg by bin, if the bins are those
//   of
//                  the lists, 0-10, 10-20 and 20-30 m
//   table_three    t_avg and r_avg of set 06 at 0-2, 4-6 and 8-10 m
//   summary        every metric by set; by_bin the same by bin
//   significance   quatro, or else the first method, against the others
//   recall, tilt   for figures
//   timing         medians by stage
//
// A pair of two bins counts once but in by_bin and table_three.
std::vector<RunTable> MakeRunTables(const std::vector<PairResult>& results,
                                    const TableOptions& options);

// A CSV with intervals and LaTeX without of each; of figures the CSV alone.
std::vector<TableFile> FormatRunTables(const std::vector<RunTable>& tables);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_TABLES_RUN_TABLES_H_
