// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "solvers/closed_form/gravity.h"

#include <Eigen/Geometry>
#include <cmath>

#include "features/base/rigid3.h"

namespace quatro {
namespace {

// Below this, |from + to| has lost the digits that give the plane of rotation.
constexpr double kOpposite = 1e-8;

Eigen::Matrix3d Reflection(const Eigen::Vector3d& unit_normal) {
  return Eigen::Matrix3d::Identity() -
         2.0 * unit_normal * unit_normal.transpose();
}

}  // namespace

Eigen::Matrix3d WorldFromBody(const Attitude& attitude) {
  return RotationZ(attitude.yaw) * LevelFromBody(attitude.roll, attitude.pitch);
}

Attitude AttitudeOf(const Eigen::Matrix3d& world_from_body) {
  const Eigen::Matrix3d& R = world_from_body;
  return {std::atan2(R(2, 1), R(2, 2)),
          std::atan2(-R(2, 0), std::hypot(R(2, 1), R(2, 2))),
          Yaw(R)};
}

Eigen::Matrix3d LevelFromBody(double roll, double pitch) {
  return (Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

Eigen::Matrix3d RelativeTilt(const Attitude& source, const Attitude& target) {
  const Eigen::Matrix3d target_from_source =
      WorldFromBody(target).transpose() * WorldFromBody(source);
  return RotationZ(Yaw(target_from_source)).transpose() * target_from_source;
}

Eigen::Matrix3d RotationBetween(const Eigen::Vector3d& from,
                                const Eigen::Vector3d& to) {
  // Maps `from` to -from, and that to `to`. The product of two reflections is a
  // rotation by twice the angle between their normals. It is orthonormal even
  // if |from + to| is small.
  const Eigen::Vector3d sum = from + to;
  Eigen::Vector3d normal = sum;
  if (sum.norm() < kOpposite) {
    normal = std::abs(from.x()) < 0.9 ? Eigen::Vector3d::UnitX().cross(from)
                                      : Eigen::Vector3d::UnitY().cross(from);
  }
  return Reflection(normal.normalized()) * Reflection(from);
}

}  // namespace quatro
