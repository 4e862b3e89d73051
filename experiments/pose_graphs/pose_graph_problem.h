// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A pose graph as a ceres::Problem, with one whitened residual block per edge,
//
//   r = U (R_i^T (t_j - t_i) - t_ij,  log(R_ij^T R_i^T R_j)),
//   U^T U = information, so that |r|^2 = e^T information e,                 (1)
//
// and one residual for each direction that the edge measures (information.h).
// In space the logarithm is 2 vec(q), as in the example of Ceres. A pose has
// two parameter blocks: a rotation on its manifold (the unit circle in the
// plane, unit quaternions in space) and a translation. If the graph fixes no
// pose, the first one is fixed.

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

// The treatment of loops that may be outliers. kGnc and the losses of Ceres use
// the same bound, by chi-square.
enum class LoopLoss { kGnc, kNone, kHuber, kCauchy, kTukey };

// Parses none, gnc, huber, cauchy or tukey.
std::optional<LoopLoss> ParseLoopLoss(const std::string& name);

struct PoseGraphOptions {
  LoopLoss loss = LoopLoss::kGnc;

  // The probability that an inlier loop is within the bound. It is close to
  // one, because losing an inlier loop costs more than accepting a borderline
  // outlier.
  double inlier_probability = 0.999999;

  GncOptions gnc;
  ceres::Solver::Options solver;  // With kGnc, of the last solve.

  // With kGnc: the plain fit takes at most this many steps, and the inner
  // solves end at this function tolerance.
  int max_plain_fit_steps = 5;
  double inner_tolerance = 1e-3;

  PoseGraphOptions();
};

struct PoseGraphSummary {
  bool is_usable = false;  // There is a solution, and its cost is finite.
  std::string report;      // One line.
  // The weight per edge: GNC's, or the derivative of the loss at the solution;
  // 1 if nothing is weighted. An edge with weight 0 does not affect the
  // solution.
  std::vector<double> weights;
  CeresGncSummary gnc;  // For LoopLoss::kGnc only.
  double seconds = 0.0;
};

class PoseGraphProblem {
 public:
  // `graph` must outlive this.
  PoseGraphProblem(const PoseGraph& graph, const PoseGraphOptions& options);

  ceres::Problem& problem() { return problem_; }
  // The residual block of each edge.
  const std::vector<ceres::ResidualBlockId>& ids() const { return ids_; }

  std::vector<Rigid3> WorldFromPose() const;

 private:
  const PoseGraph& graph_;
  std::vector<std::array<double, 4>> rotations_;  // The circle uses two.
  std::vector<std::array<double, 3>> translations_;
  std::vector<ceres::ResidualBlockId> ids_;
  ceres::Problem problem_;
};

// Starts from the graph's poses and replaces them by the solution if it is
// usable. Odometry edges are assumed to be inliers.
PoseGraphSummary SolvePoseGraph(const PoseGraphOptions& options,
                                PoseGraph* graph);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_POSE_GRAPHS_POSE_GRAPH_PROBLEM_H_
