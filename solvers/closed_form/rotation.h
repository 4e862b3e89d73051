// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Rotation from weighted pairs in closed form, and the rigid transformation
// derived from it.
//
// Given pairs (s_i, t_i) and weights w_i >= 0, finds the rotation
//
//   R = argmin_{R in SO(3)}  sum_i w_i || t_i - R s_i ||^2.                 (1)
//
// Up to a constant, (1) depends on the pairs only through M. So it takes one
// pass over the pairs and
//
//   M = sum_i w_i t_i s_i^T = U diag(d1, d2, |d3|) V^T,
//   R = U diag(1, 1, det(U V^T)) V^T,   d3 = det(U V^T) |d3|.               (2)
//
// For R -> exp([delta]x) R the second derivative of (1) is
//
//   H = 2 tr(B) I - (B + B^T),   B = M R^T,                                 (3)
//
// with eigenvalues 2 (d2 + d3) <= 2 (d1 + d3) <= 2 (d1 + d2). The least is zero
// exactly if R is not unique: either the pairs are on one line through the
// origin, d2 = d3 = 0, or a reflection fits them so well that all rotations
// about one axis tie, d2 = -d3.
//
// Sources: Arun, Huang and Blostein, PAMI 1987; Umeyama, PAMI 1991 (the sign in
// (2)). The tests compare with Horn's quaternions (JOSA A 1987).

#ifndef QUATRO_SOLVERS_CLOSED_FORM_ROTATION_H_
#define QUATRO_SOLVERS_CLOSED_FORM_ROTATION_H_

#include <Eigen/Core>
#include <optional>

#include "features/base/rigid3.h"
#include "features/base/types.h"

namespace quatro {

// The minimum of (1) and its curvature.
struct RotationEstimate {
  // Rotates a direction from the source frame into the target frame.
  Eigen::Matrix3d target_from_source = Eigen::Matrix3d::Identity();

  // Value of (1) at the minimum [m^2].
  double cost = 0.0;

  // (3) [m^2/rad^2], delta in the target frame. With inverse variances [1/m^2]
  // as weights, 2 curvature^-1 is the covariance of delta [rad^2].
  Eigen::Matrix3d curvature = Eigen::Matrix3d::Zero();
};

// `source` and `target` hold the s_i and t_i column by column [m]. Their sizes
// and that of `weights` must be equal. Returns nullopt if the pairs do not
// determine a rotation: the least eigenvalue of (3) is zero up to rounding.
// This covers no pairs, one pair, all weights zero, and NaN.
std::optional<RotationEstimate> EstimateRotation(const PointsRef& source,
                                                 const PointsRef& target,
                                                 const WeightsRef& weights);

// The minimum of (4) and its curvature.
struct RigidEstimate {
  Rigid3 target_from_source;

  // Value of (4) at the minimum [m^2].
  double cost = 0.0;

  // Second derivative of (4) for a rotation by delta [rad] about the centroid c
  // of the source and a translation by tau [m],
  //   x -> exp([delta]x) R (x - c) + R c + t + tau,    in order (delta, tau).
  // The cross terms are zero. The blocks are (3) of the centered points and 2
  // sum_i w_i I.
  Eigen::Matrix<double, 6, 6> curvature = Eigen::Matrix<double, 6, 6>::Zero();
};

// The rigid transformation
//
//   R, t = argmin  sum_i w_i || q_i - R p_i - t ||^2                        (4)
//
// for points p_i in `source` and q_i in `target` [m]. R is (1) for the points
// relative to their weighted means, and t = mean(q) - R mean(p). The result is
// accurate far from the origin, too. Returns nullopt under the same conditions,
// with (3) of the centered points; in particular, the points must not be on one
// line.
std::optional<RigidEstimate> EstimateRigid(const PointsRef& source,
                                           const PointsRef& target,
                                           const WeightsRef& weights);

}  // namespace quatro

#endif  // QUATRO_SOLVERS_CLOSED_FORM_ROTATION_H_
