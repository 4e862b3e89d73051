// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// From all matches to those that hold together: the consistency graph and a
// large set of mutually consistent vertices in it.

#ifndef QUATRO_ROBUST_ESTIMATORS_PRUNING_H_
#define QUATRO_ROBUST_ESTIMATORS_PRUNING_H_

#include <string>
#include <vector>

#include "features/base/stopwatch.h"
#include "robust/estimators/distinct_matches.h"
#include "robust/graph/consistency_graph.h"

namespace quatro {

// How the consistent matches are found.
enum class Pruning {
  kCliqueHeuristic,  // The paper's MCIS-heuristic.
  kExactClique,      // Branch and bound, until a time limit.
  kMaxCore,
  kNone,
};

// The way, the test and the time for it.
struct PruningOptions {
  Pruning method = Pruning::kCliqueHeuristic;
  ConsistencyOptions consistency;
  double time_limit_seconds = 1.0;  // For kExactClique.

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// Columns of `matches`, in ascending order. Appends the stages' times.
std::vector<Eigen::Index> FindConsistent(const DistinctMatches& matches,
                                         const PruningOptions& options,
                                         int num_threads,
                                         std::vector<StageTime>* stage_times);

}  // namespace quatro

#endif  // QUATRO_ROBUST_ESTIMATORS_PRUNING_H_
