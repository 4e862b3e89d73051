// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/io/point_text.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "features/base/cloud_text.h"
#include "features/io/cloud_fields.h"
#include "features/io/trajectory_rows.h"

namespace quatro {
namespace {

constexpr char kBlank = ' ';

// A line, and its number from 1.
struct Line {
  std::string_view text;  // Without a comment.
  std::string_view comment;
  std::uint64_t number = 0;

  std::string Name() const { return "line " + std::to_string(number); }
};

// The lines of a file that are not empty.
class Lines {
 public:
  explicit Lines(std::string_view text) : text_(text) {
    SkipByteOrderMark(&text_);
  }

  // Returns false at the end.
  bool Take(Line* line) {
    while (!text_.empty()) {
      const std::string_view whole = TakeLine(&text_);
      ++number_;
      const std::size_t end = std::min(whole.find('#'), whole.find("//"));
      line->text = Trim(whole.substr(0, end));
      line->comment =
          end < whole.size() ? whole.substr(end) : std::string_view();
      line->number = number_;
      if (!line->text.empty() || !line->comment.empty()) return true;
    }
    return false;
  }

 private:
  std::string_view text_;
  std::uint64_t number_ = 0;
};

char FindSeparator(std::string_view line) {
  for (const char separator : {';', ','}) {
    if (line.find(separator) != std::string_view::npos) return separator;
  }
  return kBlank;
}

// Fields may be empty unless blanks separate them. A separator at the end of
// the line has no field after it.
void Split(std::string_view line,
           char separator,
           std::vector<std::string_view>* fields) {
  fields->clear();
  if (separator == kBlank) {
    while (true) {
      const std::string_view word = TakeWord(&line);
      if (word.empty()) return;
      fields->push_back(word);
    }
  }
  while (!line.empty()) {
    const std::size_t end = std::min(line.find(separator), line.size());
    fields->push_back(Trim(line.substr(0, end)));
    line.remove_prefix(std::min(end + 1, line.size()));
  }
}

// The name without quotes, if it has any.
std::string_view Unquoted(std::string_view name) {
  const bool is_quoted =
      name.size() >= 2 && name.front() == '"' && name.back() == '"';
  return is_quoted ? name.substr(1, name.size() - 2) : name;
}

std::optional<CloudColumns> ColumnsOf(std::string_view header,
                                      std::size_t num_columns,
                                      std::string* error) {
  header = Trim(header.substr(std::min(header.find_first_not_of("#/"),  //
                                       header.size())));
  std::vector<std::string_view> names;
  Split(header, FindSeparator(header), &names);
  if (names.size() != num_columns) {
    *error = "has " + std::to_string(names.size()) +
             " names, must have one for each of " +
             std::to_string(num_columns) + " columns";
    return std::nullopt;
  }
  for (std::string_view& name : names) name = Unquoted(name);
  return FindCloudColumns(names, error);
}

CloudColumns FirstColumns(std::size_t num_columns) {
  CloudColumns columns = {0, 1, 2, std::nullopt};
  if (num_columns == 4) columns[3] = 3;
  return columns;
}

// Control characters are not in text, in whatever encoding.
bool LooksBinary(std::string_view bytes) {
  constexpr std::size_t kNumBytes = 512;
  const std::string_view start = bytes.substr(0, kNumBytes);
  return std::any_of(start.begin(), start.end(), [](char c) {
    return (c >= '\0' && c < '\t') || (c > '\r' && c < ' ') || c == '\x7f';
  });
}

class PointTextParser {
 public:
  PointTextParser(std::string_view bytes, std::string* error)
      : bytes_(bytes), lines_(bytes), error_(*error) {}

  std::optional<PointCloud> Parse() {
    if (LooksBinary(bytes_)) {
      error_ = "is binary, not text with a point on each line";
      return std::nullopt;
    }
    if (!TakeFirstPoint()) return std::nullopt;
    CloudBuilder builder(CountLines(bytes_), columns_[3].has_value());
    std::uint64_t num_points = 0;
    Line line = first_;
    do {
      if (line.text.empty()) continue;
      std::array<double, 4> row = {};
      if (!ReadRow(line, &row)) return std::nullopt;
      builder.Add(row);
      ++num_points;
    } while (lines_.Take(&line));
    if (const auto format = poses_.Format(); !format.empty()) {
      error_ = "is a trajectory (format " + std::string(format) +
               "), not points; give the file of a scan";
      return std::nullopt;
    }
    if (num_promised_ && *num_promised_ != num_points) {
      error_ = "line 1 says " + std::to_string(*num_promised_) +
               " points, but there are " + std::to_string(num_points) +
               "; is the file truncated?";
      return std::nullopt;
    }
    return builder.Build(&error_);
  }

