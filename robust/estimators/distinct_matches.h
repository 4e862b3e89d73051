// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Matches in an order of their own: copies of one match taken together, the
// rest shuffled by a hash of the coordinates. What is computed from them
// depends on neither the order nor the repetition of the input, and neighbours
// in this order are no neighbours in space, so differences between them are
// long.
//
// The hash is the same for (p, q) and (q, p): swapping source and target keeps
// the order.

#ifndef QUATRO_ROBUST_ESTIMATORS_DISTINCT_MATCHES_H_
#define QUATRO_ROBUST_ESTIMATORS_DISTINCT_MATCHES_H_

#include <Eigen/Core>
#include <vector>

#include "features/base/types.h"

namespace quatro {

// Matches without copies, in an order of their own.
struct DistinctMatches {
  Points source;
  Points target;
  // Columns of the input that column k stands for.
  std::vector<std::vector<Eigen::Index>> columns;
};

// Of matches column by column.
DistinctMatches FindDistinctMatches(const PointsRef& source,
                                    const PointsRef& target);

// The input columns that the given distinct matches stand for, in ascending
// order.
std::vector<Eigen::Index> InputColumns(
    const DistinctMatches& matches, const std::vector<Eigen::Index>& selected);

// The values of the given distinct matches, in the order of InputColumns().
std::vector<double> InputValues(const DistinctMatches& matches,
                                const std::vector<Eigen::Index>& selected,
                                const std::vector<double>& values);

// The given columns of `points`, in that order.
Points Columns(const PointsRef& points,
               const std::vector<Eigen::Index>& columns);

}  // namespace quatro

#endif  // QUATRO_ROBUST_ESTIMATORS_DISTINCT_MATCHES_H_
