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
// as one.
std::vector<std::string_view> SplitFields(std::string_view line,
                                          std::string_view separators);

// The separators of numbers in lines of text.
inline constexpr std::string_view kBlanks = " \t\v\f";

// Like ParseNumber() of features/base/cloud_text.h, but returns nullopt for a
// number that is not finite.
std::optional<double> ParseFiniteNumber(std::string_view field);

// All lines of a text in order, without their line ends. The last line need not
// have one.
std::vector<std::string_view> SplitLines(std::string_view text);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_BASE_NUMBER_TEXT_H_
