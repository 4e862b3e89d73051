// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Residuals for Ceres: distances of a transformed point from a line and from a
// plane. With the unit quaternion R in Eigen's order and the translation t,
//
//   line   r = d x (R p + t - a),    |r| the distance,   |d| = 1,           (1)
//   plane  r = n . (R p + t - a),    signed,             |n| = 1.           (2)
//
// Source: Zhang and Singh, RSS 2014, equations (2) and (3).

#ifndef QUATRO_EXPERIMENTS_ODOMETRY_ALOAM_LINE_PLANE_RESIDUALS_H_
#define QUATRO_EXPERIMENTS_ODOMETRY_ALOAM_LINE_PLANE_RESIDUALS_H_

#include <ceres/autodiff_cost_function.h>

#include <Eigen/Core>

#include "solvers/ceres/ceres_residuals.h"

namespace quatro {

// A point and the line or plane that it matches, given by one of its points and
// by the unit direction of the line or the unit normal of the plane.
struct SurfaceMatch {
  Eigen::Vector3d source;     // p [m]
  Eigen::Vector3d point;      // a [m]
  Eigen::Vector3d direction;  // d or n
};

// The distance of a point from a line, as a vector.
struct LineResidual {
  using CostFunction =
      ceres::AutoDiffCostFunction<LineResidual, 3, Turn::kSize, 3>;

  template <typename T>
  bool operator()(const T* r, const T* t, T* residual) const {
    const Eigen::Vector3<T> from_line =
        Turn::Rotate<T>(r, match.source.cast<T>()) +
        Eigen::Map<const Eigen::Vector3<T>>(t) - match.point.cast<T>();
    Eigen::Map<Eigen::Vector3<T>> cross(residual);
    cross = match.direction.cast<T>().cross(from_line);
    return true;
  }

  SurfaceMatch match;
};

// The signed distance of a point from a plane.
struct PlaneResidual {
  using CostFunction =
      ceres::AutoDiffCostFunction<PlaneResidual, 1, Turn::kSize, 3>;

  template <typename T>
  bool operator()(const T* r, const T* t, T* residual) const {
    const Eigen::Vector3<T> from_plane =
        Turn::Rotate<T>(r, match.source.cast<T>()) +
        Eigen::Map<const Eigen::Vector3<T>>(t) - match.point.cast<T>();
    residual[0] = match.direction.cast<T>().dot(from_plane);
    return true;
  }

  SurfaceMatch match;
};

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_ODOMETRY_ALOAM_LINE_PLANE_RESIDUALS_H_
