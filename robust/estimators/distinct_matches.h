// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Distinct matches in an order that does not depend on the order of the input:
// copies of a match (p, q) are merged, and the matches are sorted by a hash of
// their coordinates. So results that are computed from them depend neither on
// the order nor on the repetition of the input. Neighbors in this order are
// usually not neighbors in space, so differences between them are long.
//
// The hash is the same for (p, q) and (q, p), so swapping source and target
// keeps the order.

#ifndef QUATRO_ROBUST_ESTIMATORS_DISTINCT_MATCHES_H_
#define QUATRO_ROBUST_ESTIMATORS_DISTINCT_MATCHES_H_

#include <Eigen/Core>
#include <vector>

#include "features/base/types.h"

namespace quatro {

// Matches without copies, in the order of their hashes.
struct DistinctMatches {
  Points source;
  Points target;
  // The columns of the input that are copies of column k.
  std::vector<std::vector<Eigen::Index>> columns;
};

// Column i of `source` is matched with column i of `target` [m].
DistinctMatches FindDistinctMatches(const PointsRef& source,
                                    const PointsRef& target);

// Also leaves out the matches whose coordinates a double cannot resolve to the
// noise bound [m] (robust/graph/far_matches.h).
DistinctMatches FindDistinctMatches(const PointsRef& source,
                                    const PointsRef& target,
                                    double noise_bound);

// The input columns of the given distinct matches and their copies, in
// ascending order.
std::vector<Eigen::Index> InputColumns(
    const DistinctMatches& matches, const std::vector<Eigen::Index>& selected);

// The values of the given distinct matches, repeated for each copy, in the
// order of InputColumns().
std::vector<double> InputValues(const DistinctMatches& matches,
                                const std::vector<Eigen::Index>& selected,
                                const std::vector<double>& values);

// The given columns of `points`, in that order.
Points Columns(const PointsRef& points,
               const std::vector<Eigen::Index>& columns);

}  // namespace quatro

#endif  // QUATRO_ROBUST_ESTIMATORS_DISTINCT_MATCHES_H_
