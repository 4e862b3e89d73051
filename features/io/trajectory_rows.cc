// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/io/trajectory_rows.h"

#include <Eigen/Core>
#include <Eigen/LU>
#include <cmath>

namespace quatro {
namespace {

// Files have four decimals or more.
constexpr double kRounding = 1e-3;

bool IsRotation(const std::vector<double>& row) {
  const Eigen::Matrix3d rotation =
      Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(row.data())
          .leftCols<3>();
  return (rotation * rotation.transpose()).isIdentity(kRounding) &&
         rotation.determinant() > 0;
}

}  // namespace

void TrajectoryRows::Add(const std::vector<double>& row) {
  is_tum_ =
      is_tum_ && row.size() == 8 && (num_rows_ == 0 || row[0] > time_) &&
      std::abs(Eigen::Vector4d(row.data() + 4).squaredNorm() - 1) < kRounding;
  is_kitti_ = is_kitti_ && row.size() == 12 && IsRotation(row);
  if (is_tum_) time_ = row[0];
  ++num_rows_;
}

std::string_view TrajectoryRows::Format() const {
  if (num_rows_ < 2) return "";
  return is_tum_ ? "TUM" : is_kitti_ ? "KITTI" : "";
}

}  // namespace quatro
