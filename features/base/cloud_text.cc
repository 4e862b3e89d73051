// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/base/cloud_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <locale>
#include <sstream>
#include <system_error>

namespace quatro {
namespace {

// Parses a number beyond the range of double. std::from_chars() does not report
// whether it is too small or too large.
std::optional<double> ParseOutOfRange(std::string_view word) {
  std::istringstream stream{std::string(word)};
  stream.imbue(std::locale::classic());
  double value = 1.0;
  stream >> value;
  if (std::abs(value) >= 1.0) return std::nullopt;
  return value;
}

// Removes the text up to `end`, and the character there, from *text. Returns
// the text before `end`.
std::string_view TakeUntil(std::size_t end, std::string_view* text) {
  const std::string_view line = text->substr(0, end);
  text->remove_prefix(std::min(line.size() + 1, text->size()));
  return line;
}

}  // namespace

void SkipByteOrderMark(std::string_view* text) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (text->starts_with(kByteOrderMark)) {
    text->remove_prefix(kByteOrderMark.size());
  }
}

std::string_view TakeLine(std::string_view* text) {
  const std::size_t end = text->find_first_of("\r\n");
  const bool is_cr = end < text->size() && (*text)[end] == '\r';
  const std::string_view line = TakeUntil(end, text);
  if (is_cr && text->starts_with('\n')) text->remove_prefix(1);
  return line;
}

HeaderLines::HeaderLines(std::string_view* text) : text_(text) {
  SkipByteOrderMark(text_);
  const std::size_t end = text_->find_first_of("\r\n");
  ends_in_cr_ = end < text_->size() && (*text_)[end] == '\r' &&
                text_->substr(end + 1, 1) != "\n";
}

std::string_view HeaderLines::Take() {
  std::string_view line =
      TakeUntil(text_->find(ends_in_cr_ ? '\r' : '\n'), text_);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

std::string_view TakeWord(std::string_view* line) {
  constexpr std::string_view kSpace = " \t\r\v\f\n";
  line->remove_prefix(std::min(line->find_first_not_of(kSpace), line->size()));
  const std::string_view word = line->substr(0, line->find_first_of(kSpace));
  line->remove_prefix(word.size());
  return word;
}

std::string_view Trim(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r\v\f\n";
  text.remove_prefix(std::min(text.find_first_not_of(kSpace), text.size()));
  return text.substr(0, text.find_last_not_of(kSpace) + 1);
}

std::uint64_t CountLines(std::string_view text) {
  std::uint64_t num_lines = 0;
  while (!text.empty()) {
    std::string_view line = TakeLine(&text);
    if (!TakeWord(&line).empty()) ++num_lines;
  }
  return num_lines;
}

std::optional<double> ParseNumber(std::string_view word) {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  double value = 0.0;
  const char* const end = word.data() + word.size();
  const auto [stop, code] = std::from_chars(word.data(), end, value);
  if (stop != end || code == std::errc::invalid_argument) return std::nullopt;
  if (code != std::errc()) return ParseOutOfRange(word);
  return value;
}

std::optional<std::uint64_t> ParseCount(std::string_view word) {
  std::uint64_t value = 0;
  const char* const end = word.data() + word.size();
  const auto [stop, code] = std::from_chars(word.data(), end, value);
  if (code != std::errc() || stop != end) return std::nullopt;
  return value;
}

std::string Quoted(std::string_view word) {
  constexpr std::size_t kMaxLength = 40;
  std::string quoted(word.substr(0, kMaxLength));
  std::replace_if(
      quoted.begin(),
      quoted.end(),
      [](char c) { return c < ' ' || c > '~'; },
      '?');
  return "'" + quoted + (word.size() > kMaxLength ? "...'" : "'");
}

}  // namespace quatro
