// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Poses and relative measurements between them, in the plane or in space.
//
// An edge is a measurement of the pose `to` in the frame of the pose `from`,
//
//   from_from_to = world_from_pose[from]^-1 world_from_pose[to] + noise,    (1)
//
// where the noise has covariance information^-1 over (x, y, yaw) or (x, y, z,
// rotation vector) [m, rad]; it is unbounded in the null space of the
// information. In the plane, all rotations are about z and all z
// are 0.

#ifndef QUATRO_EXPERIMENTS_POSE_GRAPHS_POSE_GRAPH_H_
#define QUATRO_EXPERIMENTS_POSE_GRAPHS_POSE_GRAPH_H_

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "features/base/rigid3.h"

namespace quatro {

// Limits of the noise, so that the information can be computed and written.
inline constexpr double kMinSigma = 1e-6;      // [m] and [deg]
inline constexpr double kMaxSigmaM = 1e6;      // [m]
inline constexpr double kMaxSigmaDeg = 180.0;  // [deg]

struct PoseEdge {
  std::size_t from = 0;  // Index of a pose.
  std::size_t to = 0;
  Rigid3 from_from_to;
  Eigen::MatrixXd information;  // 3 x 3 or 6 x 6; see information.h.

  // Edges between consecutive poses, in either direction, are odometry; all
  // others are loop closures.
  bool IsOdometry() const { return to == from + 1 || from == to + 1; }
};

struct PoseGraph {
  int dimension = 3;              // 2 or 3.
  std::vector<std::int64_t> ids;  // Pose ids; ReadG2o() sorts them.
  std::vector<Rigid3> world_from_pose;
  std::vector<PoseEdge> edges;
  std::vector<std::size_t> fixed;  // Poses that are kept constant.
};

// Computes the poses from the odometry alone, starting at the first pose. Poses
// that no odometry reaches stay as they are.
inline void ChainOdometry(PoseGraph* graph) {
  std::vector<const PoseEdge*> last(graph->world_from_pose.size(), nullptr);
  for (const PoseEdge& edge : graph->edges) {
    if (edge.IsOdometry()) last[std::max(edge.from, edge.to)] = &edge;
  }
  for (std::size_t i = 1; i < last.size(); ++i) {
    if (last[i] == nullptr) continue;
    graph->world_from_pose[i] =
        graph->world_from_pose[i - 1] * (last[i]->to == i
                                             ? last[i]->from_from_to
                                             : Inverse(last[i]->from_from_to));
  }
}

// The first pose of each connected component, over the edges with nonzero
// weight. All fixed poses belong to one component, because the world connects
// them.
inline std::vector<std::size_t> FirstOfParts(
    const PoseGraph& graph, const std::vector<double>& weights) {
  std::vector<std::size_t> parents(graph.world_from_pose.size());
  std::iota(parents.begin(), parents.end(), std::size_t{0});
  const auto find_first = [&](std::size_t i) {
    while (parents[i] != i) i = parents[i] = parents[parents[i]];
    return i;
  };
  const auto join = [&](std::size_t i, std::size_t j) {
    i = find_first(i);
    j = find_first(j);
    parents[std::max(i, j)] = std::min(i, j);
  };
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    if (weights[i] > 0.0) join(graph.edges[i].from, graph.edges[i].to);
  }
  for (const std::size_t i : graph.fixed) join(graph.fixed.front(), i);
  std::vector<std::size_t> first;
  for (std::size_t i = 0; i < parents.size(); ++i) {
    if (parents[i] == i) first.push_back(i);
  }
  return first;
}

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_POSE_GRAPHS_POSE_GRAPH_H_
