// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Robustness of pose graphs to outlier loops: GNC and the robust losses of
// Ceres, all from the same start, on the worlds of
// experiments/pose_graphs/pose_graph_worlds.h.

#ifndef QUATRO_EXPERIMENTS_POSE_GRAPHS_POSE_GRAPH_PROTOCOL_H_
#define QUATRO_EXPERIMENTS_POSE_GRAPHS_POSE_GRAPH_PROTOCOL_H_

#include <vector>

#include "experiments/pose_graphs/pose_graph_problem.h"
#include "experiments/pose_graphs/pose_graph_worlds.h"
#include "experiments/protocols/synthetic_protocols.h"

namespace quatro {

// The largest distance between the positions of two solutions [m] and the
// largest angle between their rotations [rad].
struct PoseDifference {
  double translation = 0.0;
  double rotation = 0.0;
};
PoseDifference LargestDifference(const std::vector<Rigid3>& a,
                                 const std::vector<Rigid3>& b);

// Runs both worlds, outlier shares of 10 to 90 %, and every loss. A run is
// correct if no pose is more than 0.1 m from the least-squares solution without
// outliers, and equal if no pose differs by more than 1e-6 m and rad. Sizes and
// noise come from `world`, seeds start at 0.
Table RunWrongLoopProtocol(int num_seeds,
                           const GraphWorldOptions& world,
                           const PoseGraphOptions& options,
                           const Progress& progress);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_POSE_GRAPHS_POSE_GRAPH_PROTOCOL_H_
