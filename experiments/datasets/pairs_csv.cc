// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/datasets/pairs_csv.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <utility>

#include "experiments/base/csv_line.h"
#include "experiments/base/number_text.h"
#include "experiments/datasets/csv_table.h"
#include "features/base/cloud_text.h"
#include "features/base/degree.h"

namespace quatro {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPose[] = {"tx", "ty", "tz", "qx", "qy", "qz", "qw"};
constexpr const char* kIns[] = {
    "source_rpy_deg", "target_rpy_deg", "ins_std_deg"};

// Whether the table has all of the columns or none of them.
template <std::size_t n>
bool HasAll(const CsvTable& table,
            const char* const (&columns)[n],
            const std::string& path,
            bool* has_them,
            std::string* error) {
  *has_them = table.Has(columns[0]);
  for (const char* column : columns) {
    if (table.Has(column) != *has_them) {
      *error = path + ": line 1 has " + (*has_them ? columns[0] : column) +
               " and no " + (*has_them ? column : columns[0]);
      return false;
    }
  }
  return true;
}

template <std::size_t n>
bool AllEmpty(const CsvRow& row, const char* const (&columns)[n]) {
  for (const char* column : columns) {
    if (!row.cells.at(column).empty()) return false;
  }
  return true;
}

// Replaces the backslashes of a Windows path unless a file of this name exists.
std::string PathOf(const fs::path& folder, std::string cell) {
  std::error_code ignored;
  if (!fs::exists(folder / cell, ignored)) {
    std::replace(cell.begin(), cell.end(), '\\', '/');
  }
  return (folder / cell).string();
}

bool ReadPose(const CsvRow& row, PairTask* task, std::string* error) {
  constexpr double kMaxDeviation = 1e-3;   // Deviation from unit length.
  constexpr double kMaxTranslation = 1e9;  // [m]
  double values[7];
  for (std::size_t i = 0; i < 7; ++i) {
    const auto value = ParseFiniteNumber(row.cells.at(kPose[i]));
    if (!value) {
      *error = row.where + ": " + kPose[i] + " is not a finite number";
      return false;
    }
    if (i < 3 && std::abs(*value) > kMaxTranslation) {
      *error = row.where + ": " + kPose[i] + " is " +
               Quoted(row.cells.at(kPose[i])) + " m, must be within +-1e9 m";
      return false;
    }
    values[i] = *value;
  }
  const Eigen::Quaterniond q(values[6], values[3], values[4], values[5]);
  if (!(std::abs(q.norm() - 1.0) <= kMaxDeviation)) {
    *error = row.where + ": qx,qy,qz,qw is not of length 1";
    return false;
  }
  task->true_target_from_source = Rigid3{q.normalized().toRotationMatrix(),
                                         {values[0], values[1], values[2]}};
  return true;
}

bool ReadAttitude(const CsvRow& row,
                  const char* column,
                  Attitude* attitude,
                  std::string* error) {
  const auto fields = SplitFields(row.cells.at(column), ", ");
  double angles[3];
  for (std::size_t i = 0; i < 3; ++i) {
    const auto angle =
        fields.size() == 3 ? ParseFiniteNumber(fields[i]) : std::nullopt;
    if (!angle) {
      *error = row.where + ": " + column + " is not \"roll,pitch,yaw\"";
      return false;
    }
    angles[i] = *angle * kDegree;
  }
  *attitude = {angles[0], angles[1], angles[2]};
  return true;
}

bool ReadIns(const CsvRow& row, PairTask* task, std::string* error) {
  PairIns ins;
  if (!ReadAttitude(row, kIns[0], &ins.source, error) ||
      !ReadAttitude(row, kIns[1], &ins.target, error)) {
    return false;
  }
  const auto std_deg = ParseFiniteNumber(row.cells.at(kIns[2]));
  if (!std_deg || *std_deg < 0.0) {
    *error = row.where + ": ins_std_deg is not a number >= 0";
    return false;
  }
  ins.std = *std_deg * kDegree;
  task->ins = ins;
  return true;
}

}  // namespace

std::optional<PairSelection> ReadPairsCsv(const std::string& path,
                                          std::string* error) {
  const auto table = ReadCsvTable(path, error);
  if (!table) return std::nullopt;
  for (const char* column : {"source", "target"}) {
    if (!table->Has(column)) {
      *error = table->where_names + " has no column " + column + ", but " +
               Quoted(JoinCsvLine(table->columns));
      return std::nullopt;
    }
  }
  bool has_pose = false, has_ins = false;
  if (!HasAll(*table, kPose, path, &has_pose, error) ||
      !HasAll(*table, kIns, path, &has_ins, error)) {
    return std::nullopt;
  }
  const fs::path folder = fs::path(path).parent_path();
  PairSelection selection;
  for (std::size_t i = 0; i < table->rows.size(); ++i) {
    const CsvRow& row = table->rows[i];
    PairTask task;
    task.set = table->Has("set") ? row.cells.at("set")
                                 : fs::path(path).stem().string();
    char number[32];
    std::snprintf(number, sizeof(number), "/%06zu", i + 1);
    task.name = task.set + number;
    task.bin = "all";
    for (const auto& [column, file] : {std::pair("source", &task.source),
                                       std::pair("target", &task.target)}) {
      const std::string& cell = row.cells.at(column);
      if (cell.empty()) {
        *error = row.where + ": " + column + " is empty";
        return std::nullopt;
      }
      *file = PathOf(folder, cell);
    }
    if (has_pose && !AllEmpty(row, kPose) && !ReadPose(row, &task, error)) {
      return std::nullopt;
    }
    task.is_truth_known =
        has_pose || (table->Has("apart") && !row.cells.at("apart").empty());
    if (has_ins && !AllEmpty(row, kIns) && !ReadIns(row, &task, error)) {
      return std::nullopt;
    }
    selection.tasks.push_back(std::move(task));
  }
  if (selection.tasks.empty()) {
    *error = path + ": holds no pair";
    return std::nullopt;
  }
  CountMissingScans(&selection);
  return selection;
}

}  // namespace quatro
