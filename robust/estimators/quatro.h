// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Quatro: the motion of a vehicle on the ground from matched points, most of
// them outliers,
//
//   q_i = R_z(yaw) p_i + t + noise,                                        (1)
//
// in four stages:
//
//   matches -> a large consistent set (robust/graph/max_clique.h)
//           -> differences of points (robust/estimators/tims.h)
//           -> yaw by graduated non-convexity (robust/gnc/gnc.h)
//           -> translation axis by axis (solvers/closed_form/translation.h)
//
// and three optional stages that the paper does not have: the exact yaw in
// addition to the GNC yaw (solvers/closed_form/exact_yaw.h), the translation
// estimated again from all matches (robust/estimators/recovery.h), and the pose
// refined in SE(3) on the inliers (robust/estimators/polish.h).
//
// One difference, and therefore two consistent matches, determines a yaw. There
// is no pose if fewer matches are consistent, or if they are all at one place
// or on a vertical line. Roll and pitch are zero unless the polish estimates
// them.
//
// The result depends on the set of matches but not on their order or
// repetition, bit for bit.
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
#include "robust/graph/consistency_test.h"
#include "solvers/closed_form/yaw.h"

namespace quatro {

// How the yaw is estimated.
enum class YawSolver {
  kGnc,    // Graduated non-convexity, as in the paper.
  kExact,  // The global optimum of the truncated problem.
};

// Options of all stages; the defaults are those of the preset kitti.
struct QuatroOptions {
  // Largest error of an inlier on each axis of the target frame (half the edge
  // of a box) [m]. The recovery and the polish also use it as a radius.
  double noise_bound = 0.3;

  // The bound of a TIM, a radius in the plane, is tim_bound_factor *
  // noise_bound. The default of 2 covers the noise of both matches; the paper
  // uses 1.
  double tim_bound_factor = 2.0;

  // Two matches are consistent if the lengths that the test compares differ by
  // at most 2 * noise_bound.
  ConsistencyTest consistency_test = ConsistencyTest::kLength;
  double max_tilt = 0.035;  // For ConsistencyTest::kPlanarAndHeight [rad].

  Pruning pruning = Pruning::kCliqueHeuristic;
  double clique_time_limit_seconds = 1.0;  // For Pruning::kExactClique [s].

  TimLayout tim_layout = TimLayout::kRing;
  Eigen::Index num_random_tims = 5000;  // For TimLayout::kRandom.

  YawSolver yaw_solver = YawSolver::kGnc;
  SurrogateType surrogate = SurrogateType::kTruncatedLeastSquares;
  GncOptions gnc;

  // Use the exact yaw if the cost of the GNC yaw exceeds the optimum by more
  // than certificate_tolerance. The certificate reports both costs in any case.
  bool replace_missed_optimum = true;
  double certificate_tolerance = 1e-6;

  // Estimate the translation again from all matches
  // (robust/estimators/recovery.h).
  bool recover_translation = true;

  // Refine the pose in SE(3) on its inliers (robust/estimators/polish.h). The
  // refined pose is rejected if its rotation differs from the yaw-only one by
  // more than polish_max_tilt, or if the standard deviation about its least
  // certain axis exceeds polish_max_rotation_std.
  bool polish = true;
  double polish_max_tilt = 0.3;           // [rad]
  double polish_max_rotation_std = 0.01;  // [rad]

  // Also solve every weighted subproblem by Ceres and report the largest
  // difference. This is slow.
  bool crosscheck = false;

  std::uint64_t seed = 0;
  int num_threads = 1;  // 0: all cores. Does not change the result.

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// The pose, and the yaw from which it was computed.
struct QuatroSummary : PoseSummary {
  // GNC for the yaw; not run for YawSolver::kExact.
  GncSummary<YawEstimate> gnc;

  double yaw = 0.0;           // Before the polish [rad].
  bool is_yaw_exact = false;  // The yaw is the exact yaw, not that of gnc.
};

// Column i of `source` is matched with column i of `target` [m].
QuatroSummary SolveQuatro(const PointsRef& source,
                          const PointsRef& target,
                          const QuatroOptions& options);

}  // namespace quatro

#endif  // QUATRO_ROBUST_ESTIMATORS_QUATRO_H_
