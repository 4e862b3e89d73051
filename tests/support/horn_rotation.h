// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The problem of solvers/closed_form/rotation.h solved by another closed form:
// the quaternion that is the eigenvector of the largest eigenvalue of a
// symmetric 4x4 matrix, whose entries are sums of those of M.
//
// Source: Horn, "Closed-form solution of absolute orientation using unit
// quaternions", JOSA A 1987.

#ifndef QUATRO_TESTS_SUPPORT_HORN_ROTATION_H_
#define QUATRO_TESTS_SUPPORT_HORN_ROTATION_H_

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <optional>

#include "features/base/types.h"
#include "solvers/closed_form/rotation.h"

namespace quatro {

inline std::optional<RotationEstimate> EstimateRotationHorn(
    const PointsRef& source,
    const PointsRef& target,
    const WeightsRef& weights) {
  Eigen::Matrix3d M = Eigen::Matrix3d::Zero();
  double scale = 0.0;
  for (Eigen::Index i = 0; i < source.cols(); ++i) {
    M += weights[i] * target.col(i) * source.col(i).transpose();
    scale += weights[i] * source.col(i).norm() * target.col(i).norm();
  }
  if (!M.allFinite()) return std::nullopt;
  const Eigen::Vector3d skew(
      M(2, 1) - M(1, 2), M(0, 2) - M(2, 0), M(1, 0) - M(0, 1));
  Eigen::Matrix4d N;  // Rows and columns are w, x, y, z.
  N(0, 0) = M.trace();
  N.topRightCorner<1, 3>() = skew.transpose();
  N.bottomLeftCorner<3, 1>() = skew;
  N.bottomRightCorner<3, 3>() =
      M + M.transpose() - M.trace() * Eigen::Matrix3d::Identity();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> eigen(N);
  // The least curvature is the gap between the two largest eigenvalues.
  if (!(eigen.eigenvalues()[3] - eigen.eigenvalues()[2] > 1e-12 * scale)) {
    return std::nullopt;
  }
  const Eigen::Vector4d q = eigen.eigenvectors().col(3);
  const Eigen::Matrix3d R =
      Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
  RotationEstimate rotation;
  rotation.target_from_source = R;
  const Eigen::Matrix3d B = M * R.transpose();
  rotation.curvature =
      2.0 * B.trace() * Eigen::Matrix3d::Identity() - (B + B.transpose());
  rotation.cost =
      (target - R * source).colwise().squaredNorm().transpose().dot(weights);
  return rotation;
}

}  // namespace quatro

#endif  // QUATRO_TESTS_SUPPORT_HORN_ROTATION_H_