 private:
  bool Fail(const Line& line, const std::string& reason) {
    error_ = line.Name() + ": " + reason;
    return false;
  }

  // Whether the first field of a line split by semicolons has a decimal comma.
  bool HasDecimalCommas(const Line& line) const {
    if (line.text.find(';') == std::string_view::npos) return false;
    std::string number(fields_.front());
    std::replace(number.begin(), number.end(), ',', '.');
    return number != fields_.front() && ParseNumber(number);
  }

  bool FailForCommas(const Line& line) {
    return Fail(line,
                "has semicolons and commas, must have points in numbers and "
                "one separator");
  }

  // Reads up to the first point, and finds the separator and the columns.
  bool TakeFirstPoint() {
    Line header, comment;
    while (lines_.Take(&first_)) {
      if (first_.text.empty()) {
        comment = first_;
        continue;
      }
      separator_ = FindSeparator(first_.text);
      Split(first_.text, separator_, &fields_);
      if (HasDecimalCommas(first_)) return FailForCommas(first_);
      if (!ParseNumber(fields_.front())) {
        if (!header.text.empty()) {
          return Fail(first_,
                      Quoted(fields_.front()) +
                          " is not a number; a header "
                          "must be one line");
        }
        header = first_;
        continue;
      }
      if (fields_.size() == 1 && header.text.empty() && !num_promised_ &&
          ParseCount(fields_.front())) {
        num_promised_ = ParseCount(fields_.front());
        continue;
      }
      return FindColumns(header, comment);
    }
    error_ = header.text.empty()
                 ? "points: there are none"
                 : header.Name() + ": " + Quoted(header.text) +
                       " is not a point, and no line follows; must be numbers "
                       "x y z";
    return false;
  }

  bool FindColumns(const Line& header, const Line& comment) {
    if (fields_.size() < 3) {
      return Fail(first_,
                  "has " + std::to_string(fields_.size()) +
                      (fields_.size() == 1 ? " number" : " numbers") +
                      ", must have at least three: x y z");
    }
    num_columns_ = fields_.size();
    columns_ = FirstColumns(num_columns_);
    std::string reason;
    if (header.text.empty()) {
      columns_ =
          ColumnsOf(comment.comment, num_columns_, &reason).value_or(columns_);
      return true;
    }
    const auto named = ColumnsOf(header.text, num_columns_, &reason);
    if (!named && header.text.starts_with("sx")) {
      return Fail(header,
                  "has the columns of matches, not of points; quatro_solve "
                  "takes such a file");
    }
    if (!named) {
      return Fail(header,
                  "header " + Quoted(header.text) + ": " + reason +
                      "; name the columns x, y and z, or remove the line");
    }
    columns_ = *named;
    has_header_ = true;
    return true;
  }

  bool ReadRow(const Line& line, std::array<double, 4>* row) {
    Split(line.text, separator_, &fields_);
    if (HasDecimalCommas(line)) return FailForCommas(line);
    // After the separator at its end, the last field may be empty.
    if (separator_ != kBlank && line.text.ends_with(separator_) &&
        fields_.size() + 1 == num_columns_) {
      fields_.push_back({});
    }
    if (fields_.size() != num_columns_) {
      return Fail(line,
                  "has " + std::to_string(fields_.size()) +
                      (fields_.size() == 1 ? " value, " : " values, ") +
                      first_.Name() + " has " + std::to_string(num_columns_));
    }
    for (std::size_t k = 0; k < row->size(); ++k) {
      if (!columns_[k]) continue;
      const std::string_view field = fields_[*columns_[k]];
      const auto number = ParseNumber(field);
      if (!number) return Fail(line, Quoted(field) + " is not a number");
      (*row)[k] = *number;
    }
    if (has_header_ || !poses_.MayBeTrajectory()) return true;
    std::vector<double> numbers;
    for (const std::string_view field : fields_) {
      numbers.push_back(ParseNumber(field).value_or(0));
    }
    poses_.Add(numbers);
    return true;
  }

  std::string_view bytes_;
  Lines lines_;
  std::string& error_;
  Line first_;
  char separator_ = kBlank;
  std::size_t num_columns_ = 0;
  CloudColumns columns_;
  bool has_header_ = false;
  TrajectoryRows poses_;
  std::optional<std::uint64_t> num_promised_;
  std::vector<std::string_view> fields_;
};

}  // namespace

std::optional<PointCloud> ParsePointText(std::string_view bytes,
                                         std::string* error) {
  return PointTextParser(bytes, error).Parse();
}

}  // namespace quatro
