// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The summary that every estimator of a pose from matched points returns.

#ifndef QUATRO_ROBUST_ESTIMATORS_POSE_SUMMARY_H_
#define QUATRO_ROBUST_ESTIMATORS_POSE_SUMMARY_H_

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "features/base/rigid3.h"
#include "features/base/stopwatch.h"
#include "features/base/types.h"
#include "solvers/ceres/ins_refinement.h"
#include "solvers/ceres/pose_covariance.h"

namespace quatro {

// Why an estimator ended.
enum class PoseTermination {
  kInvalidInput,  // Bad options, unequal numbers, or points not finite.
  kInsufficient,  // Too few consistent matches, or no pose within the bounds.
  kDegenerate,    // The consistent matches do not constrain the pose.
  kSolved,
};

// How far the cost of the GNC yaw is above the global optimum of truncated
// least squares over the yaw of the TIMs (solvers/closed_form/exact_yaw.h).
struct YawCertificate {
  std::optional<double> gnc_cost;  // Not set if GNC failed.
  double optimal_cost = 0.0;
  // gnc_cost - optimal_cost, nonnegative up to rounding.
  std::optional<double> gap;
};

// The largest differences between closed forms and their Ceres twins in a run.
struct CrosscheckReport {
  Eigen::Index num_subproblems = 0;
  double max_rotation_difference = 0.0;     // [rad]
  double max_translation_difference = 0.0;  // [m]
};

// A note on what a stage did and why it stopped.
struct StageNote {
  std::string stage;
  std::string text;
};

// The pose, the number of inliers at each stage, and why the estimator ended.
struct PoseSummary {
  PoseTermination termination = PoseTermination::kInvalidInput;
  std::string message = "no estimator was called";

  // Set iff the termination is kSolved. This does not say whether the pose is
  // correct (see robust/verdict/verdict.h).
  std::optional<Rigid3> target_from_source;

  // The pose before the polish in SE(3), if it was polished.
  std::optional<Rigid3> unpolished_target_from_source;

  // The degrees of freedom that were estimated, and the vertical if an INS
  // gives it: as an assumption (kYawTranslation), or as a prior in addition to
  // the matches (kRigid).
  PoseModel model = PoseModel::kRigid;
  std::optional<VerticalPrior> vertical;

  // Set by AddCovariance() (robust/verdict/summary_covariance.h), for every
  // estimator.
  std::optional<PoseCovariance> covariance;

  double scale = 1.0;  // Target length over source length, or 1.

  // The number of consistent matches that this estimator needs.
  int num_needed = 0;

  // Columns of the input matches, in ascending order. The copies of a match are
  // all included or all excluded. The counts below count them once.
  std::vector<Eigen::Index> consistent;           // After pruning.
  std::vector<Eigen::Index> translation_inliers;  // Within the noise bound.

  // For each match in `consistent`, the largest weight in [0, 1] of the TIMs
  // that it is part of. Empty if the estimator has no weights.
  std::vector<double> match_weights;

  Eigen::Index num_matches = 0;
  Eigen::Index num_consistent = 0;
  Eigen::Index num_tims = 0;
  Eigen::Index num_rotation_inliers = 0;  // TIMs, or matches if there are none.
  Eigen::Index num_translation_inliers = 0;

  std::optional<YawCertificate> certificate;
  std::optional<CrosscheckReport> crosscheck;
  std::vector<StageTime> stage_times;
  std::vector<StageNote> notes;  // In the order of the stages.

  bool IsUsable() const { return target_from_source.has_value(); }

  // The note of a stage, or an empty string.
  std::string Note(const std::string& stage) const {
    for (const StageNote& note : notes) {
      if (note.stage == stage) return note.text;
    }
    return {};
  }
};

// Any estimator together with its options. The columns in its summary must be
// in [0, N) for N matches, and in ascending order.
using PoseSolver = std::function<PoseSummary(const PointsRef& source,
                                             const PointsRef& target)>;

}  // namespace quatro

#endif  // QUATRO_ROBUST_ESTIMATORS_POSE_SUMMARY_H_
