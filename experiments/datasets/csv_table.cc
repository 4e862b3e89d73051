// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/datasets/csv_table.h"

#include <algorithm>
#include <set>
#include <utility>

#include "experiments/base/csv_line.h"
#include "experiments/base/number_text.h"
#include "features/base/cloud_text.h"
#include "features/base/file.h"

namespace quatro {

bool CsvTable::Has(const std::string& column) const {
  return std::find(columns.begin(), columns.end(), column) != columns.end();
}

std::optional<CsvTable> ReadCsvTable(const std::string& path,
                                     std::string* error) {
  const auto text = ReadTextFile(path, error);
  if (!text) return std::nullopt;
  CsvTable table;
  int line_number = 0;
  for (const std::string_view line : SplitLines(*text)) {
    ++line_number;
    const std::string where = path + ": line " + std::to_string(line_number);
    if (SplitFields(line, kBlanks).empty()) continue;
    auto cells = SplitCsvLine(line);
    if (!cells) {
      *error = where + " has a quote that is not closed or within a cell";
      return std::nullopt;
    }
    for (std::string& cell : *cells) cell = std::string(Trim(cell));
    if (table.columns.empty()) {
      const std::set<std::string> names(cells->begin(), cells->end());
      if (names.size() != cells->size()) {
        *error = where + " has a column twice";
        return std::nullopt;
      }
      if (line.find(';') != std::string_view::npos) {
        *error = where + " has semicolons, must have commas between columns";
        return std::nullopt;
      }
      table.where_names = where;
      table.columns = std::move(*cells);
      continue;
    }
    if (cells->size() != table.columns.size()) {
      *error = where + " has " + std::to_string(cells->size()) +
               " cells, must have " + std::to_string(table.columns.size());
      return std::nullopt;
    }
    CsvRow row;
    row.where = where;
    for (std::size_t i = 0; i < cells->size(); ++i) {
      row.cells[table.columns[i]] = std::move((*cells)[i]);
    }
    table.rows.push_back(std::move(row));
  }
  if (table.columns.empty()) {
    *error = path + ": is empty, must start with the names of its columns";
    return std::nullopt;
  }
  return table;
}

}  // namespace quatro
