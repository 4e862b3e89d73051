// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/graph/max_clique.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "features/base/random.h"
#include "tests/support/random_problems.h"

namespace quatro::max_clique_test {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

Graph RandomGraph(int n, double density, std::uint64_t seed) {
  Random random(seed);
  Graph graph(n);
  for (int i = 1; i < n; ++i) {
    for (int j = 0; j < i; ++j) {
      if (random.Uniform() < density) graph.AddEdge(i, j);
    }
  }
  return graph;
}

Graph CompleteGraph(int n) { return RandomGraph(n, 1.0, 0); }

Graph GraphOf(int n, const std::vector<std::pair<int, int>>& edges) {
  Graph graph(n);
  for (const auto& [i, j] : edges) graph.AddEdge(i, j);
  return graph;
}

void AddClique(const std::vector<int>& vertices, Graph* graph) {
  for (const int i : vertices) {
    for (const int j : vertices) {
      if (i < j) graph->AddEdge(i, j);
    }
  }
}

bool IsClique(const Graph& graph, const std::vector<int>& vertices) {
  for (const int i : vertices) {
    for (const int j : vertices) {
      if (i != j && !graph.HasEdge(i, j)) return false;
    }
  }
  return true;
}

// By definition: repeatedly removing all vertices with fewer than k remaining
// neighbors leaves the vertices with core numbers of at least k.
std::vector<int> CoreNumbersByDefinition(const Graph& graph) {
  const int n = graph.num_vertices();
  std::vector<int> core(static_cast<std::size_t>(n), 0);
  for (int k = 1; k < n; ++k) {
    std::vector<bool> is_left(static_cast<std::size_t>(n), true);
    for (bool changes = true; changes;) {
      changes = false;
      for (int i = 0; i < n; ++i) {
        if (!is_left[static_cast<std::size_t>(i)]) continue;
        int degree = 0;
        graph.ForEachNeighbor(
            i, [&](int j) { degree += is_left[static_cast<std::size_t>(j)]; });
        if (degree < k) {
          is_left[static_cast<std::size_t>(i)] = false;
          changes = true;
        }
      }
    }
    for (std::size_t i = 0; i < core.size(); ++i) {
      if (is_left[i]) core[i] = k;
    }
  }
  return core;
}

std::size_t LargestCliqueOfAllSubsets(const Graph& graph) {
  const auto n = static_cast<unsigned>(graph.num_vertices());
  std::size_t largest = 0;
  for (unsigned subset = 0; subset < 1u << n; ++subset) {
    if (static_cast<std::size_t>(std::popcount(subset)) <= largest) continue;
    std::vector<int> vertices;
    for (unsigned i = 0; i < n; ++i) {
      if (subset >> i & 1u) vertices.push_back(static_cast<int>(i));
    }
    if (IsClique(graph, vertices)) largest = vertices.size();
  }
  return largest;
}

TEST(DecomposeCores, AgreesWithTheDefinition) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const Graph graph = RandomGraph(static_cast<int>(20 + 5 * seed),
                                    0.02 + 0.03 * static_cast<double>(seed),
                                    seed);
    const CoreDecomposition cores = DecomposeCores(graph);
    const auto expected = CoreNumbersByDefinition(graph);
    EXPECT_EQ(cores.core_number, expected) << "seed " << seed;
    EXPECT_EQ(cores.max_core,
              *std::max_element(expected.begin(), expected.end()))
        << "seed " << seed;
  }
}

TEST(DecomposeCores, PeelsEveryVertexOnceLowestFirst) {
  const Graph graph = RandomGraph(150, 0.2, 1);
  const CoreDecomposition cores = DecomposeCores(graph);
  std::vector<int> vertices = cores.order;
  std::sort(vertices.begin(), vertices.end());
  std::vector<int> all(150);
  std::iota(all.begin(), all.end(), 0);
  EXPECT_EQ(vertices, all);
  // When a vertex is removed, at most as many neighbors as its core number
  // remain.
  std::vector<bool> is_peeled(150, false);
  int previous = 0;
  for (const int i : cores.order) {
    const int core = cores.core_number[static_cast<std::size_t>(i)];
    EXPECT_GE(core, previous) << "vertex " << i;
    previous = core;
    int num_left = 0;
    graph.ForEachNeighbor(
        i, [&](int j) { num_left += !is_peeled[static_cast<std::size_t>(j)]; });
    EXPECT_LE(num_left, core) << "vertex " << i;
    is_peeled[static_cast<std::size_t>(i)] = true;
  }
}

TEST(DecomposeCores, OfKnownGraphs) {
  const Graph cycle = GraphOf(5, {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 0}});
  EXPECT_THAT(DecomposeCores(cycle).core_number, Each(2));
  const Graph tree = GraphOf(6, {{0, 1}, {0, 2}, {0, 3}, {3, 4}, {3, 5}});
  EXPECT_THAT(DecomposeCores(tree).core_number, Each(1));
  EXPECT_THAT(DecomposeCores(CompleteGraph(70)).core_number, Each(69));
  EXPECT_THAT(DecomposeCores(Graph(4)).core_number, Each(0));
  // A triangle with a tail, and an isolated vertex.
  const Graph mixed = GraphOf(6, {{0, 1}, {1, 2}, {2, 0}, {2, 3}, {3, 4}});
  EXPECT_THAT(DecomposeCores(mixed).core_number, ElementsAre(2, 2, 2, 1, 1, 0));
}

TEST(DecomposeCores, OfNoVertices) {
  const CoreDecomposition cores = DecomposeCores(Graph(0));
  EXPECT_THAT(cores.core_number, IsEmpty());
  EXPECT_THAT(cores.order, IsEmpty());
  EXPECT_EQ(cores.max_core, 0);
}

