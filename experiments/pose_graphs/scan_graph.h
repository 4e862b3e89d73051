// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Many scans as one pose graph: every pair that odometry does not join is
// registered, and what comes of it, vouched for or not, is a loop that may be
// wrong. GNC (robust/gnc/ceres_gnc.h) decides which agree with each other and
// with the odometry.

#ifndef QUATRO_EXPERIMENTS_POSE_GRAPHS_SCAN_GRAPH_H_
#define QUATRO_EXPERIMENTS_POSE_GRAPHS_SCAN_GRAPH_H_

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiments/pose_graphs/pose_graph.h"
#include "features/io/point_cloud.h"
#include "robust/registration/registration.h"
#include "robust/verdict/verdict.h"

namespace quatro {

struct ScanPair {
  std::size_t from = 0;
  std::size_t to = 0;
  Verdict verdict;
  std::optional<Rigid3> from_from_to;  // Nothing if there is no answer at all.
};

// All pairs with to > from + 1, in order. `progress` is called with the pairs
// done so far and in all.
std::vector<ScanPair> RegisterPairs(
    const std::vector<PointCloud>& scans,
    const RegistrationOptions& options,
    const std::function<void(int, int)>& progress);

// Independent and the same on each axis.
Eigen::MatrixXd DiagonalInformation(double translation_sigma,  // [m]
                                    double rotation_sigma);    // [rad]

// An edge for each pair with an answer. The graph is in space and has a pose
// for each scan.
void AddLoops(const std::vector<ScanPair>& pairs,
              const Eigen::MatrixXd& information,
              PoseGraph* graph);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_POSE_GRAPHS_SCAN_GRAPH_H_
