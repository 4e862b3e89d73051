// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// PCL's RANSAC on the same matched points, to compare with. Built with
// -DQUATRO_WITH_PCL=ON alone. PCL has no FGR.
//
// Samples of three points, refused if two are closer than the cloud's mean
// standard deviation; the count of inliers decides; the pose is of least
// squares over the inliers of the best sample, once.

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

// `noise_bound` [m].
PoseSummary SolveByPclRansac(const PointsRef& source,
                             const PointsRef& target,
                             double noise_bound,
                             const PclRansacOptions& options);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PEERS_PCL_RANSAC_H_
