// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Whether an answer can be relied on.
//
//   how many matches hold it          against what the estimator needs
//   the chance that it is accidental  robust/verdict/false_alarms.h
//   a second answer as good           robust/verdict/match_rival.h
//   the clouds, where they are known  robust/verdict/evidence.h
//                |
//                v
//   the probability that it is right  robust/verdict/success_model.h
//                |
//                v
//   registered, ambiguous, degenerate or insufficient, and why
//
// Right is within 2 m and 10 deg of the truth, the paper's measure of success.

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

// What can be said of an answer.
enum class Status {
  kRegistered,    // There is an answer, and it is right as far as can be told.
  kAmbiguous,     // There is an answer, and another could be right as well.
  kDegenerate,    // The consistent matches do not hold the pose.
  kInsufficient,  // There are too few consistent matches to try.
};

// "registered", "ambiguous", "degenerate" or "insufficient".
const char* StatusName(Status status);

// What is asked for before an answer is vouched for.
struct VerdictOptions {
  // Registered iff the probability of success is no less.
  double min_probability = 0.8;

  MatchRivalOptions rival;  // Register() replaces seed, threads and vertical.

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// What can be said of the answer, and from what.
struct Verdict {
  Status status = Status::kInsufficient;
  std::string reason = "no registration was tried";

  // That the answer is right; 0 where there is none.
  double probability = 0.0;

  // What it was computed from.
  std::vector<Feature> features;

  Eigen::Index num_matches = 0;           // Copies counted once.
  Eigen::Index num_inliers = 0;           // With the pose.
  std::vector<FalseAlarms> false_alarms;  // By stage; the last is the pose's.
  std::optional<MatchRival> rival;
  std::optional<GeometricEvidence> geometry;

  // Whether the answer is vouched for.
  bool IsRegistered() const { return status == Status::kRegistered; }
};

// The verdict on what an estimator reports from these matches, also without an
// answer; `noise_bound` [m]. No geometry: the matches alone decide.
Verdict Judge(const PointsRef& source,
              const PointsRef& target,
              const PoseSummary& summary,
              double noise_bound,
              const std::optional<GeometricEvidence>& geometry,
              const VerdictOptions& options);

}  // namespace quatro

#endif  // QUATRO_ROBUST_VERDICT_VERDICT_H_
