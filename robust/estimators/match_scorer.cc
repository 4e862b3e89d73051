// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/estimators/match_scorer.h"

#include <glog/logging.h>

#include <algorithm>
#include <cstddef>

#include "features/base/simd.h"

namespace quatro {
namespace {

constexpr Eigen::Index kLanes = 8;
constexpr Eigen::Index kFields = 7;
constexpr Eigen::Index kBlockSize = kLanes * kFields;
// The number of blocks between two comparisons with the limit.
constexpr Eigen::Index kStride = 8;

// Sums the costs of eight matches at a time, one in each lane. `motion` is R by
// rows, then t.
QUATRO_SIMD_CLONES double SumCosts(const double* blocks,
                                   Eigen::Index num_blocks,
                                   const double* motion,
                                   double limit) {
  double lanes[kLanes] = {};
  double cost = 0.0;
  for (Eigen::Index first = 0; first < num_blocks; first += kStride) {
    const Eigen::Index last = std::min(num_blocks, first + kStride);
    for (Eigen::Index b = first; b < last; ++b) {
      const double* block = blocks + b * kBlockSize;
      for (Eigen::Index k = 0; k < kLanes; ++k) {
        const double px = block[k];
        const double py = block[kLanes + k];
        const double pz = block[2 * kLanes + k];
        const double ex =
            block[3 * kLanes + k] -
            (motion[0] * px + motion[1] * py + motion[2] * pz + motion[9]);
        const double ey =
            block[4 * kLanes + k] -
            (motion[3] * px + motion[4] * py + motion[5] * pz + motion[10]);
        const double ez =
            block[5 * kLanes + k] -
            (motion[6] * px + motion[7] * py + motion[8] * pz + motion[11]);
        const double r2 = ex * ex + ey * ey + ez * ez;
        const double most = block[6 * kLanes + k];
        lanes[k] += r2 < most ? r2 : most;
      }
    }
    cost = 0.0;
    for (Eigen::Index k = 0; k < kLanes; ++k) cost += lanes[k];
    if (cost > limit) return cost;
  }
  return cost;
}

}  // namespace

MatchScorer::MatchScorer(const PointsRef& source,
                         const PointsRef& target,
                         double noise_bound)
    : num_matches_(source.cols()), noise_bound_(noise_bound) {
  CHECK_EQ(source.cols(), target.cols());
  const Eigen::Index num_blocks = (num_matches_ + kLanes - 1) / kLanes;
  blocks_.assign(static_cast<std::size_t>(num_blocks * kBlockSize), 0.0);
  for (Eigen::Index i = 0; i < num_matches_; ++i) {
    double* lane = blocks_.data() + i / kLanes * kBlockSize + i % kLanes;
    for (int axis = 0; axis < 3; ++axis) {
      lane[axis * kLanes] = source(axis, i) / noise_bound;
      lane[(3 + axis) * kLanes] = target(axis, i) / noise_bound;
    }
    lane[6 * kLanes] = 1.0;
  }
}

double MatchScorer::Cost(const Rigid3& target_from_source, double limit) const {
  const Eigen::Matrix3d& R = target_from_source.rotation;
  const Eigen::Vector3d t = target_from_source.translation / noise_bound_;
  const double motion[12] = {R(0, 0),
                             R(0, 1),
                             R(0, 2),
                             R(1, 0),
                             R(1, 1),
                             R(1, 2),
                             R(2, 0),
                             R(2, 1),
                             R(2, 2),
                             t[0],
                             t[1],
                             t[2]};
  return SumCosts(blocks_.data(),
                  static_cast<Eigen::Index>(blocks_.size()) / kBlockSize,
                  motion,
                  limit);
}

std::vector<Eigen::Index> MatchScorer::Inliers(const Rigid3& target_from_source,
                                               double factor) const {
  const Eigen::Vector3d t = target_from_source.translation / noise_bound_;
  std::vector<Eigen::Index> inliers;
  for (Eigen::Index i = 0; i < num_matches_; ++i) {
    const double* lane = blocks_.data() + i / kLanes * kBlockSize + i % kLanes;
    const Eigen::Vector3d p(lane[0], lane[kLanes], lane[2 * kLanes]);
    const Eigen::Vector3d q(
        lane[3 * kLanes], lane[4 * kLanes], lane[5 * kLanes]);
    const Eigen::Vector3d error = q - (target_from_source.rotation * p + t);
    if (error.squaredNorm() <= factor * factor) inliers.push_back(i);
  }
  return inliers;
}

}  // namespace quatro
