// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/verdict/summary_covariance.h"

#include <glog/logging.h>

#include "features/base/stopwatch.h"
#include "robust/estimators/distinct_matches.h"

namespace quatro {
namespace {

// A right match is off by the noise bound at so many standard deviations.
constexpr double kSigmasInBound = 3.0;

}  // namespace

void AddCovariance(const PointsRef& source,
                   const PointsRef& target,
                   double noise_bound,
                   PoseCovarianceOptions options,
                   PoseSummary* summary) {
  CHECK_EQ(source.cols(), target.cols());
  if (!summary->IsUsable()) return;
  Stopwatch stopwatch;
  options.model = summary->model;
  options.sigma = noise_bound / kSigmasInBound;
  options.prior.reset();
  if (summary->vertical && summary->model == PoseModel::kRigid) {
    options.prior = summary->vertical;
  } else if (summary->vertical) {
    options.up_in_target = summary->vertical->up_in_target;
    options.tilt_std = summary->vertical->angle_std;
  }
  const DistinctMatches inliers =
      FindDistinctMatches(Columns(source, summary->translation_inliers),
                          Columns(target, summary->translation_inliers));
  summary->covariance = ComputePoseCovariance(summary->scale * inliers.source,
                                              inliers.target,
                                              *summary->target_from_source,
                                              options);
  summary->stage_times.push_back({"covariance", stopwatch.Lap()});
}

}  // namespace quatro
