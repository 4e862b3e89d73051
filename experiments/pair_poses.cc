// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/pair_poses.h"

#include <Eigen/Core>
#include <cmath>
#include <string_view>
#include <vector>

#include "experiments/number_text.h"
#include "experiments/odometry/kitti_poses.h"
#include "features/file.h"

namespace quatro {
namespace {

constexpr double kMaxDeviation = 1e-6;  // Of the last row from 0 0 0 1.

std::optional<Rigid3> ParseMatrix(std::string_view text, std::string* reason) {
  const auto fields = SplitFields(text, ", \t");
  if (fields.size() != 16) {
    *reason = "has " + std::to_string(fields.size()) +
              " numbers after the pair, must have 16";
    return std::nullopt;
  }
  Eigen::Matrix<double, 4, 4, Eigen::RowMajor> matrix;
  for (std::size_t i = 0; i < 16; ++i) {
    const auto value = ParseFiniteNumber(fields[i]);
    if (!value) {
      *reason = "number " + std::to_string(i + 1) + " is not a finite number";
      return std::nullopt;
    }
    matrix.data()[i] = *value;
  }
  if ((matrix.row(3) - Eigen::RowVector4d(0, 0, 0, 1)).cwiseAbs().maxCoeff() >
      kMaxDeviation) {
    *reason = "does not end with the row 0 0 0 1";
    return std::nullopt;
  }
  const auto rigid = NearestRigid3(matrix.topRows<3>());
  if (!rigid) *reason = "is not a rotation and a translation";
  return rigid;
}

}  // namespace

std::optional<std::map<std::string, Rigid3>> ReadPairPoses(
    const std::string& path, std::string* error) {
  const auto text = ReadWholeFile(path, error);
  if (!text) return std::nullopt;
  std::map<std::string, Rigid3> poses;
  int line_number = 0;
  for (const std::string_view line : SplitLines(*text)) {
    ++line_number;
    if (SplitFields(line, " \t").empty() || line.starts_with('#')) continue;
    const std::string where = path + ": line " + std::to_string(line_number);
    const std::size_t comma = line.find(',');
    if (comma == 0 || comma == std::string_view::npos) {
      *error = where + " does not start with a pair and a comma";
      return std::nullopt;
    }
    std::string reason;
    const auto pose = ParseMatrix(line.substr(comma + 1), &reason);
    if (!pose) {
      *error = where + " " + reason;
      return std::nullopt;
    }
    if (!poses.emplace(line.substr(0, comma), *pose).second) {
      *error = where + " has a pair that was there before";
      return std::nullopt;
    }
  }
  if (poses.empty()) {
    *error = path + ": holds no pair; expected pair,m00,m01,...,m33 a line";
    return std::nullopt;
  }
  return poses;
}

}  // namespace quatro
