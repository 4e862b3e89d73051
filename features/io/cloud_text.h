// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Words and numbers in the text parts of cloud files, whatever the locale.

#ifndef QUATRO_FEATURES_IO_CLOUD_TEXT_H_
#define QUATRO_FEATURES_IO_CLOUD_TEXT_H_

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace quatro {

// Removes the first line from *text and returns it without its LF or CRLF.
std::string_view TakeLine(std::string_view* text);

// Removes the first word from *line and returns it; empty if there is none.
std::string_view TakeWord(std::string_view* line);

// Lines with at least one word.
std::uint64_t CountLines(std::string_view text);

// The whole word as a decimal number, "nan" or "inf", with or without a sign.
// nullopt also for what a double is too small or too large to hold.
std::optional<double> ParseNumber(std::string_view word);

// The whole word as a number of things: digits only.
std::optional<std::uint64_t> ParseCount(std::string_view word);

// For error messages: in quotes, shortened, on one line and printable.
std::string Quoted(std::string_view word);

}  // namespace quatro

#endif  // QUATRO_FEATURES_IO_CLOUD_TEXT_H_
