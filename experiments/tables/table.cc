// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/tables/table.h"

#include <algorithm>
#include <cstddef>

#include "experiments/base/csv_line.h"

namespace quatro {

std::string FormatTable(const Table& table) {
  std::vector<std::size_t> width;
  for (const std::string& column : table.columns)
    width.push_back(column.size());
  for (const auto& row : table.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      width[i] = std::max({width[i], row[i].size(), std::size_t{1}});
    }
  }
  std::string text;
  const auto add = [&](const std::vector<std::string>& row) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string cell = row[i].empty() ? "-" : row[i];
      const std::string padding(width[i] - cell.size(), ' ');
      // The first column contains names.
      text += i == 0 ? cell + padding : "  " + padding + cell;
    }
    text += '\n';
  };
  add(table.columns);
  for (const auto& row : table.rows) add(row);
  return text;
}

std::string FormatCsv(const Table& table) {
  std::string text = JoinCsvLine(table.columns) + '\n';
  for (const auto& row : table.rows) text += JoinCsvLine(row) + '\n';
  return text;
}

}  // namespace quatro
