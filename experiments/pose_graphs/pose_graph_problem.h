// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A pose graph as a ceres::Problem: a residual block an edge, whitened,
//
//   r = U (R_i^T (t_j - t_i) - t_ij,  log(R_ij^T R_i^T R_j)),
//   U^T U = information, so that |r|^2 = e^T information e,                 (1)
//
// in space with the logarithm as 2 vec(q), as Ceres' own example has it. A pose
// is two parameter blocks, a rotation on its manifold (the unit circle in the
// plane, unit quaternions in space) and a translation. Where the graph fixes no
// pose the first one is.

#ifndef QUATRO_EXPERIMENTS_POSE_GRAPHS_POSE_GRAPH_PROBLEM_H_
#define QUATRO_EXPERIMENTS_POSE_GRAPHS_POSE_GRAPH_PROBLEM_H_

#include <ceres/ceres.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "experiments/pose_graphs/pose_graph.h"
#include "robust/gnc/ceres_gnc.h"

namespace quatro {

// What is done about loops that may be wrong. kGnc and the losses of Ceres have
// the same bound, by chi-square.
enum class LoopLoss { kGnc, kNone, kHuber, kCauchy, kTukey };

// none, gnc, huber, cauchy or tukey.
std::optional<LoopLoss> ParseLoopLoss(const std::string& name);

struct PoseGraphOptions {
  LoopLoss loss = LoopLoss::kGnc;

  // The share of right loops that the bound lets by. Near one, as losing a
  // right loop costs more than the doubtful wrong one that gets in.
  double inlier_probability = 0.999999;

  GncOptions gnc;
  ceres::Solver::Options solver;

  PoseGraphOptions();
};

struct PoseGraphSummary {
  bool is_usable = false;
  std::string report;  // One line.
  // By edge: GNC's, or the slope of the loss at the answer; 1 where nothing is
  // weighted. An edge at 0 does not hold the answer.
  std::vector<double> weights;
  CeresGncSummary gnc;  // Of LoopLoss::kGnc.
  double seconds = 0.0;
};

class PoseGraphProblem {
 public:
  // `graph` must outlive this.
  PoseGraphProblem(const PoseGraph& graph, const PoseGraphOptions& options);

  ceres::Problem& problem() { return problem_; }
  // Of each edge.
  const std::vector<ceres::ResidualBlockId>& ids() const { return ids_; }

  std::vector<Rigid3> WorldFromPose() const;

 private:
  const PoseGraph& graph_;
  std::vector<std::array<double, 4>> rotations_;  // The circle has two.
  std::vector<std::array<double, 3>> translations_;
  std::vector<ceres::ResidualBlockId> ids_;
  ceres::Problem problem_;
};

// From the graph's poses; they become the answer unless it is not usable.
// Odometry is taken as right.
PoseGraphSummary SolvePoseGraph(const PoseGraphOptions& options,
                                PoseGraph* graph);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_POSE_GRAPHS_POSE_GRAPH_PROBLEM_H_
