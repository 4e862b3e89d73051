// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Rows of text under named columns, the output of all protocols. Column "A / B"
// is column B in a group A of adjacent columns. In a column "origin", "quoted"
// marks a row whose values come from others (tables/latex.h). An empty cell is
// unknown or does not apply.

#ifndef QUATRO_EXPERIMENTS_TABLES_TABLE_H_
#define QUATRO_EXPERIMENTS_TABLES_TABLE_H_

#include <string>
#include <vector>

namespace quatro {

struct Table {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};

// Aligned columns, numbers to the right, "-" for empty cells.
std::string FormatTable(const Table& table);

std::string FormatCsv(const Table& table);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_TABLES_TABLE_H_
