// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <bit>
#include <vector>

#include "robust/graph/consistency_graph.h"
#include "robust/graph/exact_clique.h"
#include "robust/graph/max_clique.h"
#include "tests/properties/lattice.h"

namespace quatro::cliques_test {
namespace {

Graph AnyGraph(int num_vertices) {
  Graph graph(num_vertices);
  for (int i = 0; i < num_vertices; ++i) {
    for (int j = 0; j < i; ++j) {
      if (*rc::gen::arbitrary<bool>()) graph.AddEdge(i, j);
    }
  }
  return graph;
}

bool IsClique(const Graph& graph, const std::vector<int>& vertices) {
  for (const int i : vertices) {
    for (const int j : vertices) {
      if (i != j && !graph.HasEdge(i, j)) return false;
    }
  }
  return std::is_sorted(vertices.begin(), vertices.end()) &&
         std::adjacent_find(vertices.begin(), vertices.end()) == vertices.end();
}

int LargestByBruteForce(const Graph& graph) {
  int largest = 0;
  for (unsigned subset = 0; subset < (1u << graph.num_vertices()); ++subset) {
    std::vector<int> vertices;
    for (int i = 0; i < graph.num_vertices(); ++i) {
      if ((subset >> i) & 1u) vertices.push_back(i);
    }
    if (std::popcount(subset) > largest && IsClique(graph, vertices)) {
      largest = std::popcount(subset);
    }
  }
  return largest;
}

RC_GTEST_PROP(CliqueProperty, GreedyIsOneAndExactIsTheLargest, ()) {
  const Graph graph = AnyGraph(*Whole(0, 9));
  const int largest = LargestByBruteForce(graph);
  const std::vector<int> greedy = FindCliqueGreedily(graph);
  RC_ASSERT(IsClique(graph, greedy));
  RC_ASSERT(static_cast<int>(greedy.size()) <= largest);
  RC_ASSERT(greedy.empty() == (graph.num_vertices() == 0));
  const ExactCliqueSummary exact = FindMaximumClique(graph, {});
  RC_ASSERT(IsClique(graph, exact.clique));
  RC_ASSERT(static_cast<int>(exact.clique.size()) == largest);
  RC_ASSERT(DecomposeCores(graph).max_core + 1 >= largest);
}

// On a lattice with copies and ties; a quarter turn and a shift of the target
// are without rounding, so that no edge may change.
RC_GTEST_PROP(ConsistencyProperty, MotionsOfTheTargetKeepEveryEdge, ()) {
  const auto n = *NumUpTo(0, 11);
  const Points source = LatticePoints(n), target = LatticePoints(n);
  ConsistencyOptions options;
  options.test = *rc::gen::element(ConsistencyTest::kLength,
                                   ConsistencyTest::kPlanar,
                                   ConsistencyTest::kPlanarAndHeight);
  options.bound = 0.5 * *Whole(1, 4) + 0.01;
  const Graph graph = BuildConsistencyGraph(source, target, options, 1);
  const int turns = *Whole(0, 3);
  const Points moved =
      TurnedByQuarters(target, turns).colwise() + Eigen::Vector3d(8, -16, 4);
  const Graph again = BuildConsistencyGraph(source, moved, options, 3);
  const Graph swapped = BuildConsistencyGraph(moved, source, options, 1);
  for (int i = 0; i < graph.num_vertices(); ++i) {
    for (int j = 0; j < i; ++j) {
      RC_ASSERT(graph.HasEdge(i, j) == graph.HasEdge(j, i));
      RC_ASSERT(graph.HasEdge(i, j) == again.HasEdge(i, j));
      RC_ASSERT(graph.HasEdge(i, j) == swapped.HasEdge(i, j));
    }
  }
}

}  // namespace
}  // namespace quatro::cliques_test
