// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Words and numbers in the text parts of cloud files, independent of the
// locale.

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

// The number of lines with at least one word.
std::uint64_t CountLines(std::string_view text);

// Parses the whole word as a decimal number, "nan" or "inf", with or without a
// sign. Returns nullopt for anything else, and for numbers outside the range of
// a double.
std::optional<double> ParseNumber(std::string_view word);

// Parses the whole word as a count: digits only.
std::optional<std::uint64_t> ParseCount(std::string_view word);

// The word in quotes for an error message: shortened, printable, on one line.
std::string Quoted(std::string_view word);

}  // namespace quatro

#endif  // QUATRO_FEATURES_IO_CLOUD_TEXT_H_
