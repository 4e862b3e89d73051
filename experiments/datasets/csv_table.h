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
  std::string where_names;  // "<file>: line <number>" of the names.
  std::vector<std::string> columns;
  std::vector<CsvRow> rows;

  bool Has(const std::string& column) const;
};

// Ignores blank lines, and blanks around names and cells. Returns nullopt, with
// file and line in *error, if the table is invalid, for example if two columns
// have the same name or a row does not have one cell per column.
std::optional<CsvTable> ReadCsvTable(const std::string& path,
                                     std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_DATASETS_CSV_TABLE_H_
