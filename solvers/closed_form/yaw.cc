// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "solvers/closed_form/yaw.h"

#include <glog/logging.h>

#include <Eigen/Core>
#include <cmath>
#include <limits>

namespace quatro {

std::optional<YawEstimate> EstimateYaw(const PointsRef& source,
                                       const PointsRef& target,
                                       const WeightsRef& weights) {
  CHECK_EQ(source.cols(), target.cols());
  CHECK_EQ(source.cols(), weights.size());

  // Equation (2). `scale` is an upper bound on hypot(S, C). The ratio of the
  // two separates signal from rounding, whatever the unit of the weights.
  double S = 0.0;
  double C = 0.0;
  double scale = 0.0;
  for (Eigen::Index i = 0; i < source.cols(); ++i) {
    const auto s = source.col(i).head<2>();
    const auto t = target.col(i).head<2>();
    S += weights[i] * (s.x() * t.y() - s.y() * t.x());
    C += weights[i] * s.dot(t);
    scale += weights[i] * s.norm() * t.norm();
  }

  const double alignment = std::hypot(S, C);
  if (!(alignment > scale * std::numeric_limits<double>::epsilon())) {
    return std::nullopt;  // Also if scale is zero or anything is NaN.
  }

  YawEstimate yaw;
  yaw.target_from_source = std::atan2(S, C);
  yaw.curvature = 2.0 * alignment;

  // Summed from residuals, because the expanded form of (1) would cancel
  // exactly when the fit is good.
  Eigen::Matrix2d R;
  R << C, -S, S, C;
  R /= alignment;
  for (Eigen::Index i = 0; i < source.cols(); ++i) {
    const Eigen::Vector2d residual =
        target.col(i).head<2>() - R * source.col(i).head<2>();
    yaw.cost += weights[i] * residual.squaredNorm();
  }
  return yaw;
}

}  // namespace quatro
