// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/io/cloud_text.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <system_error>

namespace quatro {
namespace {

template <typename T>
std::optional<T> ParseWhole(std::string_view word) {
  T value{};
  const char* const end = word.data() + word.size();
  const auto [stop, code] = std::from_chars(word.data(), end, value);
  if (code != std::errc() || stop != end) return std::nullopt;
  return value;
}

}  // namespace

std::string_view TakeLine(std::string_view* text) {
  const std::size_t end = text->find('\n');
  std::string_view line = text->substr(0, end);
  text->remove_prefix(std::min(line.size() + 1, text->size()));
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
  return ParseWhole<double>(word);
}

std::optional<std::uint64_t> ParseCount(std::string_view word) {
  return ParseWhole<std::uint64_t>(word);
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
