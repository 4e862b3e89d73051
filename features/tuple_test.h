// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The tuple test of FGR draws random triples of matches. It keeps a match if,
// in at least one of its triples, the three sides have consistent lengths,
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

// The strictness of (1) and the number of triples.
struct TupleTestOptions {
  double scale = 0.95;  // s in (1), in (0, 1).
  int num_triples_per_match = 100;

  // Stop once this many triples have passed; 0 means never. The original code
  // of the paper stops at 1000, and returns a match once per triple that
  // passed.
  std::int64_t max_num_triples = 0;

  std::uint64_t seed = 0;

  // 0: one per core. The result does not depend on the number of threads. With
  // max_num_triples > 0 only one thread is used.
  int num_threads = 1;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// Returns the matches that pass, in their order. Fewer than three matches are
// returned unchanged, because they form no triple.
std::vector<Match> FilterByTupleTest(const std::vector<Match>& matches,
                                     const PointsRef& source,
                                     const PointsRef& target,
                                     const TupleTestOptions& options);

}  // namespace quatro

#endif  // QUATRO_FEATURES_TUPLE_TEST_H_
