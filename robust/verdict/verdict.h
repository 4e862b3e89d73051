// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The verdict: whether a pose can be trusted.
//
//   number of inliers          compared with what the estimator needs
//   probability by chance      robust/verdict/false_alarms.h
//   rival by matches           robust/verdict/match_rival.h
//   evidence from the clouds   robust/verdict/evidence.h
//                |
//                v
//   probability of a correct pose   robust/verdict/success_model.h
//                |
//                v
//   registered, ambiguous, degenerate or insufficient, and the reason
//
// A pose is correct if it is within 20/3 noise bounds and 10 deg of the true
// pose. With the noise bound of preset kitti, these are 2 m and 10 deg, the
// paper's criterion.

#ifndef QUATRO_ROBUST_VERDICT_VERDICT_H_
#define QUATRO_ROBUST_VERDICT_VERDICT_H_

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "features/base/rigid3.h"
#include "features/base/types.h"
#include "robust/estimators/pose_summary.h"
#include "robust/verdict/evidence.h"
#include "robust/verdict/false_alarms.h"
#include "robust/verdict/match_rival.h"
#include "robust/verdict/success_model.h"

namespace quatro {

// The outcome of a registration.
enum class Status {
  kRegistered,    // The pose is probably correct.
  kAmbiguous,     // There is a pose, but it may be incorrect.
  kDegenerate,    // The consistent matches do not constrain the pose.
  kInsufficient,  // There are too few consistent matches.
};

// "registered", "ambiguous", "degenerate" or "insufficient".
const char* StatusName(Status status);

// When a pose is registered.
struct VerdictOptions {
  // The least probability of a correct pose.
  double min_probability = 0.8;

  MatchRivalOptions rival;  // Register() replaces seed, threads and bounds.

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// A pose is correct if it is within both of the true pose.
struct SuccessTolerance {
  double translation = 0.0;  // [m]
  double rotation = 0.0;     // [rad]
};

// 20/3 times `noise_bound` [m], and 10 deg.
SuccessTolerance ToleranceOf(double noise_bound);

// The status and the evidence for it.
struct Verdict {
  Status status = Status::kInsufficient;
  std::string reason = "no registration was tried";

  // The probability that the pose is within the tolerance; 0 without a pose.
  double probability = 0.0;
  SuccessTolerance tolerance;

  // The features that the probability was computed from.
  std::vector<Feature> features;

  Eigen::Index num_matches = 0;           // Duplicates count once.
  Eigen::Index num_inliers = 0;           // Matches within the noise bound.
  std::vector<FalseAlarms> false_alarms;  // By stage; the last is the pose's.
  std::optional<MatchRival> rival;
  std::optional<GeometricEvidence> geometry;

  // Whether the pose is registered.
  bool IsRegistered() const { return status == Status::kRegistered; }
};

// Judges the summary of an estimator for these matches, with or without a pose.
// `noise_bound` is in [m]. Without geometry, only the matches decide.
Verdict Judge(const PointsRef& source,
              const PointsRef& target,
              const PoseSummary& summary,
              double noise_bound,
              const std::optional<GeometricEvidence>& geometry,
              const VerdictOptions& options);

}  // namespace quatro

#endif  // QUATRO_ROBUST_VERDICT_VERDICT_H_
