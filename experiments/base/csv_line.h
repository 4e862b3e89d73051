// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Lines of CSV whose cells may hold commas (RFC 4180, but for line breaks,
// which no cell may hold): a cell with a comma or a quote is quoted, and a
// quote within is doubled.

#ifndef QUATRO_EXPERIMENTS_BASE_CSV_LINE_H_
#define QUATRO_EXPERIMENTS_BASE_CSV_LINE_H_

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace quatro {

// A line break becomes a blank.
std::string QuoteCsvCell(std::string_view cell);

// Without the line's end.
std::string JoinCsvLine(const std::vector<std::string>& cells);

// As many cells as there are commas outside quotes, and one. A carriage return
// at the end is left out. Nullopt if a quote is not closed, or stands anywhere
// but around a whole cell.
std::optional<std::vector<std::string>> SplitCsvLine(std::string_view line);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_BASE_CSV_LINE_H_
