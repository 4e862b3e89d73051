// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/estimators/consensus.h"

#include <glog/logging.h>

#include <algorithm>

namespace quatro {

double ConsensusCost(const PointsRef& source,
                     const PointsRef& target,
                     const Rigid3& target_from_source,
                     double noise_bound) {
  CHECK_EQ(source.cols(), target.cols());
  const double scale = 1.0 / (noise_bound * noise_bound);
  double cost = 0.0;
  for (Eigen::Index i = 0; i < source.cols(); ++i) {
    const Eigen::Vector3d moved =
        target_from_source * Eigen::Vector3d(source.col(i));
    cost += std::min(1.0, scale * (target.col(i) - moved).squaredNorm());
  }
  return cost;
}

std::vector<Eigen::Index> FindWithinBall(const PointsRef& source,
                                         const PointsRef& target,
                                         const Rigid3& target_from_source,
                                         double noise_bound) {
  CHECK_EQ(source.cols(), target.cols());
  const Points error = target - target_from_source.Apply(source);
  const double limit = noise_bound * noise_bound;
  std::vector<Eigen::Index> within;
  for (Eigen::Index i = 0; i < error.cols(); ++i) {
    if (error.col(i).squaredNorm() <= limit) within.push_back(i);
  }
  return within;
}

std::vector<Eigen::Index> FindInliers(const PointsRef& source,
                                      const PointsRef& target,
                                      const Rigid3& target_from_source,
                                      double noise_bound) {
  CHECK_EQ(source.cols(), target.cols());
  std::vector<Eigen::Index> inliers;
  for (Eigen::Index i = 0; i < source.cols(); ++i) {
    const Eigen::Vector3d moved =
        target_from_source * Eigen::Vector3d(source.col(i));
    if ((target.col(i) - moved).cwiseAbs().maxCoeff() <= noise_bound) {
      inliers.push_back(i);
    }
  }
  return inliers;
}

}  // namespace quatro
