// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Numbers out of lines of text, and back.

#ifndef QUATRO_EXPERIMENTS_BASE_NUMBER_TEXT_H_
#define QUATRO_EXPERIMENTS_BASE_NUMBER_TEXT_H_

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace quatro {

// The parts of a line between any of `separators`, a run of which counts once;
// a carriage return at the end is left out.
std::vector<std::string_view> SplitFields(std::string_view line,
                                          std::string_view separators);

// Finite and the whole field, or nullopt.
std::optional<double> ParseFiniteNumber(std::string_view field);

// All lines of a file in order, without their ends; the last may lack one.
std::vector<std::string_view> SplitLines(std::string_view text);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_BASE_NUMBER_TEXT_H_
