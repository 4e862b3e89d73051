// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The stages of a method that each match passes.

#ifndef QUATRO_EXPERIMENTS_REPORT_MATCH_STAGES_H_
#define QUATRO_EXPERIMENTS_REPORT_MATCH_STAGES_H_

#include <vector>

#include "robust/registration/registration.h"

namespace quatro {

// Flags of a match, combined in its fate. An inlier of the pose need not be in
// the consistent set, because the pose is evaluated on all matches.
inline constexpr int kIsConsistent = 1;
inline constexpr int kIsInlier = 2;

struct MatchStages {
  std::vector<int> fates;  // Per match.

  // Per match, in [0, 1]; 0 for matches that are not consistent
  // (PoseSummary::match_weights). Empty if the method has no weights.
  std::vector<double> weights;
};

MatchStages FindMatchStages(const RegistrationSummary& summary);

struct StageCounts {
  long matches = 0;
  long consistent = 0;
  long weighted = 0;  // With weight >= 0.5.
  long inliers = 0;
};

// Counts the matches for which `is_counted` is set, or all if it is empty.
StageCounts CountStages(const MatchStages& stages,
                        const std::vector<bool>& is_counted);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_REPORT_MATCH_STAGES_H_
