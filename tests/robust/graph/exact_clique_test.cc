// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/graph/exact_clique.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string>
#include <tuple>
#include <vector>

#include "features/base/random.h"
#include "robust/graph/consistency_graph.h"
#include "robust/graph/max_clique.h"
#include "tests/support/random_problems.h"

namespace quatro::exact_clique_test {
namespace {

// Options without early stops: the result is the maximum clique.
ExactCliqueOptions Exact() {
  ExactCliqueOptions options;
  options.time_limit_seconds = std::numeric_limits<double>::infinity();
  options.near_clique_ratio = 1.0;
  return options;
}

MATCHER_P(IsCliqueIn, graph, "") {
  const std::vector<int>& clique = arg;
  for (std::size_t i = 0; i < clique.size(); ++i) {
    if (clique[i] < 0 || clique[i] >= graph.get().num_vertices()) {
      *result_listener << "there is no vertex " << clique[i];
      return false;
    }
    if (i > 0 && clique[i - 1] >= clique[i]) {
      *result_listener << clique[i] << " follows " << clique[i - 1];
      return false;
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (graph.get().HasEdge(clique[i], clique[j])) continue;
      *result_listener << clique[j] << " and " << clique[i] << " have no edge";
      return false;
    }
  }
  return true;
}

// Properties of every result, and of one that is reported as optimal.
void ExpectSound(const Graph& graph, const ExactCliqueSummary& summary) {
  SCOPED_TRACE(summary.message);
  const int size = static_cast<int>(summary.clique.size());
  EXPECT_THAT(summary.clique, IsCliqueIn(std::cref(graph)));
  EXPECT_LE(size, summary.upper_bound);
  EXPECT_EQ(summary.is_optimal, size == summary.upper_bound);
  EXPECT_EQ(summary.is_optimal,
            summary.termination == ExactCliqueTermination::kOptimal);
}

void ExpectMaximum(const Graph& graph, int size) {
  const ExactCliqueSummary summary = FindMaximumClique(graph, Exact());
  ExpectSound(graph, summary);
  EXPECT_TRUE(summary.is_optimal) << summary.message;
  EXPECT_EQ(summary.clique.size(), static_cast<std::size_t>(size));
}

Graph RandomGraph(int n, double density, std::uint64_t seed) {
  Random random(seed);
  Graph graph(n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < i; ++j) {
      if (random.Uniform() < density) graph.AddEdge(i, j);
    }
  }
  return graph;
}

// The DIMACS graphs hamming and johnson: vertices are words of `num_bits` bits
// with `weight` ones (any number if negative), and words that differ in at
// least `distance` bits are adjacent.
Graph WordGraph(int num_bits, int distance, int weight) {
  std::vector<unsigned> words;
  for (unsigned word = 0; word < 1u << num_bits; ++word) {
    if (weight < 0 || std::popcount(word) == weight) words.push_back(word);
  }
  Graph graph(static_cast<int>(words.size()));
  for (std::size_t i = 0; i < words.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (std::popcount(words[i] ^ words[j]) >= distance) {
        graph.AddEdge(static_cast<int>(i), static_cast<int>(j));
      }
    }
  }
  return graph;
}

void AddClique(const std::vector<int>& vertices, Graph* graph) {
  for (const int i : vertices) {
    for (const int j : vertices) {
      if (i < j) graph->AddEdge(i, j);
    }
  }
}

std::vector<int> Range(int begin, int end) {
  std::vector<int> range(static_cast<std::size_t>(end - begin));
  std::iota(range.begin(), range.end(), begin);
  return range;
}

// A copy of `graph` with vertex i renamed name[i].
Graph Relabelled(const Graph& graph, const std::vector<Eigen::Index>& name) {
  Graph relabelled(graph.num_vertices());
  for (int i = 0; i < graph.num_vertices(); ++i) {
    graph.ForEachNeighbor(i, [&](int j) {
      relabelled.AddEdge(static_cast<int>(name[static_cast<std::size_t>(i)]),
                         static_cast<int>(name[static_cast<std::size_t>(j)]));
    });
  }
  return relabelled;
}

