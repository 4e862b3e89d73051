// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/programs/matches_csv.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <vector>

#include "experiments/base/number_text.h"
#include "experiments/base/one_line.h"
#include "experiments/base/outputs.h"
#include "features/base/cloud_text.h"
#include "features/io/cloud_format.h"

namespace quatro {
namespace {

constexpr std::array<std::string_view, 6> kNames = {
    "sx", "sy", "sz", "tx", "ty", "tz"};

std::vector<std::string_view> Fields(std::string_view line) {
  const bool has_commas = line.find(',') != std::string_view::npos;
  std::vector<std::string_view> fields;
  while (true) {
    const std::size_t begin = line.find_first_not_of(kBlanks);
    if (begin == std::string_view::npos) {
      if (has_commas) fields.emplace_back();
      return fields;
    }
    line.remove_prefix(begin);
    std::size_t end = line.find_first_of(has_commas ? "," : kBlanks);
    const bool is_last = end == std::string_view::npos;
    if (is_last) end = line.size();
    std::string_view field = line.substr(0, end);
    field = field.substr(0, field.find_last_not_of(kBlanks) + 1);
    fields.push_back(field);
    if (is_last) return fields;
    line.remove_prefix(end + 1);
  }
}

constexpr char kExpectedLines[] = "a line for each match: sx,sy,sz,tx,ty,tz";

// Whether the name is that of a cloud in a format that no matches are in.
bool IsCloud(const std::string& path) {
  const auto type = FindCloudFileType(path);
  return type && type->format != CloudFormat::kText;
}

// What a line with this number of columns may be; empty if unknown.
std::string GuessKind(std::size_t num_columns) {
  if (num_columns == 3 || num_columns == 4) {
    return "; quatro_register registers clouds of points";
  }
  if (num_columns == 8 || num_columns == 12) {
    return "; is this a file of poses?";
  }
  return "";
}

}  // namespace

std::optional<MatchedPoints> ReadMatches(const std::string& path,
                                         std::string* error) {
  std::error_code ignored;
  if (IsCloud(path) && std::filesystem::exists(path, ignored)) {
    *error = path + ": is a cloud by its ending, must be text with " +
             kExpectedLines + "; quatro_register registers clouds of points";
    return std::nullopt;
  }
  const std::optional<std::string> text = ReadInput(path, error);
  if (!text) return std::nullopt;
  const std::string name = path == "-" ? "standard input" : path;

  std::vector<double> values;
  int line_number = 0;
  bool is_first = true;
  for (const std::string_view line : SplitLines(*text)) {
    ++line_number;
    const std::vector<std::string_view> fields = Fields(line);
    if (fields.empty() || fields.front().starts_with('#')) continue;

    const std::string where = name + ": line " + std::to_string(line_number);
    if (line.find(';') != std::string_view::npos) {
      *error = where +
               " has semicolons, must have commas between columns and "
               "points in numbers";
      return std::nullopt;
    }
    if (fields.size() != kNames.size()) {
      *error = where + " has " + std::to_string(fields.size()) +
               " columns, must have 6: sx,sy,sz,tx,ty,tz" +
               GuessKind(fields.size());
      return std::nullopt;
    }
    const bool is_names =
        is_first && std::ranges::find(kNames, fields.front()) != kNames.end();
    is_first = false;
    if (is_names && std::ranges::equal(fields, kNames)) continue;
    if (is_names) {
      *error = where + ": names of columns must be sx,sy,sz,tx,ty,tz in order";
      return std::nullopt;
    }
    for (std::size_t column = 0; column < kNames.size(); ++column) {
      const std::optional<double> value = ParseNumber(fields[column]);
      if (!value || !std::isfinite(*value)) {
        *error = where + ", column " + std::string(kNames[column]) + ": " +
                 Quoted(fields[column]) +
                 (value ? " is not finite" : " is not a number");
        return std::nullopt;
      }
      values.push_back(*value);
    }
  }

  if (is_first) {
    *error =
        name + ": is empty or has only comments, must have " + kExpectedLines;
    return std::nullopt;
  }
  if (values.empty()) return MatchedPoints();
  const auto num_matches = static_cast<Eigen::Index>(values.size() / 6);
  const Eigen::Map<const Eigen::Matrix<double, 6, Eigen::Dynamic>> rows(
      values.data(), 6, num_matches);
  return MatchedPoints{rows.topRows<3>(), rows.bottomRows<3>()};
}

std::string FormatMatches(const PointsRef& source, const PointsRef& target) {
  std::string text = "sx,sy,sz,tx,ty,tz\n";
  std::array<char, 32> number;
  for (Eigen::Index i = 0; i < source.cols(); ++i) {
    for (int column = 0; column < 6; ++column) {
      const double value =
          column < 3 ? source(column, i) : target(column - 3, i);
      const auto result =
          std::to_chars(number.data(), number.data() + number.size(), value);
      text.append(number.data(), result.ptr);
      text += column < 5 ? ',' : '\n';
    }
  }
  return text;
}

}  // namespace quatro
