// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// TEASER++ on matched points: the full rotation, the translation and, as an
// option, the scale,
//
//   q_i = s R p_i + t + noise,
//
// decoupled: consistent set by maximum clique, scale by adaptive voting over
// the ratios of lengths, rotation in SO(3) by graduated non-convexity on the
// differences, translation axis by axis. Needs three matches.
//
// Source: Yang, Shi and Carlone, "TEASER: Fast and Certifiable Point Cloud
// Registration", T-RO 2021. (Scale is voted on random differences, not on all
// pairs, so that memory does not grow with their number.)

#ifndef QUATRO_ROBUST_ESTIMATORS_TEASER_H_
#define QUATRO_ROBUST_ESTIMATORS_TEASER_H_

#include <Eigen/Core>
#include <cstdint>
#include <string>

#include "features/base/types.h"
#include "robust/estimators/pose_summary.h"
#include "robust/estimators/pruning.h"
#include "robust/estimators/tims.h"
#include "robust/gnc/gnc.h"
#include "solvers/closed_form/rotation.h"

namespace quatro {

// The noise, the clique, the loop, and whether there is a scale.
struct TeaserOptions {
  double noise_bound = 0.3;  // How far a right match may be off [m].

  Pruning pruning = Pruning::kExactClique;
  double clique_time_limit_seconds = 1.0;

  TimLayout tim_layout = TimLayout::kRing;
  GncOptions gnc;

  bool estimate_scale = false;
  Eigen::Index num_scale_tims = 200'000;

  // Solve every weighted subproblem by Ceres too and report the largest
  // difference. Slow.
  bool crosscheck = false;

  std::uint64_t seed = 0;
  int num_threads = 1;  // 0: all cores. Never changes the answer.

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// The pose, and how its rotation was found.
struct TeaserSummary : PoseSummary {
  GncSummary<RotationEstimate> gnc;
};

// Column i of `source` is matched with column i of `target` [m]. With
// estimate_scale the pose maps s p_i.
TeaserSummary SolveTeaser(const PointsRef& source,
                          const PointsRef& target,
                          const TeaserOptions& options);

}  // namespace quatro

#endif  // QUATRO_ROBUST_ESTIMATORS_TEASER_H_
