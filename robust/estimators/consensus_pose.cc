// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/estimators/consensus_pose.h"

#include <string>
#include <vector>

#include "features/base/stopwatch.h"
#include "robust/estimators/consensus.h"
#include "robust/estimators/consensus_search.h"
#include "robust/estimators/distinct_matches.h"
#include "solvers/closed_form/valid_matches.h"

namespace quatro {
namespace {

// The best proposal hardly depends on how many others are kept.
constexpr int kNumProposals = 16;

ConsensusSearchOptions SearchOptions(const ConsensusPoseOptions& options) {
  ConsensusSearchOptions search;
  search.noise_bound = options.noise_bound;
  search.max_tilt = options.max_tilt;
  search.max_num_proposals = kNumProposals;
  search.num_threads = options.num_threads;
  return search;
}

}  // namespace

bool ConsensusPoseOptions::IsValid(std::string* error) const {
  return SearchOptions(*this).IsValid(error);
}

PoseSummary SolveConsensusPose(const PointsRef& source,
                               const PointsRef& target,
                               const ConsensusPoseOptions& options) {
  PoseSummary summary;
  summary.num_needed = 3;
  if (!options.IsValid(&summary.message) ||
      !AreValidMatches(source, target, &summary.message)) {
    return summary;
  }

  Stopwatch stopwatch;
  const DistinctMatches matches =
      FindDistinctMatches(source, target, options.noise_bound);
  summary.num_matches = matches.source.cols();
  const std::vector<Proposal> proposals =
      SearchConsensus(matches.source, matches.target, SearchOptions(options));
  summary.stage_times.push_back({"search", stopwatch.Lap()});
  if (proposals.empty()) {
    summary.termination = PoseTermination::kInsufficient;
    summary.message = "no three of " + std::to_string(summary.num_matches) +
                      " matches are consistent with a yaw and a translation";
    return summary;
  }
  const Proposal& best = proposals.front();
  summary.num_consistent = static_cast<Eigen::Index>(best.inliers.size());
  summary.consistent = InputColumns(matches, best.inliers);
  const std::vector<Eigen::Index> inliers = FindInliers(matches.source,
                                                        matches.target,
                                                        best.target_from_source,
                                                        options.noise_bound);
  summary.num_translation_inliers = static_cast<Eigen::Index>(inliers.size());
  summary.translation_inliers = InputColumns(matches, inliers);
  summary.target_from_source = best.target_from_source;
  summary.model = PoseModel::kYawTranslation;
  summary.termination = PoseTermination::kSolved;
  summary.message = "solved";
  return summary;
}

}  // namespace quatro
