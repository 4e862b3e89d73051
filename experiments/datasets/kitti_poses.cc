// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/datasets/kitti_poses.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <cstdio>
#include <string_view>

#include "experiments/base/number_text.h"
#include "features/base/file.h"

namespace quatro {
namespace {

using Rows = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;

constexpr double kMaxEntryDeviation = 1e-3;

// Parses the 12 fields from `first` on. Returns nullopt with *reason set if
// they are not a pose.
std::optional<Rigid3> ParseRows(const std::vector<std::string_view>& fields,
                                std::size_t first,
                                std::string* reason) {
  if (fields.size() != first + 12) {
    *reason = "has " +
              std::to_string(fields.size() - std::min(first, fields.size())) +
              " numbers, must have 12";
    return std::nullopt;
  }
  Rows rows;
  for (std::size_t i = 0; i < 12; ++i) {
    const auto value = ParseFiniteNumber(fields[first + i]);
    if (!value) {
      *reason = "number " + std::to_string(i + 1) + " is not a finite number";
      return std::nullopt;
    }
    rows.data()[i] = *value;
  }
  auto rigid = NearestRigid3(rows);
  if (!rigid) *reason = "is not a rotation and a translation";
  return rigid;
}

}  // namespace

std::optional<Rigid3> NearestRigid3(const Eigen::Matrix<double, 3, 4>& matrix) {
  const Eigen::Matrix3d block = matrix.leftCols<3>();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(
      block, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Matrix3d rotation = svd.matrixU() * svd.matrixV().transpose();
  if (!matrix.allFinite() || rotation.determinant() < 0.0 ||
      !((block - rotation).cwiseAbs().maxCoeff() <= kMaxEntryDeviation)) {
    return std::nullopt;
  }
  return Rigid3{rotation, matrix.col(3)};
}

std::optional<std::vector<Rigid3>> ReadKittiPoses(const std::string& path,
                                                  std::string* error) {
  const auto text = ReadTextFile(path, error);
  if (!text) return std::nullopt;
  std::vector<Rigid3> poses;
  int line_number = 0, blank_line = 0;
  for (const std::string_view line : SplitLines(*text)) {
    ++line_number;
    const auto fields = SplitFields(line, kBlanks);
    if (fields.empty()) {
      blank_line = line_number;
      continue;
    }
    // Each line is a frame, so a blank line would shift the frame numbers of
    // all later lines.
    if (blank_line > 0) {
      *error = path + ": line " + std::to_string(blank_line) +
               " is blank, must have 12 numbers";
      return std::nullopt;
    }
    std::string reason;
    const auto pose = ParseRows(fields, 0, &reason);
    if (!pose) {
      *error = path + ": line " + std::to_string(line_number) + " " + reason;
      return std::nullopt;
    }
    poses.push_back(*pose);
  }
  if (poses.empty()) {
    *error = path + ": is empty; expected 12 numbers a line";
    return std::nullopt;
  }
  return poses;
}

std::string FormatKittiPoses(const std::vector<Rigid3>& poses) {
  std::string text;
  for (const Rigid3& pose : poses) {
    const Rows rows = pose.ToMatrix().topRows<3>();
    for (int i = 0; i < 12; ++i) {
      char number[40];
      std::snprintf(
          number, sizeof(number), "%s%.12e", i == 0 ? "" : " ", rows.data()[i]);
      text += number;
    }
    text += '\n';
  }
  return text;
}

std::optional<Rigid3> ReadKittiCalibration(const std::string& path,
                                           std::string* error) {
  const auto text = ReadTextFile(path, error);
  if (!text) return std::nullopt;
  for (const std::string_view line : SplitLines(*text)) {
    const auto fields = SplitFields(line, kBlanks);
    if (fields.empty() || (fields[0] != "Tr:" && fields[0] != "Tr")) continue;
    std::string reason;
    auto rigid = ParseRows(fields, 1, &reason);
    if (!rigid) *error = path + ": Tr " + reason;
    return rigid;
  }
  *error = path + ": has no line Tr:";
  return std::nullopt;
}

std::vector<Rigid3> MoveToCam0(const std::vector<Rigid3>& world_from_scan,
                               const Rigid3& cam0_from_lidar) {
  std::vector<Rigid3> poses;
  poses.reserve(world_from_scan.size());
  for (const Rigid3& pose : world_from_scan) {
    poses.push_back(cam0_from_lidar * pose * Inverse(cam0_from_lidar));
  }
  return poses;
}

std::optional<std::vector<Rigid3>> SelectFrames(
    const std::vector<Rigid3>& poses,
    const std::vector<int>& frames,
    std::string* error) {
  std::vector<Rigid3> selected;
  for (const int frame : frames) {
    if (frame < 0 || static_cast<std::size_t>(frame) >= poses.size()) {
      *error = "there is no pose of frame " + std::to_string(frame) +
               " among " + std::to_string(poses.size());
      return std::nullopt;
    }
    selected.push_back(poses[static_cast<std::size_t>(frame)]);
  }
  return selected;
}

}  // namespace quatro
