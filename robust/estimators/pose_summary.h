// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// What every estimator of a pose from matched points reports.

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

// How an estimator ended.
enum class PoseTermination {
  kInvalidInput,  // Options out of range or points that are not finite.
  kInsufficient,  // Fewer consistent matches than the estimator needs.
  kDegenerate,    // Enough of them, but they do not hold the pose.
  kSolved,
};

// How far a graduated answer is from the global optimum of its own problem, the
// truncated least squares over the yaw of the TIMs
// (solvers/closed_form/exact_yaw.h).
struct YawCertificate {
  std::optional<double> gnc_cost;  // Nothing if GNC gave no answer.
  double optimal_cost = 0.0;
  // gnc_cost - optimal_cost, never negative but for rounding.
  std::optional<double> gap;
};

// The largest disagreement between a closed form and its Ceres twin in a run.
struct CrosscheckReport {
  Eigen::Index num_subproblems = 0;
  double max_rotation_difference = 0.0;     // [rad]
  double max_translation_difference = 0.0;  // [m]
};

// What a stage did and why it stopped, for a reader.
struct StageNote {
  std::string stage;
  std::string text;
};

// The pose, how many matches held it at each stage, and why it ended so.
struct PoseSummary {
  PoseTermination termination = PoseTermination::kInvalidInput;
  std::string message = "no estimator was called";

  // Set iff termination is kSolved; whether it is right is another question
  // (robust/verdict/verdict.h).
  std::optional<Rigid3> target_from_source;

  // The answer before it was polished in SE(3), if it was.
  std::optional<Rigid3> unpolished_target_from_source;

  // What of the pose was estimated, and what it takes from an INS: which way is
  // up (kYawTranslation), or a term beside the matches (kRigid).
  PoseModel model = PoseModel::kRigid;
  std::optional<VerticalPrior> vertical;

  // By AddCovariance() (robust/verdict/summary_covariance.h), for every
  // estimator.
  std::optional<PoseCovariance> covariance;

  double scale = 1.0;  // Of the target over the source; 1 unless estimated.

  // Consistent matches that this estimator needs.
  int num_needed = 0;

  // Columns of the matches given, in ascending order. Copies of one match are
  // kept or left out together, and count once.
  std::vector<Eigen::Index> consistent;           // After pruning.
  std::vector<Eigen::Index> translation_inliers;  // Within the noise bound.

  // Of each of `consistent`, the largest weight in [0, 1] that the rotation
  // gave to a difference it is part of; empty if the estimator weighs none.
  std::vector<double> match_weights;

  Eigen::Index num_matches = 0;
  Eigen::Index num_consistent = 0;
  Eigen::Index num_tims = 0;
  Eigen::Index num_rotation_inliers = 0;  // TIMs within their bound.
  Eigen::Index num_translation_inliers = 0;

  std::optional<YawCertificate> certificate;
  std::optional<CrosscheckReport> crosscheck;
  std::vector<StageTime> stage_times;
  std::vector<StageNote> notes;  // In the order of the stages; some have none.

  bool IsUsable() const { return target_from_source.has_value(); }

  // The note of a stage, empty if it has none.
  std::string Note(const std::string& stage) const {
    for (const StageNote& note : notes) {
      if (note.stage == stage) return note.text;
    }
    return {};
  }
};

// Any estimator; its options are its own. Columns that it tells are in [0, N)
// of the N matches, and in ascending order.
using PoseSolver = std::function<PoseSummary(const PointsRef& source,
                                             const PointsRef& target)>;

}  // namespace quatro

#endif  // QUATRO_ROBUST_ESTIMATORS_POSE_SUMMARY_H_
