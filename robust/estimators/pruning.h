// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Pruning: the consistency graph of the matches,
//
//   edge (i, j)  iff  matches i and j are consistent
//                     (robust/graph/consistency_test.h),
//
// and a large set of mutually consistent matches in it.

#ifndef QUATRO_ROBUST_ESTIMATORS_PRUNING_H_
#define QUATRO_ROBUST_ESTIMATORS_PRUNING_H_

#include <string>
#include <vector>

#include "features/base/stopwatch.h"
#include "robust/estimators/distinct_matches.h"
#include "robust/graph/consistency_test.h"

namespace quatro {

// How the consistent set is found.
enum class Pruning {
  kCliqueHeuristic,  // The paper's MCIS heuristic.
  kExactClique,      // Branch and bound with a time limit.
  kMaxCore,          // The vertices with the largest core number.
  kNone,
};

// The method, the consistency test and the time limit.
struct PruningOptions {
  Pruning method = Pruning::kCliqueHeuristic;
  ConsistencyOptions consistency;
  double time_limit_seconds = 1.0;  // For kExactClique [s].

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// Returns columns of `matches` in ascending order, and appends the times of the
// stages. Empty if there are no matches.
std::vector<Eigen::Index> FindConsistent(const DistinctMatches& matches,
                                         const PruningOptions& options,
                                         int num_threads,
                                         std::vector<StageTime>* stage_times);

}  // namespace quatro

#endif  // QUATRO_ROBUST_ESTIMATORS_PRUNING_H_
