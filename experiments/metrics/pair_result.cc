// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/metrics/pair_result.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string_view>
#include <system_error>
#include <utility>

#include "experiments/base/csv_line.h"
#include "experiments/base/number_text.h"
#include "features/base/cloud_text.h"
#include "features/base/file.h"

namespace quatro {
namespace {

constexpr long double kLongDegree =
    3.14159265358979323846264338327950288L / 180.0L;
constexpr long double kMillisecond = 1e-3L;
constexpr char kUnknown[] = "unknown";
constexpr double kInfinity = std::numeric_limits<double>::infinity();

const char* const kColumns[] = {"pair",
                                "set",
                                "bin",
                                "method",
                                "status",
                                "distance_m",
                                "true_yaw_deg",
                                "true_tilt_deg",
                                "rotation_error_deg",
                                "yaw_error_deg",
                                "translation_error_m",
                                "probability",
                                "matches",
                                "consistent",
                                "inliers",
                                "m00",
                                "m01",
                                "m02",
                                "m03",
                                "m10",
                                "m11",
                                "m12",
                                "m13",
                                "m20",
                                "m21",
                                "m22",
                                "m23",
                                "total_ms",
                                "stages_ms"};
constexpr std::size_t kNumColumns = std::size(kColumns);

const char* const kStatuses[] = {
    "registered", "ambiguous", "degenerate", "insufficient", "unreadable"};

// Parses text * unit, rounded once. Returns nullopt unless the whole text is a
// finite number.
std::optional<double> ParseNumber(std::string_view text, long double unit) {
  long double number = 0.0L;
  const char* const last = text.data() + text.size();
  const auto [end, code] = std::from_chars(text.data(), last, number);
  const auto value = static_cast<double>(number * unit);
  if (code != std::errc() || end != last || !std::isfinite(value)) {
    return std::nullopt;
  }
  return value;
}

// The fewest digits from which ParseNumber recovers `value`.
std::string FormatNumber(double value, long double unit) {
  char text[64];
  const auto shortest = static_cast<double>(value / unit);
  std::string number(text, std::to_chars(text, text + 64, shortest).ptr);
  for (int digits = 16; digits <= 21; ++digits) {
    if (ParseNumber(number, unit) == value) break;
    number.assign(
        text,
        std::to_chars(
            text, text + 64, value / unit, std::chars_format::general, digits)
            .ptr);
  }
  return number;
}

std::string FormatNumber(const std::optional<double>& value, long double unit) {
  return value ? FormatNumber(*value, unit) : "";
}

// "voxels=1.5;features=60"
std::string FormatStages(const std::vector<StageTime>& stages) {
  std::string text;
  for (const StageTime& stage : stages) {
    if (!text.empty()) text += ';';
    text += stage.stage + '=' + FormatNumber(stage.seconds, kMillisecond);
  }
  return text;
}

// Reads the cells of a line one after another and remembers the reason for the
// first invalid one.
class CellReader {
 public:
  explicit CellReader(const std::vector<std::string>* cells) : cells_(*cells) {}

  const std::string& error() const { return error_; }

  const std::string& Text() { return cells_[next_++]; }

  std::string Name() {
    const std::string& text = Text();
    if (text.empty()) Fail("is empty");
    return text;
  }

  std::string Status() {
    const std::string& text = Text();
    if (std::find(std::begin(kStatuses), std::end(kStatuses), text) ==
        std::end(kStatuses)) {
      Fail("is not a status: " + Quoted(text));
    }
    return text;
  }

  std::optional<double> Number(double min,
                               double max,
                               long double unit = 1.0L) {
    const std::string& text = Text();
    if (text.empty()) return std::nullopt;
    const auto value = ParseNumber(text, unit);
    if (!value) {
      Fail("is not a finite number: " + Quoted(text));
    } else if (*value < min || *value > max) {
      Fail("is out of range: " + Quoted(text));
    }
    return value;
  }

  double NumberThere(double min, double max, long double unit = 1.0L) {
    if (cells_[next_].empty()) {
      ++next_;
      Fail("is empty");
      return 0.0;
    }
    return Number(min, max, unit).value_or(0.0);
  }

  long Count() {
    const std::string& text = Text();
    long count = -1;
    const char* const last = text.data() + text.size();
    const auto [end, code] = std::from_chars(text.data(), last, count);
    if (code != std::errc() || end != last || count < 0) {
      Fail("is not a count: " + Quoted(text));
    }
    return count;
  }

  // Whether the next cell is `text`, which is consumed then.
  bool Takes(std::string_view text) {
    if (cells_[next_] != text) return false;
    ++next_;
    return true;
  }

  // Reads the next `n` cells, the first of which is not consumed.
  bool AreEmpty(std::size_t n) const {
    const auto first = cells_.begin() + static_cast<std::ptrdiff_t>(next_);
    return std::all_of(first,
                       first + static_cast<std::ptrdiff_t>(n),
                       [](const std::string& cell) { return cell.empty(); });
  }

  void Skip(std::size_t n) { next_ += n; }

  std::vector<StageTime> Stages() {
    const std::string& text = Text();
    std::vector<StageTime> stages;
    for (const std::string_view part : SplitFields(text, ";")) {
      const std::size_t equals = part.find('=');
      const auto seconds =
          equals == std::string_view::npos
              ? std::nullopt
              : ParseNumber(part.substr(equals + 1), kMillisecond);
      if (!seconds || *seconds < 0.0 || equals == 0) {
        Fail("has no 'stage=ms' in " + Quoted(part));
        break;
      }
      stages.push_back({std::string(part.substr(0, equals)), *seconds});
    }
    return stages;
  }

