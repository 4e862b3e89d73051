// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Correspondences between two clouds by their descriptors.
//
// (i, j) match iff j is the nearest to i among the target's descriptors and i
// the nearest to j among the source's; of equal distances the lower index wins.
// All-zero descriptors match nothing.

#ifndef QUATRO_FEATURES_MATCHING_H_
#define QUATRO_FEATURES_MATCHING_H_

#include <cstdint>
#include <vector>

#include "features/fpfh.h"

namespace quatro {

struct Match {
  std::int32_t source = 0;
  std::int32_t target = 0;
  friend bool operator==(const Match&, const Match&) = default;
};

// In ascending order of `source`.
std::vector<Match> MatchMutualNearest(const Fpfh& source,
                                      const Fpfh& target,
                                      int num_threads);

}  // namespace quatro

#endif  // QUATRO_FEATURES_MATCHING_H_