// Matches with a given share of inliers, which have normal noise of `sigma`
// [m]; the outliers pair points at random.
Graph SceneGraph(int n, double inlier_ratio, double sigma, std::uint64_t seed) {
  const Points source = RandomPoints(n, 20.0, seed);
  Points target =
      RandomRotation(seed + 1) * source + RandomPoints(n, sigma, seed + 2);
  const auto num_inliers =
      static_cast<Eigen::Index>(std::lround(inlier_ratio * n));
  target.rightCols(n - num_inliers) =
      RandomPoints(n - num_inliers, 20.0, seed + 3);
  ConsistencyOptions options;
  options.bound = 0.6;
  return BuildConsistencyGraph(source, target, options, 1);
}

// The maximum by trying all sets of vertices. A set is a clique iff it is one
// without its first vertex, and that vertex is adjacent to all others.
int BruteForceCliqueNumber(const Graph& graph) {
  const int n = graph.num_vertices();
  std::vector<std::uint32_t> row(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) {
    graph.ForEachNeighbor(
        i, [&](int j) { row[static_cast<std::size_t>(i)] |= 1u << j; });
  }
  std::vector<char> is_clique(std::size_t{1} << n);
  is_clique[0] = 1;
  int best = 0;
  for (std::uint32_t set = 1; set < is_clique.size(); ++set) {
    const std::uint32_t rest = set & (set - 1);
    const auto first = static_cast<std::size_t>(std::countr_zero(set));
    if (!is_clique[rest] || (rest & ~row[first]) != 0) continue;
    is_clique[set] = 1;
    best = std::max(best, std::popcount(set));
  }
  return best;
}

// Branches on the vertex with the most non-neighbors until the rest is a
// clique.
int CliqueNumberByTwoWayBranching(const std::vector<std::uint64_t>& row,
                                  std::uint64_t candidates) {
  int most = 0;
  int stranger = 0;
  for (std::uint64_t left = candidates; left != 0; left &= left - 1) {
    const int v = std::countr_zero(left);
    const int num_strangers =
        std::popcount(candidates & ~row[static_cast<std::size_t>(v)]) - 1;
    if (num_strangers > most) {
      most = num_strangers;
      stranger = v;
    }
  }
  if (most == 0) return std::popcount(candidates);
  const int with =
      1 + CliqueNumberByTwoWayBranching(
              row, candidates & row[static_cast<std::size_t>(stranger)]);
  // With one non-neighbor each, either of the two can be dropped.
  if (most == 1) return with;
  return std::max(with,
                  CliqueNumberByTwoWayBranching(
                      row, candidates & ~(std::uint64_t{1} << stranger)));
}

double SecondsOf(const Graph& graph,
                 const ExactCliqueOptions& options,
                 ExactCliqueSummary* summary) {
  const auto start = std::chrono::steady_clock::now();
  *summary = FindMaximumClique(graph, options);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start)
      .count();
}

TEST(ExactClique, Hamming) {
  ExpectMaximum(WordGraph(6, 2, -1), 32);
  ExpectMaximum(WordGraph(6, 4, -1), 4);
  ExpectMaximum(WordGraph(8, 2, -1), 128);
  ExpectMaximum(WordGraph(8, 4, -1), 16);
}

TEST(ExactClique, Johnson) {
  ExpectMaximum(WordGraph(8, 4, 2), 4);
  ExpectMaximum(WordGraph(8, 4, 4), 14);
  ExpectMaximum(WordGraph(16, 4, 2), 8);
}

TEST(ExactClique, NoVertices) {
  const ExactCliqueSummary summary = FindMaximumClique(Graph(0), {});
  ExpectSound(Graph(0), summary);
  EXPECT_TRUE(summary.is_optimal);
  EXPECT_EQ(summary.upper_bound, 0);
}

TEST(ExactClique, NoEdges) {
  ExpectMaximum(Graph(1), 1);
  ExpectMaximum(Graph(64), 1);
  ExpectMaximum(Graph(200), 1);
}

TEST(ExactClique, Complete) {
  for (const int n : {2, 63, 64, 65, 300}) {
    Graph graph(n);
    AddClique(Range(0, n), &graph);
    ExpectMaximum(graph, n);
  }
}

TEST(ExactClique, DisjointCliques) {
  Graph graph(150);
  AddClique(Range(0, 40), &graph);
  AddClique(Range(40, 90), &graph);
  AddClique(Range(90, 150), &graph);
  EXPECT_EQ(FindMaximumClique(graph, Exact()).clique, Range(90, 150));
}

