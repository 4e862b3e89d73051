// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Parses numbers and fields from lines of text.

#ifndef QUATRO_EXPERIMENTS_BASE_NUMBER_TEXT_H_
#define QUATRO_EXPERIMENTS_BASE_NUMBER_TEXT_H_

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace quatro {

// The fields of a line between any of `separators`; a run of separators counts
// as one. A carriage return at the end is dropped.
std::vector<std::string_view> SplitFields(std::string_view line,
                                          std::string_view separators);

// Returns the number if the whole field is one finite number, else nullopt.
std::optional<double> ParseFiniteNumber(std::string_view field);

// All lines of a file in order, without their line ends. The last line may lack
// its line end.
std::vector<std::string_view> SplitLines(std::string_view text);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_BASE_NUMBER_TEXT_H_
