// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/base/number_text.h"

#include <algorithm>
#include <cmath>

#include "features/base/cloud_text.h"

namespace quatro {

std::vector<std::string_view> SplitFields(std::string_view line,
                                          std::string_view separators) {
  std::vector<std::string_view> fields;
  while (true) {
    const std::size_t begin = line.find_first_not_of(separators);
    if (begin == std::string_view::npos) return fields;
    line.remove_prefix(begin);
    const std::size_t end =
        std::min(line.size(), line.find_first_of(separators));
    fields.push_back(line.substr(0, end));
    line.remove_prefix(end);
  }
}

std::optional<double> ParseFiniteNumber(std::string_view field) {
  const std::optional<double> value = ParseNumber(field);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::vector<std::string_view> SplitLines(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) lines.push_back(TakeLine(&text));
  return lines;
}

}  // namespace quatro
