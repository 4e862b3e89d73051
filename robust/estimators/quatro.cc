// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/estimators/quatro.h"

#include <cmath>
#include <optional>
#include <sstream>
#include <vector>

#include "robust/estimators/consensus.h"
#include "robust/estimators/decoupled.h"
#include "robust/estimators/distinct_matches.h"
#include "robust/estimators/recovery.h"
#include "robust/gnc/quasi_so3.h"
#include "robust/gnc/surrogate.h"
#include "solvers/closed_form/exact_yaw.h"
#include "solvers/closed_form/valid_matches.h"

namespace quatro {
namespace {

constexpr int kQuatroNeeds = 2;

PruningOptions PruningFrom(const QuatroOptions& options) {
  PruningOptions pruning;
  pruning.method = options.pruning;
  pruning.time_limit_seconds = options.clique_time_limit_seconds;
  pruning.consistency.test = options.consistency_test;
  pruning.consistency.bound = 2.0 * options.noise_bound;
  pruning.consistency.max_tilt = options.max_tilt;
  return pruning;
}

PolishOptions PolishFrom(const QuatroOptions& options) {
  PolishOptions polish;
  polish.noise_bound = options.noise_bound;
  polish.max_tilt = options.polish_max_tilt;
  polish.max_rotation_std = options.polish_max_rotation_std;
  return polish;
}

// Estimates the yaw by the chosen solver and computes the certificate. Returns
// nullopt if the TIMs do not constrain the yaw.
std::optional<double> FindYaw(const QuasiSo3& rotation,
                              const QuatroOptions& options,
                              QuatroSummary* summary) {
  if (options.yaw_solver == YawSolver::kGnc) {
    summary->gnc = SolveRotation(
        rotation, options.surrogate, options.gnc, options.crosscheck, summary);
  }
  const Weights weights = Weights::Ones(rotation.NumMeasurements());
  const Weights bounds =
      Weights::Constant(weights.size(), rotation.noise_bound);
  const auto exact =
      EstimateExactYaw(rotation.source, rotation.target, weights, bounds);
  const auto& gnc = summary->gnc.estimate;

  std::optional<double> yaw;
  if (gnc) yaw = gnc->target_from_source;
  if (exact) {
    YawCertificate certificate;
    certificate.optimal_cost = exact->cost;
    if (gnc) {
      certificate.gnc_cost = TruncatedYawCost(
          rotation.source, rotation.target, weights, bounds, *yaw);
      certificate.gap = *certificate.gnc_cost - certificate.optimal_cost;
    }
    const bool misses =
        !gnc || *certificate.gap > options.certificate_tolerance;
    summary->certificate = certificate;
    if (options.yaw_solver == YawSolver::kExact ||
        (options.replace_missed_optimum && misses)) {
      yaw = exact->target_from_source;
      summary->is_yaw_exact = true;
    }
  }
  if (yaw) {
    YawEstimate estimate;
    estimate.target_from_source = *yaw;
    const auto is_inlier =
        (rotation.SquaredResiduals(estimate).array() <= 1.0).eval();
    summary->num_rotation_inliers = is_inlier.count();
    // A TIM that is an inlier at any yaw does not constrain the yaw. An example
    // is a TIM between points of a pole.
    const auto is_short = (rotation.source.topRows<2>().colwise().norm() +
                           rotation.target.topRows<2>().colwise().norm())
                              .transpose()
                              .array() <= rotation.noise_bound;
    if (is_inlier.any() && (!is_inlier || is_short).all()) return std::nullopt;
  }
  return yaw;
}

// The weight of each TIM: that of GNC, or, if the exact yaw was chosen, 1 for
// inliers and 0 for outliers. Empty if the exact yaw was then rejected.
Eigen::VectorXd TimWeights(const QuasiSo3& rotation,
                           const QuatroSummary& summary,
                           const std::optional<double>& yaw) {
  if (!summary.is_yaw_exact) return summary.gnc.weights;
  if (!yaw) return {};
  YawEstimate estimate;
  estimate.target_from_source = *yaw;
  return (rotation.SquaredResiduals(estimate).array() <= 1.0).cast<double>();
}

std::string NoteMove(const Rigid3& before, const Rigid3& after) {
  const double shift = (after.translation - before.translation).norm();
  if (shift == 0.0) return "no other translation fits the matches better";
  std::ostringstream text;
  text.precision(2);
  text << "moved by " << shift
       << " m to a translation that fits all matches better";
  return text.str();
}

// Recovers the translation and polishes the pose, as far as the options ask for
// it. Returns whether the inliers must be found again.
bool ImprovePose(const DistinctMatches& matches,
                 const ConsistentSet& set,
                 const QuatroOptions& options,
                 Rigid3* pose,
                 QuatroSummary* summary) {
  Stopwatch stopwatch;
  if (options.recover_translation) {
    const Rigid3 unrecovered = *pose;
    *pose = RecoverTranslation(
        matches.source, matches.target, *pose, options.noise_bound);
    summary->notes.push_back({"recovery", NoteMove(unrecovered, *pose)});
    summary->stage_times.push_back({"recovery", stopwatch.Lap()});
  }
  if (options.polish) {
    const PolishSummary polish = Polish(matches.source,
                                        matches.target,
                                        set.columns,
                                        *pose,
                                        PolishFrom(options));
    summary->notes.push_back({"polish", polish.message});
    if (polish.is_polished) {
      summary->unpolished_target_from_source = *pose;
      summary->model = PoseModel::kRigid;
      *pose = polish.target_from_source;
    }
    summary->stage_times.push_back({"polish", stopwatch.Lap()});
  }
  return options.recover_translation || options.polish;
}

}  // namespace

bool QuatroOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  if (!(noise_bound > 0.0 && std::isfinite(noise_bound))) {
    problem << "noise_bound = " << noise_bound << ", must be > 0 and finite";
  } else if (!(tim_bound_factor > 0.0 && std::isfinite(tim_bound_factor))) {
    problem << "tim_bound_factor = " << tim_bound_factor
            << ", must be > 0 and finite";
  } else if (num_random_tims < 1) {
    problem << "num_random_tims = " << num_random_tims << ", must be >= 1";
  } else if (!(certificate_tolerance >= 0.0)) {
    problem << "certificate_tolerance = " << certificate_tolerance
            << ", must be >= 0";
  } else if (num_threads < 0) {
    problem << "num_threads = " << num_threads << ", must be >= 0";
  } else {
    return PruningFrom(*this).IsValid(error) && gnc.IsValid(error) &&
           PolishFrom(*this).IsValid(error);
  }
  *error = problem.str();
  return false;
}

