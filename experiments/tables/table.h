// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Rows of text under names, as what all protocols give. A column "A / B" is B
// in a group A, which holds for columns beside each other. Of a column
// "origin", "quoted" marks a row whose figures are another's (tables/latex.h).
// An empty cell is not known or does not apply.

#ifndef QUATRO_EXPERIMENTS_TABLES_TABLE_H_
#define QUATRO_EXPERIMENTS_TABLES_TABLE_H_

#include <string>
#include <vector>

namespace quatro {

struct Table {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};

// Columns under each other, numbers to the right, "-" for empty cells.
std::string FormatTable(const Table& table);

std::string FormatCsv(const Table& table);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_TABLES_TABLE_H_
