// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// All options of a registration, from clouds or matched points to a verdict.
//
// Seed, threads, noise bound and the vertical are set once, here. Parts that
// can be called by themselves have fields with the same names. In a
// registration these must have their default values or the values here;
// IsValid() rejects others.

#ifndef QUATRO_ROBUST_REGISTRATION_OPTIONS_H_
#define QUATRO_ROBUST_REGISTRATION_OPTIONS_H_

#include <cstdint>
#include <functional>
#include <string>

#include "features/base/stopwatch.h"
#include "robust/estimators/arc_consensus.h"
#include "robust/estimators/consensus_pose.h"
#include "robust/estimators/fgr.h"
#include "robust/estimators/pose_bounds.h"
#include "robust/estimators/pose_summary.h"
#include "robust/estimators/quatro.h"
#include "robust/estimators/ransac.h"
#include "robust/estimators/teaser.h"
#include "robust/registration/front_end.h"
#include "robust/registration/ins.h"
#include "robust/registration/pose_search.h"
#include "robust/registration/refinement.h"
#include "robust/verdict/evidence.h"
#include "robust/verdict/surface_observability.h"
#include "robust/verdict/verdict.h"
#include "solvers/ceres/pose_covariance.h"

namespace quatro {

// The defaults are those of preset kitti.
struct RegistrationOptions {
  FrontEndOptions front_end;

  // The estimator, by its name in the registry
  // (robust/registration/methods.h), and the options of each.
  std::string method = "quatro";
  QuatroOptions quatro;
  ArcConsensusOptions arc_consensus;
  ConsensusPoseOptions consensus;
  TeaserOptions teaser;
  FgrOptions fgr;
  RansacOptions ransac;

  // A custom estimator that replaces `method`. It gets the matches with z up.
  PoseSolver solver;

  // The largest residual of an inlier [m]: on each axis or as a distance,
  // depending on the estimator.
  double noise_bound = 0.3;

  // A prior on the pose; unbounded by default.
  PoseBounds bounds;

  // Roll and pitch from an INS, and which way is up.
  InsOptions ins;

  // The search for other poses if the estimator's pose is not registered. It
  // needs two clouds and a method that searches
  // (robust/registration/methods.h).
  PoseSearchOptions search;

  CovarianceOptions covariance;
  SurfaceObservabilityOptions surface_observability;
  EvidenceOptions evidence;
  VerdictOptions verdict;

  // Local registration of the voxel means from the estimated pose. None by
  // default.
  RefinementOptions refinement;

  int num_threads = 1;  // 0: all cores. Never changes the answer.
  std::uint64_t seed = 0;

  // Called when a stage ends, with its name and duration, by the thread that
  // called. An exception that it throws ends the registration.
  std::function<void(const StageTime&)> progress;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// Returns the options with all lengths of the front end, the noise bound, the
// covariance and the refinement multiplied by `factor` > 0. The bounds on the
// pose are not scaled.
RegistrationOptions ScaledBy(double factor, RegistrationOptions options);

// Returns the options with seed, threads and noise bound set in every part.
RegistrationOptions WithSharedValues(RegistrationOptions options);

}  // namespace quatro

#endif  // QUATRO_ROBUST_REGISTRATION_OPTIONS_H_
