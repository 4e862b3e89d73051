// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/report/match_stages.h"

#include <cstddef>

namespace quatro {

MatchStages FindMatchStages(const RegistrationSummary& summary) {
  const auto num_matches =
      static_cast<std::size_t>(summary.matched_source.cols());
  const PoseSummary& solution = summary.solution;
  MatchStages stages;
  stages.fates.resize(num_matches);
  for (const Eigen::Index i : solution.consistent) {
    stages.fates[static_cast<std::size_t>(i)] |= kIsConsistent;
  }
  for (const Eigen::Index i : solution.translation_inliers) {
    stages.fates[static_cast<std::size_t>(i)] |= kIsInlier;
  }
  if (solution.match_weights.empty()) return stages;
  stages.weights.resize(num_matches);
  for (std::size_t k = 0; k < solution.consistent.size(); ++k) {
    stages.weights[static_cast<std::size_t>(solution.consistent[k])] =
        solution.match_weights[k];
  }
  return stages;
}

StageCounts CountStages(const MatchStages& stages,
                        const std::vector<bool>& is_counted) {
  StageCounts counts;
  for (std::size_t i = 0; i < stages.fates.size(); ++i) {
    if (!is_counted.empty() && !is_counted[i]) continue;
    ++counts.matches;
    if (stages.fates[i] & kIsConsistent) ++counts.consistent;
    if (stages.fates[i] & kIsInlier) ++counts.inliers;
    if (!stages.weights.empty() && stages.weights[i] >= 0.5) ++counts.weighted;
  }
  return counts;
}

}  // namespace quatro
