// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The attitude of a vehicle from an INS, and the part of it that gravity
// determines. With x forward, y to the left and z up,
//
//   world_from_body = R_z(yaw) R_y(pitch) R_x(roll).                        (1)
//
// Gravity constrains roll and pitch, so they do not drift, whereas the yaw
// does. Two level frames differ only by a rotation about the vertical,
//
//   target_from_source = level_from_target^-1 R_z level_from_source,        (2)
//   level_from_body    = R_y(pitch) R_x(roll).                              (3)

#ifndef QUATRO_SOLVERS_CLOSED_FORM_GRAVITY_H_
#define QUATRO_SOLVERS_CLOSED_FORM_GRAVITY_H_

#include <Eigen/Core>

namespace quatro {

// The rotation world_from_body as angles about x, then y, then z.
struct Attitude {
  double roll = 0.0;   // [rad]
  double pitch = 0.0;  // [rad]
  double yaw = 0.0;    // [rad]
};

// Equation (1).
Eigen::Matrix3d WorldFromBody(const Attitude& attitude);

// The inverse of WorldFromBody(), with |pitch| <= pi / 2. At |pitch| = pi / 2
// only one combination of roll and yaw is determined, and the angles returned
// may give a different rotation.
Attitude AttitudeOf(const Eigen::Matrix3d& world_from_body);

// Equation (3).
Eigen::Matrix3d LevelFromBody(double roll, double pitch);

// The part R_y R_x of the rotation R_z R_y R_x from source to target. Both
// attitudes are in the same world frame. Unlike in (2), an error in the
// difference of the yaws affects the result.
Eigen::Matrix3d RelativeTilt(const Attitude& source, const Attitude& target);

// The smallest rotation R with to = R from, for unit vectors. If they are
// opposite, R rotates by 180 deg about the component of the x axis
// perpendicular to them or, if they are nearly along x, of the y axis.
Eigen::Matrix3d RotationBetween(const Eigen::Vector3d& from,
                                const Eigen::Vector3d& to);

}  // namespace quatro

#endif  // QUATRO_SOLVERS_CLOSED_FORM_GRAVITY_H_
