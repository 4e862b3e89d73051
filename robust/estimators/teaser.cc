// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/estimators/teaser.h"

#include <cmath>
#include <optional>
#include <sstream>
#include <vector>

#include "robust/estimators/decoupled.h"
#include "robust/estimators/distinct_matches.h"
#include "robust/gnc/so3.h"
#include "robust/gnc/surrogate.h"
#include "robust/graph/far_matches.h"
#include "solvers/closed_form/translation.h"
#include "solvers/closed_form/valid_matches.h"

namespace quatro {
namespace {

constexpr int kTeaserNeeds = 3;

// The ratio of lengths that is consistent with the most differences. A
// difference of length |a| measures it up to 2 noise bounds / |a|. Matches far
// from the others are left out, because the weights of their long differences
// would dominate.
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
  summary.num_needed = kTeaserNeeds;
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
  ConsistentSet set =
      PruneMatches(matches, pruning, options.num_threads, &summary);
  if (summary.num_consistent < kTeaserNeeds) {
    EndInsufficient("a rotation needs three consistent matches", &summary);
    return summary;
  }
  stopwatch.Lap();

  ChooseTims(
      options.tim_layout, 10 * set.source.cols(), options.seed, &set, &summary);
  const So3 rotation_problem{ComputeTims(set.source, set.tims),
                             ComputeTims(set.target, set.tims),
                             2.0 * options.noise_bound};
  summary.gnc = SolveRotation(rotation_problem,
                              SurrogateType::kTruncatedLeastSquares,
                              options.gnc,
                              options.crosscheck,
                              &summary);
  WeighMatches(matches, set, summary.gnc.weights, &summary);
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

  std::vector<Eigen::Index> inliers;
  const Rigid3 pose = AddTranslation(set,
                                     summary.gnc.estimate->target_from_source,
                                     options.noise_bound,
                                     &inliers);
  EndSolved(matches, pose, inliers, options.crosscheck, &summary);
  summary.stage_times.push_back({"translation", stopwatch.Lap()});
  return summary;
}

}  // namespace quatro
