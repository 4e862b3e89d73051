// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Combines many scans into one pose graph. Every pair of scans that odometry
// does not join goes through Register(). Its pose, whatever its status, becomes
// a loop that may be an outlier. GNC (robust/gnc/ceres_gnc.h) decides which
// loops are consistent with each other and with the odometry.

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
  std::optional<Rigid3> from_from_to;  // Not set if there is no pose.
};

// Registers all pairs with to > from + 1, in order. `progress` is called with
// the number of pairs done and the total.
std::vector<ScanPair> RegisterPairs(
    const std::vector<PointCloud>& scans,
    const RegistrationOptions& options,
    const std::function<void(int, int)>& progress);

// The information of independent noise with equal variance on each axis.
Eigen::MatrixXd DiagonalInformation(double translation_sigma,  // [m]
                                    double rotation_sigma);    // [rad]

// Adds an edge for each pair with a pose. The graph must be in space and have a
// pose for each scan.
void AddLoops(const std::vector<ScanPair>& pairs,
              const Eigen::MatrixXd& information,
              PoseGraph* graph);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_POSE_GRAPHS_SCAN_GRAPH_H_
