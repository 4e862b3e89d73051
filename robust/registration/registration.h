// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The front door: two point clouds in, a pose and how it came about out.
//
//   clouds -> front end (robust/registration/front_end.h) -> Quatro ->
//   refinement
//          -> verdict

#ifndef QUATRO_ROBUST_REGISTRATION_REGISTRATION_H_
#define QUATRO_ROBUST_REGISTRATION_REGISTRATION_H_

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "features/base/rigid3.h"
#include "features/base/stopwatch.h"
#include "features/base/types.h"
#include "features/io/point_cloud.h"
#include "robust/estimators/pose_summary.h"
#include "robust/estimators/quatro.h"
#include "robust/registration/front_end.h"
#include "robust/registration/ins.h"
#include "robust/registration/refinement.h"
#include "robust/verdict/surface_observability.h"
#include "robust/verdict/verdict.h"
#include "solvers/ceres/pose_covariance.h"

namespace quatro {

// All options of the way from clouds to a verdict.
struct RegistrationOptions {
  FrontEndOptions front_end;
  QuatroOptions quatro;

  // Another estimator from matched points in place of Quatro.
  PoseSolver solver;

  // Roll and pitch from an INS, and what is up. Whatever solves is given the
  // matches in the level frames, `solver` too; a solver that knows an INS of
  // its own needs none here. Its fusion takes quatro.noise_bound.
  InsOptions ins;

  VerdictOptions verdict;

  // Of these, what the estimator and the voxels decide is replaced.
  PoseCovarianceOptions covariance;
  SurfaceObservabilityOptions surface_observability;

  // On the voxel means and their normals. None by default.
  RefinementOptions refinement;

  // For all parts: those of front_end.tuple, quatro and refinement are replaced
  // by these.
  int num_threads = 1;  // 0: all cores. Never changes the answer.
  std::uint64_t seed = 0;

  // Called when a stage ends, with its name and duration.
  std::function<void(const StageTime&)> progress;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// The pose, the verdict, and what each stage made of the clouds.
struct RegistrationSummary {
  // Why nothing was tried: an option out of range, a cloud without points or
  // too wide. Empty otherwise.
  std::string error;

  Verdict verdict;

  // What was matched: voxel means in their own frames, column by column.
  Points matched_source;  // [m]
  Points matched_target;  // [m]
  Eigen::Index num_source_voxels = 0;
  Eigen::Index num_target_voxels = 0;
  Eigen::Index num_mutual_matches = 0;  // Before the tuple test.

  PoseSummary solution;  // The pose refined, the covariance of that before.
  std::optional<RefinementSummary> refinement;  // If asked for and tried.

  // What the surfaces hold; the directions that they do not are among
  // solution.covariance's, too.
  std::optional<SurfaceObservability> surface_observability;
  std::vector<StageTime> stage_times;
  double total_seconds = 0.0;

  // Set iff there is an answer; whether it can be relied on says the verdict.
  const std::optional<Rigid3>& target_from_source() const {
    return solution.target_from_source;
  }
};

// Registers two clouds, with no guess of the motion between them.
RegistrationSummary Register(const PointCloud& source,
                             const PointCloud& target,
                             const RegistrationOptions& options);

// Its two halves, for those who try several estimators on the same matches. The
// first takes front_end, ins, num_threads and seed of the options; another ins
// in the second gives what Register() would for scans, which hold their sensor.
MatchedClouds MatchClouds(const PointCloud& source,
                          const PointCloud& target,
                          const RegistrationOptions& options);
RegistrationSummary RegisterMatched(const MatchedClouds& clouds,
                                    const RegistrationOptions& options);

}  // namespace quatro

#endif  // QUATRO_ROBUST_REGISTRATION_REGISTRATION_H_
