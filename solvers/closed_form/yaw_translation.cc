// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "solvers/closed_form/yaw_translation.h"

#include <glog/logging.h>

#include "solvers/closed_form/centroid.h"
#include "solvers/closed_form/yaw.h"

namespace quatro {
std::optional<YawTranslationEstimate> EstimateYawTranslation(
    const PointsRef& source,
    const PointsRef& target,
    const WeightsRef& weights) {
  CHECK_EQ(source.cols(), target.cols());
  CHECK_EQ(source.cols(), weights.size());
  const double total_weight = weights.sum();
  if (!(total_weight > 0.0)) return std::nullopt;

  const CenteredPoints p = Center(source, weights);
  const CenteredPoints q = Center(target, weights);
  const auto yaw = EstimateYaw(p.points, q.points, weights);
  const double floor = RoundingOfMoments(p, q, weights);
  if (!yaw || !(yaw->curvature > floor)) {
    return std::nullopt;  // Also if a height is NaN.
  }

  const Eigen::Matrix3d R = RotationZ(yaw->target_from_source);
  YawTranslationEstimate estimate;
  estimate.target_from_source = {R, q.centroid - R * p.centroid};
  estimate.yaw = yaw->target_from_source;
  estimate.cost = yaw->cost + (q.points.row(2) - p.points.row(2))
                                  .array()
                                  .square()
                                  .matrix()
                                  .dot(weights.transpose());
  estimate.curvature.diagonal() << yaw->curvature,
      Eigen::Vector3d::Constant(2.0 * total_weight);
  return estimate;
}

}  // namespace quatro
