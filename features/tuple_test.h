// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The tuple test of FGR: a match is kept if, in one of the random triples it is
// drawn into, the three sides agree in length,
//
//   s < |p_a - p_b| / |q_a - q_b| < 1/s   for all three sides.             (1)
//
// Source: Zhou, Park and Koltun, "Fast Global Registration", ECCV 2016.

#ifndef QUATRO_FEATURES_TUPLE_TEST_H_
#define QUATRO_FEATURES_TUPLE_TEST_H_

#include <cstdint>
#include <string>
#include <vector>

#include "features/base/types.h"
#include "features/matching.h"

namespace quatro {

// How strict (1) is, and how many triples are tried.
struct TupleTestOptions {
  double scale = 0.95;  // s in (1), in (0, 1).
  int num_triples_per_match = 100;

  // Stop once so many triples have passed; 0: never. The program of the paper's
  // authors stops at 1000, and gives a match as often as triples with it
  // passed.
  std::int64_t max_num_triples = 0;

  std::uint64_t seed = 0;

  // 0: one per core. The answer is the same for any number; where triples are
  // counted, one does all.
  int num_threads = 1;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// The matches that pass, in their order. Fewer than three are returned as they
// are: there is no triple to test them in.
std::vector<Match> FilterByTupleTest(const std::vector<Match>& matches,
                                     const PointsRef& source,
                                     const PointsRef& target,
                                     const TupleTestOptions& options);

}  // namespace quatro

#endif  // QUATRO_FEATURES_TUPLE_TEST_H_
