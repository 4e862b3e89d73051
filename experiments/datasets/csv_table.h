// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A text table (csv_line.h) whose first line names the columns.

#ifndef QUATRO_EXPERIMENTS_DATASETS_CSV_TABLE_H_
#define QUATRO_EXPERIMENTS_DATASETS_CSV_TABLE_H_

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace quatro {

struct CsvRow {
  std::string where;  // "<file>: line <number>", for errors.
  std::map<std::string, std::string> cells;  // Column -> cell.
};

struct CsvTable {
  std::vector<std::string> columns;
  std::vector<CsvRow> rows;

  bool Has(const std::string& column) const;
};

// Returns nullopt with one line in *error, which names file and line, if a
// column name is repeated or a row does not have one cell per column. Empty
// lines are ignored.
std::optional<CsvTable> ReadCsvTable(const std::string& path,
                                     std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_DATASETS_CSV_TABLE_H_
