// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The most significant consensus as an estimator: among the poses in yaw and
// translation found by robust/estimators/consensus_search.h, the pose with the
// largest log-likelihood ratio against chance, (3) there. There is no graph, no
// pruning and no GNC. It shows the result of the votes of all matches without
// the geometry of the scans. At least three consistent matches are needed.

#ifndef QUATRO_ROBUST_ESTIMATORS_CONSENSUS_POSE_H_
#define QUATRO_ROBUST_ESTIMATORS_CONSENSUS_POSE_H_

#include <string>

#include "features/base/types.h"
#include "robust/estimators/pose_summary.h"

namespace quatro {

// The noise bound and the tilt.
struct ConsensusPoseOptions {
  // Largest horizontal error of an inlier, a radius [m].
  double noise_bound = 0.3;
  double max_tilt = 0.035;  // Between the scans [rad], in [0, pi / 4].
  int num_threads = 1;      // 0: all cores. Does not change the result.

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// Column i of `source` is matched with column i of `target` [m]; z is up. In
// the summary, `consistent` are the inliers of the search, whose heights may be
// off by the tilt, and `translation_inliers` are within the noise bound on each
// axis.
PoseSummary SolveConsensusPose(const PointsRef& source,
                               const PointsRef& target,
                               const ConsensusPoseOptions& options);

}  // namespace quatro

#endif  // QUATRO_ROBUST_ESTIMATORS_CONSENSUS_POSE_H_