TEST(FindCliqueGreedily, AnswersWithAClique) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const Graph graph = RandomGraph(static_cast<int>(50 + 3 * seed),
                                    0.1 + 0.02 * static_cast<double>(seed),
                                    seed);
    const auto clique = FindCliqueGreedily(graph);
    EXPECT_TRUE(IsClique(graph, clique)) << "seed " << seed;
    EXPECT_TRUE(std::ranges::is_sorted(clique)) << "seed " << seed;
    EXPECT_LE(static_cast<int>(clique.size()),
              DecomposeCores(graph).max_core + 1)
        << "seed " << seed;
  }
}

TEST(FindCliqueGreedily, IsNeverAboveAndMostlyAtTheOptimum) {
  int num_optimal = 0;
  constexpr int kNumGraphs = 60;
  for (std::uint64_t seed = 0; seed < kNumGraphs; ++seed) {
    const Graph graph = RandomGraph(
        13, 0.2 + 0.7 * static_cast<double>(seed) / kNumGraphs, seed);
    const std::size_t greedy = FindCliqueGreedily(graph).size();
    const std::size_t optimum = LargestCliqueOfAllSubsets(graph);
    EXPECT_LE(greedy, optimum) << "seed " << seed;
    EXPECT_GE(greedy + 1, optimum) << "seed " << seed;
    num_optimal += greedy == optimum;
  }
  EXPECT_GE(num_optimal, kNumGraphs * 9 / 10);
}

TEST(FindCliqueGreedily, CannotBeExtended) {
  const Graph graph = RandomGraph(120, 0.4, 5);
  const auto clique = FindCliqueGreedily(graph);
  EXPECT_GE(clique.size(), 5u);
  EXPECT_LE(clique.size(), 20u);
  for (int i = 0; i < graph.num_vertices(); ++i) {
    if (std::ranges::binary_search(clique, i)) continue;
    std::vector<int> larger = clique;
    larger.push_back(i);
    EXPECT_FALSE(IsClique(graph, larger)) << "vertex " << i;
  }
}

TEST(FindCliqueGreedily, FindsAPlantedClique) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Graph graph = RandomGraph(200, 0.3, seed);
    std::vector<int> planted;
    for (const Eigen::Index i : RandomPermutation(200, seed)) {
      if (planted.size() < 20) planted.push_back(static_cast<int>(i));
    }
    AddClique(planted, &graph);
    std::sort(planted.begin(), planted.end());
    EXPECT_THAT(FindCliqueGreedily(graph), ::testing::IsSupersetOf(planted))
        << "seed " << seed;
  }
}

TEST(FindCliqueGreedily, OfDisjointCliquesTakesTheLargest) {
  Graph graph(200);
  AddClique({0, 1, 2, 3, 4}, &graph);
  AddClique({10, 66, 67, 130, 131, 199}, &graph);
  AddClique({50, 51, 52}, &graph);
  EXPECT_THAT(FindCliqueGreedily(graph),
              ElementsAre(10, 66, 67, 130, 131, 199));
}

TEST(FindCliqueGreedily, LooksBelowTheHighestCoreToo) {
  // A complete bipartite graph of five and five vertices has core number five
  // and no clique above two; the triangle has core number two.
  Graph graph(13);
  for (int i = 0; i < 5; ++i) {
    for (int j = 5; j < 10; ++j) graph.AddEdge(i, j);
  }
  AddClique({10, 11, 12}, &graph);
  EXPECT_THAT(FindCliqueGreedily(graph), ElementsAre(10, 11, 12));
  EXPECT_THAT(FindMaxCore(graph), SizeIs(10));
}

TEST(FindCliqueGreedily, OfAllEdgesIsEverythingAndOfNoneOneVertex) {
  EXPECT_THAT(FindCliqueGreedily(CompleteGraph(64)), SizeIs(64));
  EXPECT_THAT(FindCliqueGreedily(CompleteGraph(129)), SizeIs(129));
  EXPECT_THAT(FindCliqueGreedily(Graph(7)), SizeIs(1));
  EXPECT_THAT(FindCliqueGreedily(Graph(1)), ElementsAre(0));
  EXPECT_THAT(FindCliqueGreedily(Graph(0)), IsEmpty());
}

TEST(FindMaxCore, HoldsTheVerticesOfTheLargestCoreNumber) {
  const Graph graph = RandomGraph(100, 0.1, 3);
  const CoreDecomposition cores = DecomposeCores(graph);
  std::vector<int> expected;
  for (int i = 0; i < 100; ++i) {
    if (cores.core_number[static_cast<std::size_t>(i)] == cores.max_core) {
      expected.push_back(i);
    }
  }
  EXPECT_EQ(FindMaxCore(graph), expected);
  EXPECT_LT(expected.size(), 100u);
  EXPECT_GT(expected.size(), static_cast<std::size_t>(cores.max_core));
}

TEST(FindMaxCore, HoldsAPlantedClique) {
  Graph graph = RandomGraph(200, 0.05, 4);
  const std::vector<int> planted = {3,
                                    17,
                                    40,
                                    63,
                                    64,
                                    90,
                                    91,
                                    128,
                                    150,
                                    151,
                                    152,
                                    160,
                                    170,
                                    171,
                                    180,
                                    190,
                                    195,
                                    199};
  AddClique(planted, &graph);
  EXPECT_THAT(FindMaxCore(graph), ::testing::IsSupersetOf(planted));
}

TEST(FindMaxCore, OfNoVerticesIsEmpty) {
  EXPECT_THAT(FindMaxCore(Graph(0)), IsEmpty());
}

}  // namespace
}  // namespace quatro::max_clique_test
