// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Open3D's estimators on the same matched points, for comparison and as test
// oracles. Built only with -DQUATRO_WITH_OPEN3D=ON.
//
// Open3D returns the identity if it fails. Here a pose with fewer than three
// inliers is no answer. Its RANSAC uses one random generator per process and
// chooses its own number of threads, so on several cores the result varies from
// run to run even with a seed.

#ifndef QUATRO_EXPERIMENTS_PEERS_OPEN3D_H_
#define QUATRO_EXPERIMENTS_PEERS_OPEN3D_H_

#include <cstdint>

#include "features/base/types.h"
#include "robust/estimators/pose_summary.h"

namespace quatro {

struct Open3dFgrOptions {
  // If false, the distance is the noise bound [m]. If true, Open3D's default,
  // it is `distance` times the extent of the clouds.
  bool relative_distance = false;
  double distance = 0.025;
  int num_iterations = 64;
  bool tuple_test = true;  // Open3D's own, in addition to ours.
  std::uint64_t seed = 0;  // For the tuple test.
};

// `noise_bound` is a radius [m].
PoseSummary SolveByOpen3dFgr(const PointsRef& source,
                             const PointsRef& target,
                             double noise_bound,
                             const Open3dFgrOptions& options);

struct Open3dRansacOptions {
  int max_iterations = 10'000;
  double confidence = 0.999;
  double edge_similarity = 0.9;  // 0: no test of edge lengths.
  std::uint64_t seed = 0;
};

PoseSummary SolveByOpen3dRansac(const PointsRef& source,
                                const PointsRef& target,
                                double noise_bound,
                                const Open3dRansacOptions& options);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PEERS_OPEN3D_H_
