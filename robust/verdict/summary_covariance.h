// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The covariance of an estimator's pose (solvers/ceres/pose_covariance.h) from
// its inliers. Copies of a match count once. The noise bound is three standard
// deviations of an inlier. `more` are inliers that are not among the solved
// matches (features/guided_matching.h), column by column.
//
// If the estimator finds only the yaw (PoseSummary::model), the covariance
// includes the uncertainty of the assumed roll and pitch.

#ifndef QUATRO_ROBUST_VERDICT_SUMMARY_COVARIANCE_H_
#define QUATRO_ROBUST_VERDICT_SUMMARY_COVARIANCE_H_

#include "features/base/types.h"
#include "features/matching.h"
#include "robust/estimators/pose_summary.h"
#include "solvers/ceres/pose_covariance.h"

namespace quatro {

// Sets summary->covariance and adds a stage time; does nothing without a pose.
// `source` and `target` are the matches that were solved, with z up;
// `noise_bound` [m].
void AddCovariance(const PointsRef& source,
                   const PointsRef& target,
                   double noise_bound,
                   const CovarianceOptions& options,
                   const MatchedPoints& more,
                   PoseSummary* summary);

}  // namespace quatro

#endif  // QUATRO_ROBUST_VERDICT_SUMMARY_COVARIANCE_H_
