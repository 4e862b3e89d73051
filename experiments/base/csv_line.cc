// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/base/csv_line.h"

#include <utility>

namespace quatro {

std::string QuoteCsvCell(std::string_view cell) {
  const bool is_quoted = cell.find_first_of(",\"") != std::string_view::npos;
  std::string text;
  if (is_quoted) text += '"';
  for (const char c : cell) {
    if (c == '"') text += '"';
    text += c == '\n' || c == '\r' ? ' ' : c;
  }
  if (is_quoted) text += '"';
  return text;
}

std::string JoinCsvLine(const std::vector<std::string>& cells) {
  std::string line;
  for (const std::string& cell : cells) {
    if (&cell != &cells.front()) line += ',';
    line += QuoteCsvCell(cell);
  }
  return line;
}

std::optional<std::vector<std::string>> SplitCsvLine(std::string_view line) {
  std::vector<std::string> cells;
  std::size_t i = 0;
  while (true) {
    std::string cell;
    if (i < line.size() && line[i] == '"') {
      for (++i;; ++i) {
        if (i == line.size()) return std::nullopt;
        if (line[i] == '"' && (++i == line.size() || line[i] != '"')) break;
        cell += line[i];
      }
      if (i < line.size() && line[i] != ',') return std::nullopt;
    } else {
      for (; i < line.size() && line[i] != ','; ++i) {
        if (line[i] == '"') return std::nullopt;
        cell += line[i];
      }
    }
    cells.push_back(std::move(cell));
    if (i == line.size()) return cells;
    ++i;
  }
}

}  // namespace quatro
