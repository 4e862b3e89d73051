// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/estimators/pruning.h"

#include <numeric>

#include "robust/graph/consistency_graph.h"
#include "robust/graph/exact_clique.h"
#include "robust/graph/max_clique.h"

namespace quatro {

bool PruningOptions::IsValid(std::string* error) const {
  ExactCliqueOptions exact;
  exact.time_limit_seconds = time_limit_seconds;
  return consistency.IsValid(error) && exact.IsValid(error);
}

std::vector<Eigen::Index> FindConsistent(const DistinctMatches& matches,
                                         const PruningOptions& options,
                                         int num_threads,
                                         std::vector<StageTime>* stage_times) {
  if (options.method == Pruning::kNone) {
    std::vector<Eigen::Index> all(
        static_cast<std::size_t>(matches.source.cols()));
    std::iota(all.begin(), all.end(), 0);
    return all;
  }

  Stopwatch stopwatch;
  const Graph graph = BuildConsistencyGraph(
      matches.source, matches.target, options.consistency, num_threads);
  stage_times->push_back({"graph", stopwatch.Lap()});
  std::vector<int> vertices;
  if (options.method == Pruning::kExactClique) {
    ExactCliqueOptions exact;
    exact.time_limit_seconds = options.time_limit_seconds;
    vertices = FindMaximumClique(graph, exact).clique;
  } else if (options.method == Pruning::kMaxCore) {
    vertices = FindMaxCore(graph);
    // Without edges every vertex is in the core, but no two are consistent.
    if (!vertices.empty() && graph.Degree(vertices.front()) == 0) {
      vertices.erase(vertices.begin() + 1, vertices.end());
    }
  } else {
    vertices = FindCliqueGreedily(graph);
  }
  stage_times->push_back({"clique", stopwatch.Lap()});
  return {vertices.begin(), vertices.end()};
}

}  // namespace quatro
