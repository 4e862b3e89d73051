// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A prior on the pose: hard bounds about a guess (R0, t0) of
// target_from_source. A pose (R, t) must satisfy
//
//   R R0^T = R_up(yaw) S(tilt),   |t - t0| <= max_translation,
//                                 |yaw| <= max_yaw,  tilt <= max_tilt,    (1)
//
// where R_up rotates about the vertical and S about a horizontal axis, which
// determines both. It follows from (1) that a match (p, q) can be an inlier
// only if q is close to the arc that R0 p describes about the vertical,
//
//   min { |R_up(a) R0 p + t0 - q| : |a| <= max_yaw }
//     <= max_translation + sqrt(3) noise_bound + 2 sin(max_tilt/2) |p|,   (2)
//
// because an inlier is within the noise bound on each axis, and a tilt moves a
// point at distance |p| by no more than the last term. Matches that violate (2)
// are removed before a solver sees them (robust/estimators/bound_solver.h), so
// that it cannot prefer a larger consensus elsewhere.

#ifndef QUATRO_ROBUST_ESTIMATORS_POSE_BOUNDS_H_
#define QUATRO_ROBUST_ESTIMATORS_POSE_BOUNDS_H_

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "features/base/rigid3.h"
#include "features/base/types.h"

namespace quatro {

// A guess and its bounds. The defaults allow every pose.
struct PoseBounds {
  Rigid3 guess;  // target_from_source, (R0, t0).
  double max_translation = std::numeric_limits<double>::infinity();  // [m]
  double max_yaw = M_PI;                                             // [rad]

  // Largest tilt from the guess [rad]. It has an effect only together with one
  // of the bounds above.
  double max_tilt = 0.0873;

  // The vertical in the target frame, a unit vector that points up. Leave it at
  // its default for Register() and RegisterMatches(), which use the vertical of
  // InsOptions.
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;

  // Whether the translation or the yaw is bounded.
  bool IsActive() const {
    return std::isfinite(max_translation) || max_yaw < M_PI;
  }

  // Whether the pose satisfies (1), with a tolerance of the noise bound [m] and
  // 0.01 rad. True if the bounds are not active.
  bool Contain(const Rigid3& target_from_source, double noise_bound) const;

  // The left side of (2) [m].
  double DistanceToArc(const Eigen::Vector3d& source,
                       const Eigen::Vector3d& target) const;

  // Whether the match satisfies (2). True if the bounds are not active.
  bool CanBeInlier(const Eigen::Vector3d& source,
                   const Eigen::Vector3d& target,
                   double noise_bound) const;

  // The columns of the matches that satisfy (2).
  std::vector<Eigen::Index> PossibleInliers(const PointsRef& source,
                                            const PointsRef& target,
                                            double noise_bound) const;

  // How far the pose is from the guess, and how far it may be. For example
  // "34.2 m, 12 deg of yaw and 1 deg of tilt from the guess; the bounds allow 5
  // m, 20 deg and 5 deg".
  std::string Describe(const Rigid3& target_from_source) const;
};

// The angles of the factors in R = R_up(yaw) S(tilt), as in (1).
struct YawAndTilt {
  double yaw = 0.0;   // [rad], in [-pi, pi].
  double tilt = 0.0;  // [rad], in [0, pi].
};

// Decomposes a rotation, for the unit vector `up`.
YawAndTilt Decompose(const Eigen::Matrix3d& rotation,
                     const Eigen::Vector3d& up);

}  // namespace quatro

#endif  // QUATRO_ROBUST_ESTIMATORS_POSE_BOUNDS_H_
