// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/base/one_line.h"

#include <algorithm>
#include <cstddef>

namespace quatro {
namespace {

constexpr std::size_t kMaxWord = 200;   // Characters.
constexpr std::size_t kMaxLine = 2000;  // Bytes.

bool Continues(char byte) {
  return (static_cast<unsigned char>(byte) & 0xc0) == 0x80;
}

// The bytes of the first character of a text that is not empty; 0 if it is a
// control character or not UTF-8 (RFC 3629).
std::size_t PrintableLength(std::string_view text) {
  const auto first = static_cast<unsigned char>(text[0]);
  if (first < 0x80) return first >= 0x20 && first != 0x7f ? 1 : 0;
  const std::size_t length = first < 0xc2   ? 0
                             : first < 0xe0 ? 2
                             : first < 0xf0 ? 3
                             : first < 0xf5 ? 4
                                            : 0;
  if (length == 0 || text.size() < length ||
      !std::ranges::all_of(text.substr(1, length - 1), Continues)) {
    return 0;
  }
  const auto second = static_cast<unsigned char>(text[1]);
  const bool is_printable =
      (first != 0xc2 || second >= 0xa0) &&  // Controls.
      (first != 0xe0 || second >= 0xa0) && (first != 0xed || second < 0xa0) &&
      (first != 0xf0 || second >= 0x90) && (first != 0xf4 || second < 0x90);
  return is_printable ? length : 0;
}

void AppendWord(std::string_view word, std::string* line) {
  // The end of a quotation is kept.
  const std::size_t end = word.find_last_not_of("':,;)") + 1;
  std::size_t num_characters = 0;
  for (std::size_t i = 0; i < word.size();) {
    if (num_characters++ == kMaxWord && i < end) {
      *line += "...";
      i = end;
      continue;
    }
    const std::size_t length = PrintableLength(word.substr(i));
    *line += length == 0 ? "?" : word.substr(i, length);
    i += std::max<std::size_t>(length, 1);
  }
}

// Keeps both ends, because the reason is at the end of a message.
void ShortenLine(std::string* line) {
  if (line->size() <= kMaxLine) return;
  std::size_t begin = kMaxLine / 2;
  std::size_t end = line->size() - kMaxLine / 2;
  while (Continues((*line)[begin])) --begin;
  while (Continues((*line)[end])) ++end;
  line->replace(begin, end - begin, "...");
}

}  // namespace

std::string OneLine(std::string_view text) {
  std::string line;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    AppendWord(text.substr(0, end), &line);
    if (end < text.size()) line += ' ';
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  ShortenLine(&line);
  return line;
}

}  // namespace quatro
