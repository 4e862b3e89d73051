// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// TEASER++ on matched points: the full rotation, the translation and optionally
// the scale,
//
//   q_i = s R p_i + t + noise,
//
// estimated one after the other: the scale, if it is not known, by adaptive
// voting on ratios of lengths, the consistent set by a maximum clique, the
// rotation in SO(3) by graduated non-convexity on the differences, and the
// translation axis by axis. Needs three consistent matches that are not on a
// line.
//
// Source: Yang, Shi and Carlone, "TEASER: Fast and Certifiable Point Cloud
// Registration", T-RO 2021. The scale is voted on num_scale_tims random
// differences if there are more pairs, so that memory does not grow with their
// number.

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

// The noise bound, the consistent set, GNC, and the scale.
struct TeaserOptions {
  // Largest error of an inlier on each axis of the target frame (half the edge
  // of a box) [m]. TIMs use twice this bound as a radius.
  double noise_bound = 0.3;

  Pruning pruning = Pruning::kExactClique;
  double clique_time_limit_seconds = 1.0;  // For Pruning::kExactClique [s].

  TimLayout tim_layout = TimLayout::kRing;
  GncOptions gnc;

  bool estimate_scale = false;
  Eigen::Index num_scale_tims = 200'000;  // The largest number of differences.

  // Also solve every weighted subproblem by Ceres and report the largest
  // difference. This is slow.
  bool crosscheck = false;

  std::uint64_t seed = 0;
  int num_threads = 1;  // 0: all cores. Does not change the result.

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// The pose, and the GNC summary of its rotation.
struct TeaserSummary : PoseSummary {
  GncSummary<RotationEstimate> gnc;
};

// Column i of `source` is matched with column i of `target` [m]. With
// estimate_scale, the pose maps the scaled points s p_i.
TeaserSummary SolveTeaser(const PointsRef& source,
                          const PointsRef& target,
                          const TeaserOptions& options);

}  // namespace quatro

#endif  // QUATRO_ROBUST_ESTIMATORS_TEASER_H_
