// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// PCL's RANSAC on the same matched points, for comparison. Built only with
// -DQUATRO_WITH_PCL=ON. PCL has no FGR.
//
// Samples have three points and are rejected if two of them are closer than the
// cloud's mean standard deviation. The sample with the most inliers wins; the
// pose is one least-squares fit to its inliers.

#ifndef QUATRO_EXPERIMENTS_PEERS_PCL_RANSAC_H_
#define QUATRO_EXPERIMENTS_PEERS_PCL_RANSAC_H_

#include <cstdint>

#include "features/base/types.h"
#include "robust/estimators/pose_summary.h"

namespace quatro {

struct PclRansacOptions {
  int max_iterations = 10'000;
  double confidence = 0.999;
  std::uint64_t seed = 0;
};

// `noise_bound` is a radius [m].
PoseSummary SolveByPclRansac(const PointsRef& source,
                             const PointsRef& target,
                             double noise_bound,
                             const PclRansacOptions& options);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PEERS_PCL_RANSAC_H_
