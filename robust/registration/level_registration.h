// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The stages after matching, with z up:
//
//   matches -> estimator -> guided matches, of a searched pose -> covariance
//           -> refinement -> geometric evidence -> verdict -> error radius

#ifndef QUATRO_ROBUST_REGISTRATION_LEVEL_REGISTRATION_H_
#define QUATRO_ROBUST_REGISTRATION_LEVEL_REGISTRATION_H_

#include <optional>

#include "features/base/types.h"
#include "features/described_cloud.h"
#include "robust/estimators/pose_bounds.h"
#include "robust/estimators/pose_summary.h"
#include "robust/registration/options.h"
#include "robust/registration/summary.h"
#include "robust/verdict/evidence.h"

namespace quatro {

// The input of RegisterLevel() besides the matches. It refers to objects that
// must outlive the call.
struct LevelProblem {
  const DescribedCloud* source;  // Null without clouds.
  const DescribedCloud* target;
  const PoseBounds& bounds;
  const RegistrationOptions& options;  // With shared values.
  const PoseSolver& solver;

  // Set for a pose that was searched for: the clouds, which must have
  // descriptors, are matched again near it (features/guided_matching.h), for
  // the covariance and the verdict.
  std::optional<SearchEvidence> search;
};

// Adds pose, verdict and stage times to the summary. Column i of
// `matched_source` is matched with column i of `matched_target` [m].
void RegisterLevel(const PointsRef& matched_source,
                   const PointsRef& matched_target,
                   const LevelProblem& problem,
                   RegistrationSummary* summary);

}  // namespace quatro

#endif  // QUATRO_ROBUST_REGISTRATION_LEVEL_REGISTRATION_H_
