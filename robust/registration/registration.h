// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The two entry points: Register() for two clouds, RegisterMatches() for
// matched points. Both return a pose and a verdict.
//
//   clouds -> front end -> matches -> estimator -> covariance -> refinement
//          -> geometric evidence -> verdict
//
// Both work in level frames, with z up (robust/registration/level.h).

#ifndef QUATRO_ROBUST_REGISTRATION_REGISTRATION_H_
#define QUATRO_ROBUST_REGISTRATION_REGISTRATION_H_

#include <utility>

#include "features/io/point_cloud.h"
#include "robust/registration/front_end.h"
#include "robust/registration/matches.h"
#include "robust/registration/options.h"
#include "robust/registration/summary.h"

namespace quatro {

// Registers two clouds, with no guess of the motion between them unless
// options.bounds has one. Lengths in meters. Errors are in summary.error.
RegistrationSummary Register(const PointCloud& source,
                             const PointCloud& target,
                             const RegistrationOptions& options);

// Registers from matched points. Without clouds there is no geometric evidence
// and no refinement: the verdict rests on the matches alone.
RegistrationSummary RegisterMatches(const Matches& matches,
                                    const RegistrationOptions& options);

// Registers many sources against one target.
class Target {
 public:
  // Stores the cloud and the options.
  Target(PointCloud cloud, RegistrationOptions options)
      : cloud_(std::move(cloud)), options_(std::move(options)) {}

  // Registers one source against the target.
  RegistrationSummary Register(const PointCloud& source) const {
    return quatro::Register(source, cloud_, options_);
  }

 private:
  PointCloud cloud_;
  RegistrationOptions options_;
};

// The two halves of Register(), for running several methods on the same
// matches: the front end, and all that follows.
MatchedClouds MatchClouds(const PointCloud& source,
                          const PointCloud& target,
                          const RegistrationOptions& options);
RegistrationSummary RegisterMatched(const MatchedClouds& clouds,
                                    const RegistrationOptions& options);

}  // namespace quatro

#endif  // QUATRO_ROBUST_REGISTRATION_REGISTRATION_H_
