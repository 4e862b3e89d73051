// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/quatro.h"

#include <glog/logging.h>

#include <algorithm>
#include <numeric>
#include <sstream>

#include "robust/distinct_matches.h"
#include "robust/max_clique.h"
#include "robust/quasi_so3.h"
#include "robust/surrogate.h"
#include "solvers/translation.h"

namespace quatro {
namespace {

std::vector<int> FindConsistent(const DistinctMatches& matches,
                                const QuatroOptions& options,
                                Stopwatch* stopwatch,
                                std::vector<StageTime>* times) {
  const auto n = static_cast<int>(matches.source.cols());
  if (options.pruning == Pruning::kNone) {
    std::vector<int> all(static_cast<std::size_t>(n));
    std::iota(all.begin(), all.end(), 0);
    return all;
  }
  ConsistencyOptions consistency;
  consistency.test = options.consistency_test;
  consistency.bound = 2.0 * options.noise_bound;
  consistency.max_tilt = options.max_tilt;
  const Graph graph = BuildConsistencyGraph(
      matches.source, matches.target, consistency, options.num_threads);
  times->push_back({"graph", stopwatch->Lap()});
  std::vector<int> consistent = options.pruning == Pruning::kMaxCore
                                    ? FindMaxCore(graph)
                                    : FindCliqueGreedily(graph);
  times->push_back({"clique", stopwatch->Lap()});
  return consistent;
}

Points Columns(const PointsRef& points, const std::vector<int>& columns) {
  Points selected(3, static_cast<Eigen::Index>(columns.size()));
  Eigen::Index k = 0;
  for (const int column : columns) selected.col(k++) = points.col(column);
  return selected;
}

// The input columns that the given distinct matches stand for.
std::vector<Eigen::Index> InputColumns(const DistinctMatches& matches,
                                       const std::vector<int>& selected) {
  std::vector<Eigen::Index> columns;
  for (const int k : selected) {
    const auto& copies = matches.columns[static_cast<std::size_t>(k)];
    columns.insert(columns.end(), copies.begin(), copies.end());
  }
  std::sort(columns.begin(), columns.end());
  return columns;
}

}  // namespace

bool QuatroOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  if (!(noise_bound > 0.0)) {
    problem << "noise_bound = " << noise_bound << ", must be > 0";
  } else if (!(tim_bound_factor > 0.0)) {
    problem << "tim_bound_factor = " << tim_bound_factor << ", must be > 0";
  } else if (num_random_tims < 1) {
    problem << "num_random_tims = " << num_random_tims << ", must be >= 1";
  } else if (num_threads < 0) {
    problem << "num_threads = " << num_threads << ", must be >= 0";
  } else {
    ConsistencyOptions consistency;
    consistency.max_tilt = max_tilt;
    return consistency.IsValid(error) && gnc.IsValid(error);
  }
  *error = problem.str();
  return false;
}

QuatroSummary SolveQuatro(const PointsRef& source,
                          const PointsRef& target,
                          const QuatroOptions& options) {
  CHECK_EQ(source.cols(), target.cols());
  QuatroSummary summary;
  if (!options.IsValid(&summary.message)) return summary;
  if (!source.allFinite() || !target.allFinite()) {
    summary.message = "a matched point is not finite";
    return summary;
  }

  Stopwatch stopwatch;
  const DistinctMatches matches = FindDistinctMatches(source, target);
  summary.num_distinct = matches.source.cols();
  const std::vector<int> consistent =
      FindConsistent(matches, options, &stopwatch, &summary.stage_times);
  summary.num_consistent = static_cast<Eigen::Index>(consistent.size());
  summary.consistent = InputColumns(matches, consistent);
  const Points p = Columns(matches.source, consistent);
  const Points q = Columns(matches.target, consistent);

  const std::vector<TimPair> pairs = MakeTimPairs(
      p.cols(), options.tim_layout, options.num_random_tims, options.seed);
  summary.num_tims = static_cast<Eigen::Index>(pairs.size());
  if (pairs.empty()) {
    summary.termination = QuatroTermination::kInsufficient;
    std::ostringstream message;
    message << "a heading needs two consistent matches, of "
            << summary.num_distinct << " there is " << summary.num_consistent;
    summary.message = message.str();
    return summary;
  }

  const QuasiSo3 rotation{ComputeTims(p, pairs),
                          ComputeTims(q, pairs),
                          options.tim_bound_factor * options.noise_bound};
  summary.gnc = options.surrogate == SurrogateType::kGemanMcClure
                    ? SolveGnc<GemanMcClure>(rotation, options.gnc)
                    : SolveGnc<TruncatedLeastSquares>(rotation, options.gnc);
  summary.stage_times.push_back({"rotation", stopwatch.Lap()});
  if (!summary.gnc.IsUsable()) {
    summary.termination = QuatroTermination::kDegenerate;
    summary.message =
        "the consistent matches hold no heading: they are at one place or "
        "above one another (" +
        summary.gnc.message + ")";
    return summary;
  }
  summary.num_rotation_inliers =
      (summary.gnc.squared_residuals.array() <= 1.0).count();

  Rigid3 target_from_source;
  target_from_source.rotation =
      RotationZ(summary.gnc.estimate->target_from_source);
  const auto translation = EstimateTranslation(
      target_from_source.rotation * p, q, options.noise_bound);
  target_from_source.translation = translation->target_from_source;
  std::vector<int> inliers;
  for (std::size_t k = 0; k < consistent.size(); ++k) {
    if (translation->is_inlier[static_cast<Eigen::Index>(k)]) {
      inliers.push_back(consistent[k]);
    }
  }
  summary.num_translation_inliers = static_cast<Eigen::Index>(inliers.size());
  summary.translation_inliers = InputColumns(matches, inliers);
  summary.target_from_source = target_from_source;
  summary.termination = QuatroTermination::kSolved;
  summary.message = "solved";
  summary.stage_times.push_back({"translation", stopwatch.Lap()});
  return summary;
}

}  // namespace quatro
