// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/programs/bound_flags.h"

#include <Eigen/SVD>
#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string_view>
#include <system_error>
#include <vector>

#include "experiments/base/number_text.h"
#include "features/base/cloud_text.h"
#include "features/base/degree.h"
#include "features/base/file.h"

namespace quatro {
namespace {

// Allows for rounded numbers in a text file.
constexpr double kMaxRotationError = 1e-3;

// Levels of JSON, which is written by recursion.
constexpr int kMaxDepth = 100;

constexpr char kExpected[] =
    ", must be 4 numbers x,y,z,yaw_deg, or 12 or 16, the rows of "
    "target_from_source";

// The nearest rotation, or nullopt if the matrix is not nearly one.
std::optional<Eigen::Matrix3d> NearestRotation(const Eigen::Matrix3d& matrix) {
  if (!matrix.isUnitary(kMaxRotationError) || matrix.determinant() < 0.0) {
    return std::nullopt;
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(
      matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

std::optional<Rigid3> PoseOfNumbers(const std::string& where,
                                    const std::vector<double>& numbers,
                                    std::string* error) {
  Rigid3 pose;
  if (numbers.size() == 4) {
    pose.rotation = RotationZ(numbers[3] * kDegree);
    pose.translation << numbers[0], numbers[1], numbers[2];
    return pose;
  }
  if (numbers.size() != 12 && numbers.size() != 16) {
    *error = where + " has " + std::to_string(numbers.size()) + " numbers" +
             kExpected;
    return std::nullopt;
  }
  const Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>> rows(
      numbers.data());
  const auto rotation = NearestRotation(rows.leftCols<3>());
  if (!rotation) {
    *error = where +
             ": columns 1 to 3 are no rotation; they must be orthonormal with "
             "determinant 1, each row followed by x, y or z [m]";
    return std::nullopt;
  }
  if (numbers.size() == 16 && (numbers[12] != 0.0 || numbers[13] != 0.0 ||
                               numbers[14] != 0.0 || numbers[15] != 1.0)) {
    *error = where + ": the last row must be 0 0 0 1";
    return std::nullopt;
  }
  pose.rotation = *rotation;
  pose.translation = rows.col(3);
  return pose;
}

}  // namespace

std::optional<Rigid3> ParsePose(const std::string& flag,
                                const std::string& value,
                                std::string* error) {
  std::error_code ignored;
  const std::string where = "--" + flag + "=" + value;
  std::string text = value;
  if (value.find(',') == std::string::npos ||
      std::filesystem::exists(value, ignored)) {
    const auto bytes = ReadWholeFile(value, error);
    if (!bytes) {
      *error = "--" + flag + ": " + *error;
      return std::nullopt;
    }
    text = *bytes;
    // The answer of quatro_register or quatro_solve.
    bool is_too_deep = false;
    const auto answer = nlohmann::json::parse(
        text,
        [&](int depth, nlohmann::json::parse_event_t, nlohmann::json&) {
          is_too_deep = is_too_deep || depth > kMaxDepth;
          return depth <= kMaxDepth;
        },
        /*allow_exceptions=*/false);
    if (is_too_deep) {
      *error = where + ": is nested more than " + std::to_string(kMaxDepth) +
               " levels deep" + kExpected;
      return std::nullopt;
    }
    if (answer.is_object() && answer.contains("target_from_source")) {
      text = answer["target_from_source"].dump();
    }
  }
  std::vector<double> numbers;
  for (const std::string_view field : SplitFields(text, ", \t\r\n[];")) {
    const auto number = ParseFiniteNumber(field);
    if (!number) {
      *error =
          where + ": " + Quoted(field) + " is not a finite number" + kExpected;
      return std::nullopt;
    }
    numbers.push_back(*number);
  }
  return PoseOfNumbers(where, numbers, error);
}

std::optional<PoseBounds> ParseBoundFlags(const BoundFlags& flags,
                                          bool is_local,
                                          std::string* error) {
  PoseBounds bounds;
  std::ostringstream problem;
  if (!(flags.max_translation >= 0.0)) {
    problem << "--max_translation=" << flags.max_translation
            << ", must be >= 0 [m]; 0: any";
  } else if (!(flags.max_yaw_deg >= 0.0 && flags.max_yaw_deg <= 180.0)) {
    problem << "--max_yaw_deg=" << flags.max_yaw_deg
            << ", must be in [0, 180]; 180: any";
  } else if (!(flags.max_tilt_deg >= 0.0 && flags.max_tilt_deg <= 180.0)) {
    problem << "--max_tilt_deg=" << flags.max_tilt_deg
            << ", must be in [0, 180]";
  }
  *error = problem.str();
  if (!error->empty()) return std::nullopt;
  if (flags.max_translation > 0.0) {
    bounds.max_translation = flags.max_translation;
  }
  if (flags.max_yaw_deg < 180.0) bounds.max_yaw = flags.max_yaw_deg * kDegree;
  bounds.max_tilt = flags.max_tilt_deg * kDegree;
  if (flags.max_tilt_deg != BoundFlags().max_tilt_deg && !bounds.IsActive()) {
    *error =
        "--max_tilt_deg has no effect without other bounds; add "
        "--max_translation [m] or --max_yaw_deg";
    return std::nullopt;
  }
  if (flags.guess.empty()) return bounds;
  if (!bounds.IsActive() && !is_local) {
    *error =
        "--guess has no effect on this method without bounds about it; add "
        "--max_translation [m] or --max_yaw_deg";
    return std::nullopt;
  }
  const auto guess = ParsePose("guess", flags.guess, error);
  if (!guess) return std::nullopt;
  bounds.guess = *guess;
  return bounds;
}

}  // namespace quatro
