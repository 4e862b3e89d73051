// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Correspondences between two clouds by their descriptors.
//
// (i, j) match iff j is the nearest to i among the target's descriptors and i
// the nearest to j among the source's; of equal distances the lower index wins.
// All-zero descriptors match nothing, nor do those at a distance that single
// precision does not hold. Distances are equation (1) of
// features/descriptor_index.h, to the last bit.

#ifndef QUATRO_FEATURES_MATCHING_H_
#define QUATRO_FEATURES_MATCHING_H_

#include <cstdint>
#include <vector>

#include "features/base/simd.h"
#include "features/fpfh.h"

namespace quatro {

// Columns of the two clouds that belong together.
struct Match {
  std::int32_t source = 0;
  std::int32_t target = 0;

  // Equal where both columns are.
  friend bool operator==(const Match&, const Match&) = default;
};

// In ascending order of `source`.
std::vector<Match> MatchMutualNearest(const Fpfh& source,
                                      const Fpfh& target,
                                      int num_threads);

// The same by one instruction set, no more than BestSimdLevel().
std::vector<Match> MatchMutualNearest(const Fpfh& source,
                                      const Fpfh& target,
                                      int num_threads,
                                      SimdLevel level);

}  // namespace quatro

#endif  // QUATRO_FEATURES_MATCHING_H_
