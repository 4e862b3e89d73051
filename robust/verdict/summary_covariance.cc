// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/verdict/summary_covariance.h"

#include <glog/logging.h>

#include "features/base/stopwatch.h"
#include "robust/estimators/distinct_matches.h"

namespace quatro {
namespace {

// The noise bound, in standard deviations of an inlier.
constexpr double kSigmasInBound = 3.0;

Points Joined(const Points& a, const Points& b) {
  Points joined(3, a.cols() + b.cols());
  joined.leftCols(a.cols()) = a;
  joined.rightCols(b.cols()) = b;
  return joined;
}

}  // namespace

void AddCovariance(const PointsRef& source,
                   const PointsRef& target,
                   double noise_bound,
                   const CovarianceOptions& options,
                   const MatchedPoints& more,
                   PoseSummary* summary) {
  CHECK_EQ(source.cols(), target.cols());
  if (!summary->IsUsable()) return;
  Stopwatch stopwatch;
  PoseCovarianceOptions of_pose;
  static_cast<CovarianceOptions&>(of_pose) = options;
  of_pose.model = summary->model;
  of_pose.sigma = noise_bound / kSigmasInBound;
  if (summary->vertical && summary->model == PoseModel::kRigid) {
    of_pose.prior = summary->vertical;
  } else if (summary->vertical) {
    of_pose.up_in_target = summary->vertical->up_in_target;
    of_pose.tilt_std = summary->vertical->angle_std;
  }
  const DistinctMatches inliers = FindDistinctMatches(
      Joined(Columns(source, summary->translation_inliers), more.source),
      Joined(Columns(target, summary->translation_inliers), more.target));
  summary->covariance = ComputePoseCovariance(summary->scale * inliers.source,
                                              inliers.target,
                                              *summary->target_from_source,
                                              of_pose);
  summary->stage_times.push_back({"covariance", stopwatch.Lap()});
}

}  // namespace quatro
