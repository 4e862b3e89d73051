// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Matches two clouds by their descriptors.
//
// Descriptor i of the source and j of the target match iff j is the target's
// nearest to i and i is the source's nearest to j. If distances are equal, the
// lower index wins. Descriptors that are all zero, not finite, or at a distance
// that overflows single precision have no match. Distances are (1) of
// features/descriptor_index.h, bit for bit.

#ifndef QUATRO_FEATURES_MATCHING_H_
#define QUATRO_FEATURES_MATCHING_H_

#include <cstdint>
#include <vector>

#include "features/base/simd.h"
#include "features/fpfh.h"

namespace quatro {

// A column of the source and the column of the target that it matches.
struct Match {
  std::int32_t source = 0;
  std::int32_t target = 0;

  // Equal if both columns are equal.
  friend bool operator==(const Match&, const Match&) = default;
};

// Column i of `source` is matched with column i of `target` [m].
struct MatchedPoints {
  Points source;
  Points target;
};

// Returns all mutual nearest neighbors in ascending order of `source`.
std::vector<Match> MatchMutualNearest(const Fpfh& source,
                                      const Fpfh& target,
                                      int num_threads);

// Computes the matches with a given instruction set, which must not exceed
// BestSimdLevel(). The result is the same at every level.
std::vector<Match> MatchMutualNearest(const Fpfh& source,
                                      const Fpfh& target,
                                      int num_threads,
                                      SimdLevel level);

// The given matches, followed by those of `num_rounds` more rounds. Each round
// matches the descriptors that have no match yet. The second and third rounds
// are less reliable than the first, MatchMutualNearest(), but double the number
// of correct matches where few are correct.
std::vector<Match> MatchInRounds(const std::vector<Match>& matches,
                                 const Fpfh& source,
                                 const Fpfh& target,
                                 int num_rounds,
                                 int num_threads);

}  // namespace quatro

#endif  // QUATRO_FEATURES_MATCHING_H_
