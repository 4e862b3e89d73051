// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/estimators/arc_consensus.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>
#include <vector>

#include "features/base/parallel.h"
#include "features/base/random.h"
#include "robust/estimators/consensus.h"
#include "robust/estimators/distinct_matches.h"
#include "robust/estimators/tims.h"
#include "robust/graph/far_matches.h"
#include "solvers/closed_form/exact_yaw.h"
#include "solvers/closed_form/translation.h"
#include "solvers/closed_form/valid_matches.h"
#include "solvers/closed_form/yaw_translation.h"

namespace quatro {
namespace {

constexpr Eigen::Index kPiece = 1 << 15;  // Pairs drawn from one seed.

double MinPlanarLength(const ArcConsensusOptions& options) {
  return options.min_planar_length_factor * options.noise_bound;
}

// The pairs that keep their planar length and height difference.
std::vector<TimPair> FindGatedPairs(const DistinctMatches& matches,
                                    const ArcConsensusOptions& options) {
  const Eigen::Index n = matches.source.cols();
  const double bound = 2.0 * options.noise_bound;
  const double min_length = MinPlanarLength(options);
  const double max_length = MaxResolved(options.noise_bound);
  const double sin_tilt = std::sin(options.max_tilt);
  const auto passes = [&](const TimPair& pair) {
    const Eigen::Vector3d a =
        matches.source.col(pair.first) - matches.source.col(pair.second);
    const Eigen::Vector3d b =
        matches.target.col(pair.first) - matches.target.col(pair.second);
    const double length = a.head<2>().norm();
    return length >= min_length && length <= max_length &&
           std::abs(length - b.head<2>().norm()) <= bound &&
           std::abs(a.z() - b.z()) <= bound + length * sin_tilt;
  };

  // n (n - 1) / 2 does not overflow for any n that fits into memory.
  const bool takes_all = n * (n - 1) / 2 <= options.num_pairs;
  const Eigen::Index num_pairs = takes_all ? n : options.num_pairs;
  const Eigen::Index piece = takes_all ? 64 : kPiece;
  std::vector<std::vector<TimPair>> pieces(
      static_cast<std::size_t>((num_pairs + piece - 1) / piece));
  ParallelFor(
      options.num_threads,
      num_pairs,
      piece,
      [&](Eigen::Index begin, Eigen::Index end) {
        auto& kept = pieces[static_cast<std::size_t>(begin / piece)];
        if (takes_all) {
          for (Eigen::Index i = begin; i < end; ++i) {
            for (Eigen::Index j = 0; j < i; ++j) {
              if (passes({i, j})) kept.emplace_back(i, j);
            }
          }
          return;
        }
        for (const TimPair& pair : MakeTimPairs(
                 n,
                 TimLayout::kRandom,
                 end - begin,
                 Mix(options.seed) + static_cast<std::uint64_t>(begin))) {
          if (passes(pair)) kept.push_back(pair);
        }
      });
  std::vector<TimPair> gated;
  for (const auto& kept : pieces) {
    gated.insert(gated.end(), kept.begin(), kept.end());
  }
  return gated;
}

// The matches of the pairs that are inliers. A mask is used, because there are
// hundreds of thousands of such pairs if many matches are inliers.
std::vector<Eigen::Index> MatchesOf(
    const std::vector<TimPair>& pairs,
    const Eigen::Array<bool, Eigen::Dynamic, 1>& is_inlier,
    Eigen::Index num_matches) {
  std::vector<bool> is_of_inlier(static_cast<std::size_t>(num_matches));
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (!is_inlier[static_cast<Eigen::Index>(k)]) continue;
    is_of_inlier[static_cast<std::size_t>(pairs[k].first)] = true;
    is_of_inlier[static_cast<std::size_t>(pairs[k].second)] = true;
  }
  std::vector<Eigen::Index> candidates;
  for (Eigen::Index i = 0; i < num_matches; ++i) {
    if (is_of_inlier[static_cast<std::size_t>(i)]) candidates.push_back(i);
  }
  return candidates;
}

// Refits the pose to all of its inliers, and keeps the refit unless it has
// fewer inliers. Returns the inliers.
std::vector<Eigen::Index> Refit(const DistinctMatches& matches,
                                double noise_bound,
                                Rigid3* target_from_source) {
  std::vector<Eigen::Index> inliers = FindInliers(
      matches.source, matches.target, *target_from_source, noise_bound);
  const auto again = EstimateYawTranslation(
      Columns(matches.source, inliers),
      Columns(matches.target, inliers),
      Weights::Ones(static_cast<Eigen::Index>(inliers.size())));
  if (again) {
    std::vector<Eigen::Index> inliers_again = FindInliers(
        matches.source, matches.target, again->target_from_source, noise_bound);
    if (inliers_again.size() >= inliers.size()) {
      *target_from_source = again->target_from_source;
      inliers = std::move(inliers_again);
    }
  }
  return inliers;
}

}  // namespace

