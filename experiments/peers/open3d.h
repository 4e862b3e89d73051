// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Open3D's estimators on the same matched points, to compare with and as
// oracles of tests. Built with -DQUATRO_WITH_OPEN3D=ON alone.
//
// Open3D answers a failure with the identity: here fewer than three matches
// within the noise bound of its pose are no answer. Its RANSAC draws from one
// generator of the whole process, in threads of its own number: seeded, and
// still not the same from run to run on several cores.

#ifndef QUATRO_EXPERIMENTS_PEERS_OPEN3D_H_
#define QUATRO_EXPERIMENTS_PEERS_OPEN3D_H_

#include <cstdint>

#include "features/base/types.h"
#include "robust/estimators/pose_summary.h"

namespace quatro {

struct Open3dFgrOptions {
  // False takes the noise bound for the distance [m]; true, Open3D's default,
  // `distance` times the extent of the clouds.
  bool relative_distance = false;
  double distance = 0.025;
  int num_iterations = 64;
  bool tuple_test = true;  // Of its own, once more.
  std::uint64_t seed = 0;  // Of the tuple test.
};

// `noise_bound` [m].
PoseSummary SolveByOpen3dFgr(const PointsRef& source,
                             const PointsRef& target,
                             double noise_bound,
                             const Open3dFgrOptions& options);

struct Open3dRansacOptions {
  int max_iterations = 10'000;
  double confidence = 0.999;
  double edge_similarity = 0.9;  // 0: without the test of edge lengths.
  std::uint64_t seed = 0;
};

PoseSummary SolveByOpen3dRansac(const PointsRef& source,
                                const PointsRef& target,
                                double noise_bound,
                                const Open3dRansacOptions& options);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PEERS_OPEN3D_H_
