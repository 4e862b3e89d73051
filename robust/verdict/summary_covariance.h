// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The covariance of an estimator's pose (solvers/ceres/pose_covariance.h) from
// the matches it calls inliers, copies counted once, with a match off by the
// noise bound at three standard deviations.
//
// The estimator says what it estimated (PoseSummary::model): roll and pitch of
// one that finds the yaw alone are assumed, not certain.

#ifndef QUATRO_ROBUST_VERDICT_SUMMARY_COVARIANCE_H_
#define QUATRO_ROBUST_VERDICT_SUMMARY_COVARIANCE_H_

#include "features/base/types.h"
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
                   PoseSummary* summary);

}  // namespace quatro

#endif  // QUATRO_ROBUST_VERDICT_SUMMARY_COVARIANCE_H_
