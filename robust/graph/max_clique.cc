// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/graph/max_clique.h"

#include <algorithm>
#include <bit>

namespace quatro {
namespace {

// A view of a graph with vertex order[k] renamed k. Rows are computed on
// demand: once a large clique is found, few more are needed.
class RenamedGraph {
 public:
  RenamedGraph(const Graph& graph, const std::vector<int>& order)
      : graph_(graph),
        order_(order),
        name_(order.size()),
        renamed_(graph.num_vertices()),
        is_made_(order.size(), false) {
    for (std::size_t k = 0; k < order.size(); ++k) {
      name_[static_cast<std::size_t>(order[k])] = static_cast<int>(k);
    }
  }

  std::span<const Graph::Word> Row(int k) {
    const auto at = static_cast<std::size_t>(k);
    if (!is_made_[at]) {
      is_made_[at] = true;
      const auto row = renamed_.MutableRow(k);
      graph_.ForEachNeighbor(order_[at], [&](int j) {
        const int neighbor = name_[static_cast<std::size_t>(j)];
        row[static_cast<std::size_t>(neighbor / Graph::kWordBits)] |=
            Graph::Word{1} << (neighbor % Graph::kWordBits);
      });
    }
    return renamed_.Row(k);
  }

 private:
  const Graph& graph_;
  const std::vector<int>& order_;
  std::vector<int> name_;  // New number of each vertex.
  Graph renamed_;
  std::vector<bool> is_made_;
};

}  // namespace

CoreDecomposition DecomposeCores(const Graph& graph) {
  const auto n = static_cast<std::size_t>(graph.num_vertices());
  CoreDecomposition cores;
  cores.core_number.resize(n);
  cores.order.resize(n);
  std::vector<int>& degree = cores.core_number;
  int max_degree = 0;
  for (std::size_t i = 0; i < n; ++i) {
    degree[i] = graph.Degree(static_cast<int>(i));
    max_degree = std::max(max_degree, degree[i]);
  }

  // Vertices sorted by degree in buckets; begin[d] is where bucket d starts.
  std::vector<std::size_t> begin(static_cast<std::size_t>(max_degree) + 2, 0);
  for (const int d : degree) ++begin[static_cast<std::size_t>(d) + 1];
  for (std::size_t d = 1; d < begin.size(); ++d) begin[d] += begin[d - 1];
  std::vector<std::size_t> position(n);
  {
    std::vector<std::size_t> next = begin;
    for (std::size_t i = 0; i < n; ++i) {
      position[i] = next[static_cast<std::size_t>(degree[i])]++;
      cores.order[position[i]] = static_cast<int>(i);
    }
  }

  // The remaining vertices; the degrees of the others are final.
  std::vector<Graph::Word> left(
      graph.num_vertices() > 0 ? graph.Row(0).size() : 0, ~Graph::Word{0});
  for (std::size_t k = 0; k < n; ++k) {
    const int i = cores.order[k];
    const int core = degree[static_cast<std::size_t>(i)];
    cores.max_core = std::max(cores.max_core, core);
    left[static_cast<std::size_t>(i / Graph::kWordBits)] &=
        ~(Graph::Word{1} << (i % Graph::kWordBits));
    graph.ForEachNeighborAmong(i, left, [&](int neighbor) {
      const auto j = static_cast<std::size_t>(neighbor);
      if (degree[j] <= core) return;
      // Move j one bucket down: swap it with the first vertex of its bucket.
      const auto d = static_cast<std::size_t>(degree[j]);
      const std::size_t first = begin[d];
      const auto other = static_cast<std::size_t>(cores.order[first]);
      std::swap(cores.order[first], cores.order[position[j]]);
      std::swap(position[other], position[j]);
      ++begin[d];
      --degree[j];
    });
  }
  return cores;
}

std::vector<int> FindCliqueGreedily(const Graph& graph) {
  const int n = graph.num_vertices();
  CoreDecomposition cores = DecomposeCores(graph);
  // Highest core first, so that the first bit of a set is its best candidate.
  std::reverse(cores.order.begin(), cores.order.end());
  RenamedGraph ordered(graph, cores.order);
  const auto core_of = [&](int k) {
    const int vertex = cores.order[static_cast<std::size_t>(k)];
    return cores.core_number[static_cast<std::size_t>(vertex)];
  };

  std::vector<int> best;
  std::vector<int> clique;
  std::vector<Graph::Word> candidates;
  // Vertices from `end` on have core numbers too small to extend the best
  // clique.
  int end = n;
  for (int k = 0; k < end; ++k) {
    clique.assign(1, k);
    const auto row = ordered.Row(k);
    const auto num_words = static_cast<std::size_t>(
        (end + Graph::kWordBits - 1) / Graph::kWordBits);
    candidates.assign(row.begin(), row.begin() + static_cast<long>(num_words));
    if (end % Graph::kWordBits != 0) {
      candidates.back() &= (Graph::Word{1} << (end % Graph::kWordBits)) - 1;
    }
    for (std::size_t w = 0; w < num_words;) {
      if (candidates[w] == 0) {
        ++w;
        continue;
      }
      const int next = static_cast<int>(w) * Graph::kWordBits +
                       std::countr_zero(candidates[w]);
      clique.push_back(next);
      // A vertex is not its own neighbor, so this also removes `next`.
      const auto next_row = ordered.Row(next);
      for (std::size_t v = w; v < num_words; ++v) candidates[v] &= next_row[v];
    }
    if (clique.size() > best.size()) {
      best = clique;
      while (end > 0 && core_of(end - 1) < static_cast<int>(best.size())) --end;
    }
  }

  for (int& vertex : best)
    vertex = cores.order[static_cast<std::size_t>(vertex)];
  std::sort(best.begin(), best.end());
  return best;
}

std::vector<int> FindMaxCore(const Graph& graph) {
  const CoreDecomposition cores = DecomposeCores(graph);
  std::vector<int> vertices;
  for (int i = 0; i < graph.num_vertices(); ++i) {
    if (cores.core_number[static_cast<std::size_t>(i)] == cores.max_core) {
      vertices.push_back(i);
    }
  }
  return vertices;
}

}  // namespace quatro