QuatroSummary SolveQuatro(const PointsRef& source,
                          const PointsRef& target,
                          const QuatroOptions& options) {
  QuatroSummary summary;
  summary.num_needed = kQuatroNeeds;
  if (!options.IsValid(&summary.message) ||
      !AreValidMatches(source, target, &summary.message)) {
    return summary;
  }

  const DistinctMatches matches =
      FindDistinctMatches(source, target, options.noise_bound);
  summary.num_matches = matches.source.cols();
  ConsistentSet set = PruneMatches(
      matches, PruningFrom(options), options.num_threads, &summary);
  Stopwatch stopwatch;
  ChooseTims(options.tim_layout,
             options.num_random_tims,
             options.seed,
             &set,
             &summary);
  if (set.tims.empty()) {
    EndInsufficient("a heading needs two consistent matches", &summary);
    return summary;
  }
  const QuasiSo3 rotation_problem{
      ComputeTims(set.source, set.tims),
      ComputeTims(set.target, set.tims),
      options.tim_bound_factor * options.noise_bound};
  const auto yaw = FindYaw(rotation_problem, options, &summary);
  WeighMatches(
      matches, set, TimWeights(rotation_problem, summary, yaw), &summary);
  summary.stage_times.push_back({"rotation", stopwatch.Lap()});
  if (options.yaw_solver == YawSolver::kGnc) {
    summary.notes.push_back(
        {"rotation",
         DescribeGnc(summary.gnc.termination, summary.gnc.iterations.size())});
  }
  if (!yaw) {
    summary.termination = PoseTermination::kDegenerate;
    summary.message =
        "the consistent matches do not constrain the heading: they are at one "
        "place or on a vertical line, or no rotation about the vertical fits "
        "them; use more matches, and see whether z is up in both scans";
    return summary;
  }
  summary.yaw = *yaw;
  summary.model = PoseModel::kYawTranslation;

  std::vector<Eigen::Index> inliers;
  Rigid3 pose =
      AddTranslation(set, RotationZ(*yaw), options.noise_bound, &inliers);
  summary.stage_times.push_back({"translation", stopwatch.Lap()});
  if (ImprovePose(matches, set, options, &pose, &summary)) {
    inliers =
        FindInliers(matches.source, matches.target, pose, options.noise_bound);
  }
  EndSolved(matches, pose, inliers, options.crosscheck, &summary);
  if (summary.certificate && summary.is_yaw_exact &&
      options.yaw_solver == YawSolver::kGnc) {
    summary.message =
        "solved; GNC missed the optimum, so the exact yaw is used";
  }
  return summary;
}

}  // namespace quatro
