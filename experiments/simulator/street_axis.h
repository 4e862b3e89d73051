// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The axis along which a street is built. Places are (s, d), s meters along the
// axis and d to its left, on some ground (road.h, city.h).

#ifndef QUATRO_EXPERIMENTS_SIMULATOR_STREET_AXIS_H_
#define QUATRO_EXPERIMENTS_SIMULATOR_STREET_AXIS_H_

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "features/base/rigid3.h"

namespace quatro {

struct SideStreet {
  double s = 0.0;      // Position of its axis [m].
  double width = 8.0;  // [m]
  int side = 1;        // +1: to the left, -1: to the right.
};

class StreetAxis {
 public:
  virtual ~StreetAxis() = default;

  virtual double length() const = 0;      // [m]
  virtual double half_width() const = 0;  // Half of the roadway [m].

  // By ascending s.
  virtual const std::vector<SideStreet>& side_streets() const = 0;

  virtual double Heading(double s) const = 0;  // [rad]

  // The point in the world.
  virtual Eigen::Vector3d SurfacePoint(double s, double d) const = 0;

  // Whether s is in a side street or within `margin` [m] of its edges.
  bool IsInSideStreet(double s, int side, double margin) const {
    return std::any_of(side_streets().begin(),
                       side_streets().end(),
                       [&](const SideStreet& street) {
                         return street.side == side &&
                                std::abs(s - street.s) <
                                    street.width / 2.0 + margin;
                       });
  }

  // A frame with its origin on the ground, x along the street and z opposite to
  // gravity.
  Rigid3 WorldFromUpright(double s, double d) const {
    return {RotationZ(Heading(s)), SurfacePoint(s, d)};
  }

  // A frame with its origin on the ground, z normal to the ground under a car,
  // and x along the street, rotated by `yaw` [rad].
  Rigid3 WorldFromGround(double s, double d, double yaw) const {
    constexpr double kHalfBase = 1.35,
                     kHalfTrack = 0.75;  // Half a car's base and track [m].
    const Eigen::Vector3d ahead =
        SurfacePoint(s + kHalfBase, d) - SurfacePoint(s - kHalfBase, d);
    const Eigen::Vector3d left =
        SurfacePoint(s, d + kHalfTrack) - SurfacePoint(s, d - kHalfTrack);
    const Eigen::Vector3d x = ahead.normalized();
    const Eigen::Vector3d z = ahead.cross(left).normalized();
    Rigid3 world_from_street;
    world_from_street.rotation << x, z.cross(x), z;
    world_from_street.translation = SurfacePoint(s, d);
    return world_from_street * Rigid3{RotationZ(yaw), Eigen::Vector3d::Zero()};
  }
};

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_SIMULATOR_STREET_AXIS_H_
