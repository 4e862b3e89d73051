// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Which matches outlive which stage of a method.

#ifndef QUATRO_EXPERIMENTS_REPORT_MATCH_STAGES_H_
#define QUATRO_EXPERIMENTS_REPORT_MATCH_STAGES_H_

#include <vector>

#include "robust/registration/registration.h"

namespace quatro {

// Bits of a match's fate. One that agrees with the pose need not be consistent:
// the pose is judged on all of them.
inline constexpr int kIsConsistent = 1;
inline constexpr int kIsInlier = 2;

struct MatchStages {
  std::vector<int> fates;  // Of each match.

  // Of each match, in [0, 1], 0 of those that are not consistent
  // (PoseSummary::match_weights). Empty if the method has none.
  std::vector<double> weights;
};

MatchStages FindMatchStages(const RegistrationSummary& summary);

struct StageCounts {
  long matches = 0;
  long consistent = 0;
  long weighted = 0;  // Of weight 0.5 or more.
  long inliers = 0;
};

// Of the matches for which `is_counted`, or of all if it is empty.
StageCounts CountStages(const MatchStages& stages,
                        const std::vector<bool>& is_counted);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_REPORT_MATCH_STAGES_H_
