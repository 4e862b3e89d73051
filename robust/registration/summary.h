// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The report of a registration: the pose, the verdict, and the result of each
// stage.

#ifndef QUATRO_ROBUST_REGISTRATION_SUMMARY_H_
#define QUATRO_ROBUST_REGISTRATION_SUMMARY_H_

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "features/base/rigid3.h"
#include "features/base/stopwatch.h"
#include "features/base/types.h"
#include "robust/estimators/pose_summary.h"
#include "robust/registration/pose_search.h"
#include "robust/registration/refinement.h"
#include "robust/verdict/error_radius.h"
#include "robust/verdict/surface_observability.h"
#include "robust/verdict/verdict.h"

namespace quatro {

// Everything is in the frames of the clouds as they were given.
struct RegistrationSummary {
  // Why there is no result: an option is out of range, or a cloud has no points
  // or is too wide. Empty otherwise.
  std::string error;

  Verdict verdict;

  // The matches, column by column: voxel means for clouds.
  Points matched_source;  // [m]
  Points matched_target;  // [m]

  // Only for clouds.
  Eigen::Index num_source_voxels = 0;
  Eigen::Index num_target_voxels = 0;
  Eigen::Index num_mutual_matches = 0;  // Before the tuple test.

  // The final pose, refined if a refinement was accepted. With clouds, its
  // covariance is from the surfaces in contact under this pose
  // (robust/verdict/contact_covariance.h), otherwise from the inliers.
  PoseSummary solution;
  std::optional<RefinementSummary> refinement;  // If it was tried.

  // Which directions the surfaces constrain. Directions that they do not
  // constrain are also in solution.covariance.
  std::optional<SurfaceObservability> surface_observability;

  // Errors that the pose keeps within, 19 times in 20. Only for clouds, and if
  // there is a covariance.
  std::optional<ErrorRadius> error_radius;

  // The rung that found the pose (robust/registration/ladder.h); 0 is the
  // estimator alone.
  int rung = 0;

  // The lengths of the options were multiplied by this factor
  // (PoseSearchOptions::scale_factors).
  double scale_factor = 1.0;

  // The source of the level frames: "given", or "matches" or "normals" of the
  // scans (robust/registration/gravity.h).
  std::string leveled_by = "given";

  // The candidates of all rungs that were tried, the best of each rung first.
  std::vector<PoseCandidate> candidates;

  std::vector<StageTime> stage_times;
  double total_seconds = 0.0;

  // Set iff there is a pose. The verdict says whether it can be trusted.
  const std::optional<Rigid3>& target_from_source() const {
    return solution.target_from_source;
  }
};

}  // namespace quatro

#endif  // QUATRO_ROBUST_REGISTRATION_SUMMARY_H_
