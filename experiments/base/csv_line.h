// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Lines of CSV whose cells may contain commas (RFC 4180, except that a cell may
// not contain a line break). A cell with a comma or a quote is quoted, and a
// quote within a cell is doubled.

#ifndef QUATRO_EXPERIMENTS_BASE_CSV_LINE_H_
#define QUATRO_EXPERIMENTS_BASE_CSV_LINE_H_

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace quatro {

// Quotes the cell if it needs quotes. A line break becomes a space.
std::string QuoteCsvCell(std::string_view cell);

// Joins the cells with commas, without a line end.
std::string JoinCsvLine(const std::vector<std::string>& cells);

// Splits a line at the commas outside quotes. Returns nullopt if a quote is not
// closed or does not enclose a whole cell.
std::optional<std::vector<std::string>> SplitCsvLine(std::string_view line);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_BASE_CSV_LINE_H_