// Turan graphs: r groups of equal size up to one vertex; vertices of different
// groups are adjacent.
TEST(ExactClique, Turan) {
  for (const auto& [n, r] : {std::pair{13, 4}, {60, 7}, {128, 2}, {200, 33}}) {
    Graph graph(n);
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < i; ++j) {
        if (i % r != j % r) graph.AddEdge(i, j);
      }
    }
    ExpectMaximum(graph, r);
  }
}

TEST(ExactClique, Planted) {
  Graph graph = RandomGraph(300, 0.5, 1);
  std::vector<int> planted;
  for (const Eigen::Index i : RandomPermutation(300, 2)) {
    if (planted.size() < 30) planted.push_back(static_cast<int>(i));
  }
  AddClique(planted, &graph);
  std::sort(planted.begin(), planted.end());
  const ExactCliqueSummary summary = FindMaximumClique(graph, Exact());
  ExpectSound(graph, summary);
  EXPECT_TRUE(summary.is_optimal);
  EXPECT_EQ(summary.clique, planted);
}

TEST(ExactClique, AgreesWithBruteForce) {
  Random random(3);
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const int n = 1 + static_cast<int>(random.Below(18));
    const double density = 0.1 + 0.85 * random.Uniform();
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", " << n
                                    << " vertices, density " << density);
    const Graph graph = RandomGraph(n, density, seed);
    ExpectMaximum(graph, BruteForceCliqueNumber(graph));
  }
}

// Large enough for re-coloring and conflicts to occur.
TEST(ExactClique, AgreesWithTwoWayBranching) {
  Random random(11);
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    const int n = 30 + static_cast<int>(random.Below(34));
    const double density = 0.1 + 0.88 * random.Uniform();
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", " << n
                                    << " vertices, density " << density);
    const Graph graph = RandomGraph(n, density, seed);
    std::vector<std::uint64_t> row;
    for (int i = 0; i < n; ++i) row.push_back(graph.Row(i)[0]);
    const std::uint64_t all = (std::uint64_t{1} << n) - 1;
    ExpectMaximum(graph, CliqueNumberByTwoWayBranching(row, all));
  }
}

// Small graphs are solved without any branch; these are not.
TEST(ExactClique, BeatsTheGreedyOneWhereThatIsNotTheMaximum) {
  int num_better = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Graph graph = RandomGraph(150, 0.7, seed);
    const ExactCliqueSummary summary = FindMaximumClique(graph, Exact());
    ExpectSound(graph, summary);
    EXPECT_TRUE(summary.is_optimal);
    EXPECT_GT(summary.num_branches, 0);
    const std::size_t greedy = FindCliqueGreedily(graph).size();
    EXPECT_GE(summary.clique.size(), greedy);
    num_better += summary.clique.size() > greedy;
  }
  EXPECT_GE(num_better, 3);
}

TEST(ExactClique, SameCliqueEachTime) {
  const Graph graph = RandomGraph(200, 0.6, 4);
  const ExactCliqueSummary once = FindMaximumClique(graph, Exact());
  for (int i = 0; i < 3; ++i) {
    const ExactCliqueSummary again = FindMaximumClique(graph, Exact());
    EXPECT_EQ(again.clique, once.clique);
    EXPECT_EQ(again.num_branches, once.num_branches);
  }
}

TEST(ExactClique, SizeDoesNotDependOnLabels) {
  for (const double density : {0.2, 0.5, 0.8}) {
    const Graph graph = RandomGraph(120, density, 5);
    const int size =
        static_cast<int>(FindMaximumClique(graph, Exact()).clique.size());
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      ExpectMaximum(Relabelled(graph, RandomPermutation(120, seed)), size);
    }
  }
}

TEST(ExactClique, FewInliers) {
  for (const double sigma : {0.1, 0.2}) {
    const Graph graph = SceneGraph(2000, 0.05, sigma, 6);
    const ExactCliqueSummary summary = FindMaximumClique(graph, {});
    ExpectSound(graph, summary);
    EXPECT_NE(summary.termination, ExactCliqueTermination::kTimeLimit);
    EXPECT_GE(summary.clique.size(), 60u) << summary.message;
  }
}

