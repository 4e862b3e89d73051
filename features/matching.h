// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Correspondences between two clouds by their descriptors.
//
// (i, j) match iff j is the nearest to i among the target's descriptors and i
// the nearest to j among the source's; of equal distances the lower index wins.
// All-zero descriptors match nothing.
//
// The tuple test of FGR then keeps a match if, in one of the random triples it
// is drawn into, the three sides agree in length,
//
//   s < |p_a - p_b| / |q_a - q_b| < 1/s   for all three sides.             (1)
//
// Source: Zhou, Park and Koltun, "Fast Global Registration", ECCV 2016.

#ifndef QUATRO_FEATURES_MATCHING_H_
#define QUATRO_FEATURES_MATCHING_H_

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "features/fpfh.h"
#include "features/types.h"

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

struct TupleTestOptions {
  double scale = 0.95;  // s in (1), in (0, 1).
  int num_triples_per_match = 100;
  std::uint64_t seed = 0;

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

#endif  // QUATRO_FEATURES_MATCHING_H_