bool ArcConsensusOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  if (!(noise_bound > 0.0 && std::isfinite(noise_bound))) {
    problem << "noise_bound = " << noise_bound << ", must be > 0 and finite";
  } else if (!(max_tilt >= 0.0 && max_tilt <= M_PI / 2)) {
    problem << "max_tilt = " << max_tilt << ", must be in [0, pi/2]";
  } else if (num_pairs < 1) {
    problem << "num_pairs = " << num_pairs << ", must be >= 1";
  } else if (!(min_planar_length_factor >= 0.0)) {
    problem << "min_planar_length_factor = " << min_planar_length_factor
            << ", must be >= 0";
  } else if (num_threads < 0) {
    problem << "num_threads = " << num_threads << ", must be >= 0";
  }
  *error = problem.str();
  return error->empty();
}

PoseSummary SolveArcConsensus(const PointsRef& source,
                              const PointsRef& target,
                              const ArcConsensusOptions& options) {
  PoseSummary summary;
  summary.num_needed = 2;
  if (!options.IsValid(&summary.message) ||
      !AreValidMatches(source, target, &summary.message)) {
    return summary;
  }

  Stopwatch stopwatch;
  const DistinctMatches matches =
      FindDistinctMatches(source, target, options.noise_bound);
  summary.num_matches = matches.source.cols();
  summary.termination = PoseTermination::kInsufficient;
  std::vector<TimPair> pairs;
  if (summary.num_matches >= 2) pairs = FindGatedPairs(matches, options);
  summary.num_tims = static_cast<Eigen::Index>(pairs.size());
  summary.stage_times.push_back({"pairs", stopwatch.Lap()});

  const Points alpha = ComputeTims(matches.source, pairs);
  const Points beta = ComputeTims(matches.target, pairs);
  const auto yaw = EstimateExactYaw(
      alpha,
      beta,
      Weights::Ones(alpha.cols()),
      Weights::Constant(alpha.cols(), 2.0 * options.noise_bound));
  summary.stage_times.push_back({"rotation", stopwatch.Lap()});
  if (!yaw) {
    std::ostringstream message;
    message << "a heading needs two consistent matches at least "
            << MinPlanarLength(options) << " m apart; none were found among "
            << summary.num_matches << " matches";
    summary.message = message.str();
    return summary;
  }
  summary.num_rotation_inliers = yaw->num_inliers;

  const std::vector<Eigen::Index> candidates =
      MatchesOf(pairs, yaw->is_inlier, summary.num_matches);
  summary.num_consistent = static_cast<Eigen::Index>(candidates.size());
  summary.consistent = InputColumns(matches, candidates);
  Rigid3 target_from_source;
  target_from_source.rotation = RotationZ(yaw->target_from_source);
  target_from_source.translation =
      EstimateTranslation(
          target_from_source.rotation * Columns(matches.source, candidates),
          Columns(matches.target, candidates),
          options.noise_bound)
          ->target_from_source;

  const std::vector<Eigen::Index> inliers =
      Refit(matches, options.noise_bound, &target_from_source);
  summary.num_translation_inliers = static_cast<Eigen::Index>(inliers.size());
  summary.translation_inliers = InputColumns(matches, inliers);
  summary.target_from_source = target_from_source;
  summary.model = PoseModel::kYawTranslation;
  summary.termination = PoseTermination::kSolved;
  summary.message = "solved";
  summary.stage_times.push_back({"translation", stopwatch.Lap()});
  return summary;
}

}  // namespace quatro