TEST(ExactClique, KeepsTheTimeLimit) {
  const Graph graph = RandomGraph(1500, 0.9, 7);
  ExactCliqueOptions options = Exact();
  options.time_limit_seconds = 0.2;
  ExactCliqueSummary summary;
  EXPECT_LT(SecondsOf(graph, options, &summary), 0.7);
  ExpectSound(graph, summary);
  EXPECT_FALSE(summary.is_optimal);
  EXPECT_EQ(summary.termination, ExactCliqueTermination::kTimeLimit);
  EXPECT_GE(summary.clique.size(), 30u);
  EXPECT_LT(summary.upper_bound, 1500);
}

TEST(ExactClique, TimeLimitTooShortForAnythingLeavesAClique) {
  const Graph graph = RandomGraph(1000, 0.9, 8);
  ExactCliqueOptions options = Exact();
  options.time_limit_seconds = 1e-9;
  const ExactCliqueSummary summary = FindMaximumClique(graph, options);
  ExpectSound(graph, summary);
  EXPECT_EQ(summary.termination, ExactCliqueTermination::kTimeLimit);
  EXPECT_GE(summary.clique.size(), 20u);
}

// With noise near the bound, most but not all inliers are mutually consistent.
TEST(ExactClique, NearCliqueWayOut) {
  const Graph graph = SceneGraph(3000, 0.5, 0.17, 9);
  ExactCliqueOptions options;
  options.time_limit_seconds = 10.0;
  ExactCliqueSummary summary;
  EXPECT_LT(SecondsOf(graph, options, &summary), 2.0);
  ExpectSound(graph, summary);
  EXPECT_EQ(summary.termination, ExactCliqueTermination::kNearClique)
      << summary.message;
  EXPECT_GE(static_cast<double>(summary.clique.size()),
            options.near_clique_ratio * summary.upper_bound);
  EXPECT_GE(summary.clique.size(), 800u);
  EXPECT_LE(summary.clique.size(), 1500u);
}

TEST(ExactClique, RatioBelowOneHoldsWhatItPromises) {
  ExactCliqueOptions loose = Exact();
  loose.near_clique_ratio = 0.8;
  int num_way_outs = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Graph graph = RandomGraph(80, 0.9, seed);
    const ExactCliqueSummary summary = FindMaximumClique(graph, loose);
    ExpectSound(graph, summary);
    const std::size_t maximum = FindMaximumClique(graph, Exact()).clique.size();
    EXPECT_LE(maximum, static_cast<std::size_t>(summary.upper_bound));
    EXPECT_GE(static_cast<double>(summary.clique.size()),
              0.8 * static_cast<double>(maximum));
    EXPECT_GE(static_cast<double>(summary.clique.size()),
              0.8 * summary.upper_bound);
    num_way_outs += summary.termination == ExactCliqueTermination::kNearClique;
  }
  EXPECT_GE(num_way_outs, 5);
}

TEST(ExactClique, UpperBoundOfAStoppedSearchHolds) {
  const Graph graph = RandomGraph(150, 0.8, 10);
  const int maximum = FindMaximumClique(graph, Exact()).upper_bound;
  for (const double limit : {1e-9, 1e-3, 1e-2, 5e-2}) {
    ExactCliqueOptions options = Exact();
    options.time_limit_seconds = limit;
    const ExactCliqueSummary summary = FindMaximumClique(graph, options);
    ExpectSound(graph, summary);
    EXPECT_GE(summary.upper_bound, maximum) << limit << " s";
    EXPECT_LE(static_cast<int>(summary.clique.size()), maximum);
  }
}

TEST(ExactClique, RefusesInvalidOptionsAndSaysWhich) {
  Graph graph(2);
  graph.AddEdge(0, 1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [limit, ratio, field] :
       {std::tuple{0.0, 0.98, "time_limit_seconds"},
        {nan, 0.98, "time_limit_seconds"},
        {1.0, 0.0, "near_clique_ratio"},
        {1.0, 1.01, "near_clique_ratio"},
        {1.0, nan, "near_clique_ratio"}}) {
    ExactCliqueOptions options;
    options.time_limit_seconds = limit;
    options.near_clique_ratio = ratio;
    const ExactCliqueSummary summary = FindMaximumClique(graph, options);
    EXPECT_EQ(summary.termination, ExactCliqueTermination::kInvalidOptions);
    EXPECT_THAT(summary.message, testing::HasSubstr(field));
    EXPECT_TRUE(summary.clique.empty());
    EXPECT_FALSE(summary.is_optimal);
  }
}

}  // namespace
}  // namespace quatro::exact_clique_test
