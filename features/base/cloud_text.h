// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Lines, words and numbers in text files, independent of the locale. A byte
// order mark of UTF-8 is skipped, and lines end in LF, CR LF or CR.

#ifndef QUATRO_FEATURES_BASE_CLOUD_TEXT_H_
#define QUATRO_FEATURES_BASE_CLOUD_TEXT_H_

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace quatro {

// Removes the byte order mark of UTF-8, if *text starts with it.
void SkipByteOrderMark(std::string_view* text);

// Removes the first line from *text and returns it without its end.
std::string_view TakeLine(std::string_view* text);

// The lines of a header that is followed by binary data. If the first line ends
// in CR alone, all lines do, and an LF after the last line is the first byte of
// the data.
class HeaderLines {
 public:
  // Skips the byte order mark of *text, from which Take() removes lines.
  explicit HeaderLines(std::string_view* text);

  // Removes and returns a line, like TakeLine().
  std::string_view Take();

 private:
  std::string_view* text_;
  bool ends_in_cr_;
};

// Removes the first word from *line and returns it; empty if there is none.
std::string_view TakeWord(std::string_view* line);

// The text without white space at the beginning and at the end.
std::string_view Trim(std::string_view text);

// The number of lines with at least one word.
std::uint64_t CountLines(std::string_view text);

// Parses the whole word as a decimal number, "nan" or "inf", with or without a
// sign. A number too small for a double is 0 with its sign. Returns nullopt if
// it is too large or not a number.
std::optional<double> ParseNumber(std::string_view word);

// Parses the whole word as a count: digits only.
std::optional<std::uint64_t> ParseCount(std::string_view word);

// The word in quotes for an error message: shortened, printable, on one line.
std::string Quoted(std::string_view word);

}  // namespace quatro

#endif  // QUATRO_FEATURES_BASE_CLOUD_TEXT_H_
