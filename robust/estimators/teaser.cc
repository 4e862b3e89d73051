// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/estimators/teaser.h"

#include <cmath>
#include <optional>
#include <sstream>
#include <vector>

#include "robust/estimators/crosscheck.h"
#include "robust/estimators/distinct_matches.h"
#include "robust/gnc/so3.h"
#include "robust/gnc/surrogate.h"
#include "robust/graph/far_matches.h"
#include "solvers/closed_form/translation.h"
#include "solvers/closed_form/valid_matches.h"

namespace quatro {
namespace {

constexpr int kNumNeeded = 3;

// The ratio of lengths that most differences agree on: each of length |a| holds
// it to within 2 noise bounds over |a|. Without what is far from the rest,
// whose bounds would drown the others.
std::optional<double> EstimateScale(const DistinctMatches& matches,
                                    const TeaserOptions& options) {
  const std::vector<Eigen::Index> near =
      FindNear(matches.source, matches.target, options.noise_bound);
  const auto n = static_cast<Eigen::Index>(near.size());
  const bool takes_all = n * (n - 1) / 2 <= options.num_scale_tims;
  const auto pairs =
      MakeTimPairs(n,
                   takes_all ? TimLayout::kComplete : TimLayout::kRandom,
                   options.num_scale_tims,
                   options.seed);
  const Eigen::VectorXd a =
      ComputeTims(Columns(matches.source, near), pairs).colwise().norm();
  const Eigen::VectorXd b =
      ComputeTims(Columns(matches.target, near), pairs).colwise().norm();
  std::vector<double> scales;
  std::vector<double> bounds;
  for (Eigen::Index k = 0; k < a.size(); ++k) {
    if (!(a[k] > 2.0 * options.noise_bound)) continue;
    scales.push_back(b[k] / a[k]);
    bounds.push_back(2.0 * options.noise_bound / a[k]);
  }
  const auto size = static_cast<Eigen::Index>(scales.size());
  const auto consensus =
      EstimateConsensus(Eigen::Map<const Eigen::VectorXd>(scales.data(), size),
                        Eigen::Map<const Eigen::VectorXd>(bounds.data(), size));
  if (!consensus || !(consensus->value > 0.0)) return std::nullopt;
  return consensus->value;
}

}  // namespace

bool TeaserOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  if (!(noise_bound > 0.0 && std::isfinite(noise_bound))) {
    problem << "noise_bound = " << noise_bound << ", must be > 0 and finite";
  } else if (num_scale_tims < 1) {
    problem << "num_scale_tims = " << num_scale_tims << ", must be >= 1";
  } else if (num_threads < 0) {
    problem << "num_threads = " << num_threads << ", must be >= 0";
  } else {
    PruningOptions pruning_options;
    pruning_options.time_limit_seconds = clique_time_limit_seconds;
    return pruning_options.IsValid(error) && gnc.IsValid(error);
  }
  *error = problem.str();
  return false;
}

TeaserSummary SolveTeaser(const PointsRef& source,
                          const PointsRef& target,
                          const TeaserOptions& options) {
  TeaserSummary summary;
  summary.num_needed = kNumNeeded;
  if (!options.IsValid(&summary.message) ||
      !AreValidMatches(source, target, &summary.message)) {
    return summary;
  }

  Stopwatch stopwatch;
  DistinctMatches matches =
      FindDistinctMatches(source, target, options.noise_bound);
  summary.num_matches = matches.source.cols();
  if (options.estimate_scale) {
    const auto scale = EstimateScale(matches, options);
    if (!scale) {
      summary.termination = PoseTermination::kInsufficient;
      summary.message = "no two matches determine the scale";
      return summary;
    }
    summary.scale = *scale;
    matches.source *= *scale;
    summary.stage_times.push_back({"scale", stopwatch.Lap()});
  }

  PruningOptions pruning;
  pruning.method = options.pruning;
  pruning.time_limit_seconds = options.clique_time_limit_seconds;
  pruning.consistency.bound = 2.0 * options.noise_bound;
  const std::vector<Eigen::Index> consistent = FindConsistent(
      matches, pruning, options.num_threads, &summary.stage_times);
  summary.num_consistent = static_cast<Eigen::Index>(consistent.size());
  summary.consistent = InputColumns(matches, consistent);
  if (summary.num_consistent < kNumNeeded) {
    summary.termination = PoseTermination::kInsufficient;
    std::ostringstream message;
    message << "a rotation needs three consistent matches; the largest "
               "consistent set of "
            << summary.num_matches << " matches has " << summary.num_consistent;
    summary.message = message.str();
    return summary;
  }
  stopwatch.Lap();

  const Points p = Columns(matches.source, consistent);
  const Points q = Columns(matches.target, consistent);
  const auto pairs =
      MakeTimPairs(p.cols(), options.tim_layout, 10 * p.cols(), options.seed);
  summary.num_tims = static_cast<Eigen::Index>(pairs.size());
  const So3 rotation_problem{
      ComputeTims(p, pairs), ComputeTims(q, pairs), 2.0 * options.noise_bound};
  if (options.crosscheck) {
    const CrossChecked<So3> checked(rotation_problem);
    summary.gnc = SolveGnc<TruncatedLeastSquares>(checked, options.gnc);
    summary.crosscheck = checked.report();
  } else {
    summary.gnc =
        SolveGnc<TruncatedLeastSquares>(rotation_problem, options.gnc);
  }
  if (summary.gnc.weights.size() > 0) {
    summary.match_weights = InputValues(
        matches, consistent, WeighPoints(pairs, summary.gnc.weights, p.cols()));
  }
  summary.stage_times.push_back({"rotation", stopwatch.Lap()});
  summary.notes.push_back(
      {"rotation",
       DescribeGnc(summary.gnc.termination, summary.gnc.iterations.size())});
  if (!summary.gnc.IsUsable()) {
    summary.termination = PoseTermination::kDegenerate;
    summary.message =
        "the consistent matches do not constrain the rotation: they are on one "
        "line (" +
        summary.gnc.message + ")";
    return summary;
  }
  summary.num_rotation_inliers =
      (summary.gnc.squared_residuals.array() <= 1.0).count();

  const Eigen::Matrix3d& rotation = summary.gnc.estimate->target_from_source;
  const auto translation =
      EstimateTranslation(rotation * p, q, options.noise_bound);
  std::vector<Eigen::Index> inliers;
  for (std::size_t k = 0; k < consistent.size(); ++k) {
    if (translation->is_inlier[static_cast<Eigen::Index>(k)]) {
      inliers.push_back(consistent[k]);
    }
  }
  if (options.crosscheck) {
    CrosscheckPose(Columns(matches.source, inliers),
                   Columns(matches.target, inliers),
                   &summary.crosscheck);
  }
  summary.num_translation_inliers = static_cast<Eigen::Index>(inliers.size());
  summary.translation_inliers = InputColumns(matches, inliers);
  summary.target_from_source =
      Rigid3{rotation, translation->target_from_source};
  summary.termination = PoseTermination::kSolved;
  summary.message = "solved";
  summary.stage_times.push_back({"translation", stopwatch.Lap()});
  return summary;
}

}  // namespace quatro
