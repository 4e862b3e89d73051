// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Quatro: the motion of a vehicle on the ground from matched points, most of
// them wrong,
//
//   q_i = R_z(yaw) p_i + t + noise,                                        (1)
//
// in four stages, each with an answer of its own:
//
//   matches -> largest consistent set (robust/graph/max_clique.h)
//           -> differences of points (robust/estimators/tims.h)
//           -> yaw by graduated non-convexity (robust/gnc/gnc.h)
//           -> translation axis by axis (solvers/closed_form/translation.h)
//
// and, as options, three that the paper does not have: the exact yaw beside the
// graduated one (solvers/closed_form/exact_yaw.h), the translation once more
// over all matches (robust/estimators/recovery.h), and the pose in SE(3) on the
// inliers (robust/estimators/polish.h).
//
// One difference, hence two consistent matches, is enough for a yaw. Roll and
// pitch are zero unless the polish finds them.
//
// The answer depends on the set of matches: neither on their order nor on how
// often one is repeated, bit for bit.
//
// Source: Lim et al., "A Single Correspondence Is Enough: Robust Global
// Registration to Avoid Degeneracy in Urban Environments", ICRA 2022.

#ifndef QUATRO_ROBUST_ESTIMATORS_QUATRO_H_
#define QUATRO_ROBUST_ESTIMATORS_QUATRO_H_

#include <Eigen/Core>
#include <cstdint>
#include <string>

#include "features/base/types.h"
#include "robust/estimators/polish.h"
#include "robust/estimators/pose_summary.h"
#include "robust/estimators/pruning.h"
#include "robust/estimators/tims.h"
#include "robust/gnc/gnc.h"
#include "robust/gnc/surrogate.h"
#include "robust/graph/consistency_graph.h"
#include "solvers/closed_form/yaw.h"

namespace quatro {

// Which yaw is taken.
enum class YawSolver {
  kGnc,    // Graduated non-convexity, the paper's.
  kExact,  // The global optimum of the truncated problem.
};

// Every choice of the four stages; the defaults are those of preset kitti.
struct QuatroOptions {
  // How far a right match may be off [m].
  double noise_bound = 0.3;

  // A difference of two matches has the noise of both; its bound is this times
  // noise_bound. 1 in the paper.
  double tim_bound_factor = 2.0;

  // Its bound is 2 * noise_bound.
  ConsistencyTest consistency_test = ConsistencyTest::kLength;
  double max_tilt = 0.035;  // [rad], for ConsistencyTest::kPlanarAndHeight.

  Pruning pruning = Pruning::kCliqueHeuristic;
  double clique_time_limit_seconds = 1.0;  // For Pruning::kExactClique.

  TimLayout tim_layout = TimLayout::kRing;
  Eigen::Index num_random_tims = 5000;  // For TimLayout::kRandom.

  YawSolver yaw_solver = YawSolver::kGnc;
  SurrogateType surrogate = SurrogateType::kTruncatedLeastSquares;
  GncOptions gnc;

  // Take the exact yaw where the graduated one costs more than the optimum by
  // this; the certificate tells in any case.
  bool replace_missed_optimum = true;
  double certificate_tolerance = 1e-6;

  bool recover_translation = true;

  bool polish = true;
  double polish_max_tilt = 0.3;           // [rad]
  double polish_max_rotation_std = 0.01;  // [rad]

  // Solve every weighted subproblem by Ceres too and report the largest
  // difference. Slow.
  bool crosscheck = false;

  std::uint64_t seed = 0;
  int num_threads = 1;  // 0: all cores. Never changes the answer.

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// The pose, and the yaw it came from.
struct QuatroSummary : PoseSummary {
  // Of the yaw; not run for YawSolver::kExact.
  GncSummary<YawEstimate> gnc;

  double yaw = 0.0;           // Before the polish [rad].
  bool is_yaw_exact = false;  // Taken from the sweep, not from gnc.
};

// Column i of `source` is matched with column i of `target` [m].
QuatroSummary SolveQuatro(const PointsRef& source,
                          const PointsRef& target,
                          const QuatroOptions& options);

}  // namespace quatro

#endif  // QUATRO_ROBUST_ESTIMATORS_QUATRO_H_