  // `reason` refers to the cell read last.
  void Fail(const std::string& reason) {
    if (!error_.empty()) return;
    error_ = std::string("column ") + kColumns[next_ - 1] + " " + reason;
  }

 private:
  const std::vector<std::string>& cells_;
  std::size_t next_ = 0;
  std::string error_;
};

std::optional<PairError> ReadError(CellReader* cells) {
  if (cells->AreEmpty(3)) {
    cells->Skip(3);
    return std::nullopt;
  }
  PairError error;
  error.rotation = cells->NumberThere(0.0, M_PI, kLongDegree);
  error.yaw = cells->NumberThere(0.0, M_PI, kLongDegree);
  error.translation = cells->NumberThere(0.0, kInfinity);
  return error;
}

std::optional<Rigid3> ReadPoseCells(CellReader* cells) {
  if (cells->AreEmpty(12)) {
    cells->Skip(12);
    return std::nullopt;
  }
  Rigid3 pose;
  for (Eigen::Index row = 0; row < 3; ++row) {
    for (Eigen::Index column = 0; column < 3; ++column) {
      pose.rotation(row, column) = cells->NumberThere(-1.01, 1.01);
    }
    pose.translation(row) = cells->NumberThere(-kInfinity, kInfinity);
  }
  const Eigen::Matrix3d square = pose.rotation * pose.rotation.transpose();
  if (!square.isIdentity(1e-6) || pose.rotation.determinant() < 0.0) {
    cells->Fail("completes a matrix that is not a rotation");
  }
  return pose;
}

}  // namespace

PairError MeasureError(const Rigid3& true_target_from_source,
                       const Rigid3& estimated_target_from_source) {
  const Rigid3& truth = true_target_from_source;
  const Rigid3& estimate = estimated_target_from_source;
  // Equation (1).
  return {AngleBetween(truth.rotation, estimate.rotation),
          std::abs(std::remainder(Yaw(estimate.rotation) - Yaw(truth.rotation),
                                  2.0 * M_PI)),
          (estimate.translation - truth.translation).norm()};
}

std::string ResultCsvHeader() {
  return JoinCsvLine({std::begin(kColumns), std::end(kColumns)});
}

std::string FormatResultCsv(const PairResult& result) {
  const auto& error = result.error;
  std::vector<std::string> cells = {
      result.pair,
      result.set,
      result.bin,
      result.method,
      result.status,
      result.is_truth_known ? FormatNumber(result.distance, 1.0L) : kUnknown,
      FormatNumber(result.true_yaw, kLongDegree),
      FormatNumber(result.true_tilt, kLongDegree),
      error ? FormatNumber(error->rotation, kLongDegree) : "",
      error ? FormatNumber(error->yaw, kLongDegree) : "",
      error ? FormatNumber(error->translation, 1.0L) : "",
      FormatNumber(result.probability, 1.0L),
      std::to_string(result.num_matches),
      std::to_string(result.num_consistent),
      std::to_string(result.num_inliers)};
  for (Eigen::Index i = 0; i < 12; ++i) {
    cells.push_back(
        result.target_from_source
            ? FormatNumber(result.target_from_source->ToMatrix()(i / 4, i % 4),
                           1.0L)
            : "");
  }
  cells.push_back(FormatNumber(result.total_seconds, kMillisecond));
  cells.push_back(FormatStages(result.stage_times));
  return JoinCsvLine(cells);
}

std::optional<PairResult> ParseResultCsv(const std::string& line,
                                         std::string* error) {
  const auto cells = SplitCsvLine(line);
  if (!cells) {
    *error = "has a quote that does not enclose a cell";
    return std::nullopt;
  }
  if (cells->size() != kNumColumns) {
    *error = "has " + std::to_string(cells->size()) + " columns, must have " +
             std::to_string(kNumColumns);
    return std::nullopt;
  }
  CellReader reader(&*cells);
  PairResult result;
  result.pair = reader.Name();
  result.set = reader.Text();
  result.bin = reader.Text();
  result.method = reader.Name();
  result.status = reader.Status();
  result.is_truth_known = !reader.Takes(kUnknown);
  if (result.is_truth_known) result.distance = reader.Number(0.0, kInfinity);
  result.true_yaw = reader.Number(-M_PI, M_PI, kLongDegree);
  result.true_tilt = reader.Number(0.0, M_PI, kLongDegree);
  result.error = ReadError(&reader);
  result.probability = reader.Number(0.0, 1.0);
  result.num_matches = reader.Count();
  result.num_consistent = reader.Count();
  result.num_inliers = reader.Count();
  result.target_from_source = ReadPoseCells(&reader);
  if (result.error && !result.target_from_source) {
    reader.Fail("is empty, but the line has an error of the pose");
  }
  result.total_seconds = reader.NumberThere(0.0, kInfinity, kMillisecond);
  result.stage_times = reader.Stages();
  *error = reader.error();
  if (!error->empty()) return std::nullopt;
  return result;
}

std::optional<std::vector<PairResult>> ReadResultCsv(const std::string& path,
                                                     std::string* error) {
  const auto text = ReadTextFile(path, error);
  if (!text) return std::nullopt;
  const auto lines = SplitLines(*text);
  if (lines.empty() || lines.front() != ResultCsvHeader()) {
    *error = path + ": line 1 must be " + ResultCsvHeader();
    return std::nullopt;
  }
  std::vector<PairResult> results;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::string where = path + ": line " + std::to_string(i + 1) + " ";
    if (i + 1 == lines.size() && !text->ends_with('\n')) {
      *error = where + "is truncated";
      return std::nullopt;
    }
    auto result = ParseResultCsv(std::string(lines[i]), error);
    if (!result) {
      *error = where + *error;
      return std::nullopt;
    }
    results.push_back(std::move(*result));
  }
  return results;
}

}  // namespace quatro
