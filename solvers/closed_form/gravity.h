// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// What an INS says of a vehicle's attitude, and what of it is gravity's. With x
// ahead, y to the left and z up,
//
//   world_from_body = R_z(yaw) R_y(pitch) R_x(roll).                        (1)
//
// Roll and pitch are held by gravity and do not drift; yaw is not. Two frames
// that are level differ by a turn about the vertical alone,
//
//   target_from_source = level_from_target^-1 R_z level_from_source,        (2)
//   level_from_body    = R_y(pitch) R_x(roll).                              (3)

#ifndef QUATRO_SOLVERS_CLOSED_FORM_GRAVITY_H_
#define QUATRO_SOLVERS_CLOSED_FORM_GRAVITY_H_

#include <Eigen/Core>

namespace quatro {

// World from body: turns about x, then y, then z.
struct Attitude {
  double roll = 0.0;   // [rad]
  double pitch = 0.0;  // [rad]
  double yaw = 0.0;    // [rad]
};

// (1)
Eigen::Matrix3d WorldFromBody(const Attitude& attitude);

// Its inverse, with |pitch| <= pi / 2; at pi / 2 only one of many.
Attitude AttitudeOf(const Eigen::Matrix3d& world_from_body);

// (3)
Eigen::Matrix3d LevelFromBody(double roll, double pitch);

// The part R_y R_x of the rotation R_z R_y R_x from source to target, both
// attitudes in one world. Unlike (2), it is only as good as the difference of
// the yaws.
Eigen::Matrix3d RelativeTilt(const Attitude& source, const Attitude& target);

// The least rotation with to = R from, for unit vectors. For opposite ones, the
// half turn about x or, if they are nearly along x, about y: made perpendicular
// to them.
Eigen::Matrix3d RotationBetween(const Eigen::Vector3d& from,
                                const Eigen::Vector3d& to);

}  // namespace quatro

#endif  // QUATRO_SOLVERS_CLOSED_FORM_GRAVITY_H_
