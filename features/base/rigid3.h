// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A rigid transformation, named after what it does to coordinates:
//
//   x_in_target = target_from_source * x_in_source = R x_in_source + t.     (1)
//
// Inner names cancel in a chain, c_from_a = c_from_b * b_from_a.

#ifndef QUATRO_FEATURES_BASE_RIGID3_H_
#define QUATRO_FEATURES_BASE_RIGID3_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

#include "features/base/types.h"

namespace quatro {

// A rotation, then a translation.
struct Rigid3 {
  Eigen::Matrix3d rotation =
      Eigen::Matrix3d::Identity();                        // Orthonormal, det 1.
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();  // [m]

  // The homogeneous matrix.
  Eigen::Matrix4d ToMatrix() const {
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
    matrix.topLeftCorner<3, 3>() = rotation;
    matrix.topRightCorner<3, 1>() = translation;
    return matrix;
  }

  // Transforms all points.
  Points Apply(const PointsRef& points) const {
    return (rotation * points).colwise() + translation;
  }
};

// Transforms the point from frame a to frame b.
inline Eigen::Vector3d operator*(const Rigid3& b_from_a,
                                 const Eigen::Vector3d& x_in_a) {
  return b_from_a.rotation * x_in_a + b_from_a.translation;
}

// Applies b_from_a first, then c_from_b.
inline Rigid3 operator*(const Rigid3& c_from_b, const Rigid3& b_from_a) {
  return {c_from_b.rotation * b_from_a.rotation,
          c_from_b * b_from_a.translation};
}

// The inverse, a_from_b.
inline Rigid3 Inverse(const Rigid3& b_from_a) {
  const Eigen::Matrix3d a_from_b = b_from_a.rotation.transpose();
  return {a_from_b, -(a_from_b * b_from_a.translation)};
}

// Counter-clockwise rotation by `yaw` [rad] about z. Leaves z coordinates
// unchanged, bit for bit.
inline Eigen::Matrix3d RotationZ(double yaw) {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  rotation.topLeftCorner<2, 2>() << std::cos(yaw), -std::sin(yaw),
      std::sin(yaw), std::cos(yaw);
  return rotation;
}

// The yaw of R = R_z(yaw) R_y(pitch) R_x(roll). [rad], in [-pi, pi].
inline double Yaw(const Eigen::Matrix3d& rotation) {
  return std::atan2(rotation(1, 0), rotation(0, 0));
}

// The angle of the rotation between a and b [rad], in [0, pi]. Uses the skew
// part, because the trace loses the digits of small angles.
inline double AngleBetween(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  const Eigen::Matrix3d a_from_b = a.transpose() * b;
  const Eigen::Vector3d skew(a_from_b(2, 1) - a_from_b(1, 2),
                             a_from_b(0, 2) - a_from_b(2, 0),
                             a_from_b(1, 0) - a_from_b(0, 1));
  return std::atan2(skew.norm(), a_from_b.trace() - 1.0);
}

}  // namespace quatro

#endif  // QUATRO_FEATURES_BASE_RIGID3_H_
