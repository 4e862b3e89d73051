// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Points relative to their weighted mean c,
//
//   c = sum_i w_i p_i / sum_i w_i,        p_i' = p_i - c,                   (1)
//
// computed so that the p_i' keep their digits even if c is far from the origin.

#ifndef QUATRO_SOLVERS_CLOSED_FORM_CENTROID_H_
#define QUATRO_SOLVERS_CLOSED_FORM_CENTROID_H_

#include <Eigen/Core>
#include <algorithm>
#include <limits>

#include "features/base/types.h"

namespace quatro {

// Centered points and their mean.
struct CenteredPoints {
  Eigen::Vector3d centroid;  // c of (1) [m]
  Points points;             // p_i' of (1) [m]

  // The largest rounding error of the p_i, as given [m].
  double rounding = 0.0;
};

// At least one weight must be > 0. Points with zero weight do not affect c.
inline CenteredPoints Center(const PointsRef& points,
                             const WeightsRef& weights) {
  // Starts at the heaviest point, because differences to points near it are
  // exact.
  Eigen::Index heaviest = 0;
  weights.maxCoeff(&heaviest);
  const Eigen::Vector3d origin = points.col(heaviest);

  CenteredPoints centered;
  centered.points = points.colwise() - origin;
  const Eigen::Vector3d mean = centered.points * weights / weights.sum();
  centered.points.colwise() -= mean;
  centered.centroid = origin + mean;

  double reach = 0.0;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    if (weights[i] > 0.0) reach = std::max(reach, points.col(i).norm());
  }
  centered.rounding = reach * std::numeric_limits<double>::epsilon();
  return centered;
}

// The largest value that rounding of the points, as given, can cause in sum_i
// w_i p_i' q_i'^T [m^2]. A sum below it is indistinguishable from zero.
inline double RoundingOfMoments(const CenteredPoints& p,
                                const CenteredPoints& q,
                                const WeightsRef& weights) {
  constexpr double kMaxRoundings = 8.0;
  return kMaxRoundings * (p.rounding * q.points.colwise().norm() +
                          q.rounding * p.points.colwise().norm())
                             .dot(weights.transpose());
}

}  // namespace quatro

#endif  // QUATRO_SOLVERS_CLOSED_FORM_CENTROID_H_
