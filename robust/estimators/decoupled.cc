// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/estimators/decoupled.h"

#include <sstream>

#include "solvers/closed_form/translation.h"

namespace quatro {

ConsistentSet PruneMatches(const DistinctMatches& matches,
                           const PruningOptions& options,
                           int num_threads,
                           PoseSummary* summary) {
  ConsistentSet set;
  set.columns =
      FindConsistent(matches, options, num_threads, &summary->stage_times);
  summary->num_consistent = static_cast<Eigen::Index>(set.columns.size());
  summary->consistent = InputColumns(matches, set.columns);
  set.source = Columns(matches.source, set.columns);
  set.target = Columns(matches.target, set.columns);
  return set;
}

void ChooseTims(TimLayout layout,
                Eigen::Index num_random,
                std::uint64_t seed,
                ConsistentSet* set,
                PoseSummary* summary) {
  set->tims = MakeTimPairs(set->source.cols(), layout, num_random, seed);
  summary->num_tims = static_cast<Eigen::Index>(set->tims.size());
}

void EndInsufficient(const std::string& needs, PoseSummary* summary) {
  summary->termination = PoseTermination::kInsufficient;
  std::ostringstream message;
  message << needs << ", but at most " << summary->num_consistent << " of "
          << summary->num_matches
          << " matches are consistent; use larger radii, a larger noise bound "
             "or other scans";
  summary->message = message.str();
}

void WeighMatches(const DistinctMatches& matches,
                  const ConsistentSet& set,
                  const Eigen::VectorXd& tim_weights,
                  PoseSummary* summary) {
  if (tim_weights.size() == 0) return;
  summary->match_weights =
      InputValues(matches,
                  set.columns,
                  WeighPoints(set.tims, tim_weights, set.source.cols()));
}

Rigid3 AddTranslation(const ConsistentSet& set,
                      const Eigen::Matrix3d& rotation,
                      double noise_bound,
                      std::vector<Eigen::Index>* inliers) {
  const auto translation =
      EstimateTranslation(rotation * set.source, set.target, noise_bound);
  inliers->clear();
  for (std::size_t k = 0; k < set.columns.size(); ++k) {
    if (translation->is_inlier[static_cast<Eigen::Index>(k)]) {
      inliers->push_back(set.columns[k]);
    }
  }
  return {rotation, translation->target_from_source};
}

void EndSolved(const DistinctMatches& matches,
               const Rigid3& pose,
               const std::vector<Eigen::Index>& inliers,
               bool crosscheck,
               PoseSummary* summary) {
  if (crosscheck) {
    CrosscheckPose(Columns(matches.source, inliers),
                   Columns(matches.target, inliers),
                   &summary->crosscheck);
  }
  summary->num_translation_inliers = static_cast<Eigen::Index>(inliers.size());
  summary->translation_inliers = InputColumns(matches, inliers);
  summary->target_from_source = pose;
  summary->termination = PoseTermination::kSolved;
  summary->message = "solved";
}

}  // namespace quatro
