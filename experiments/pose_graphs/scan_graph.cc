// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/pose_graphs/scan_graph.h"

#include <glog/logging.h>

#include <utility>

namespace quatro {

std::vector<ScanPair> RegisterPairs(
    const std::vector<PointCloud>& scans,
    const RegistrationOptions& options,
    const std::function<void(int, int)>& progress) {
  const int n = static_cast<int>(scans.size());
  const int num_pairs = (n - 1) * (n - 2) / 2;
  std::vector<ScanPair> pairs;
  for (std::size_t from = 0; from < scans.size(); ++from) {
    for (std::size_t to = from + 2; to < scans.size(); ++to) {
      const RegistrationSummary summary =
          Register(scans[to], scans[from], options);
      pairs.push_back(
          {from, to, summary.verdict, summary.target_from_source()});
      progress(static_cast<int>(pairs.size()), num_pairs);
    }
  }
  return pairs;
}

Eigen::MatrixXd DiagonalInformation(double translation_sigma,
                                    double rotation_sigma) {
  Eigen::VectorXd sigmas(6);
  sigmas.head<3>().setConstant(translation_sigma);
  sigmas.tail<3>().setConstant(rotation_sigma);
  return sigmas.array().square().inverse().matrix().asDiagonal();
}

void AddLoops(const std::vector<ScanPair>& pairs,
              const Eigen::MatrixXd& information,
              PoseGraph* graph) {
  CHECK_EQ(graph->dimension, 3);
  for (const ScanPair& pair : pairs) {
    CHECK_LT(pair.to, graph->world_from_pose.size());
    if (!pair.from_from_to) continue;
    PoseEdge edge;
    edge.from = pair.from;
    edge.to = pair.to;
    edge.from_from_to = *pair.from_from_to;
    edge.information = information;
    graph->edges.push_back(std::move(edge));
  }
}

}  // namespace quatro
