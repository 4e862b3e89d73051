// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Large sets of mutually consistent matches: cliques and cores of a graph.
//
// The core number of a vertex is the largest k such that it belongs to a
// subgraph whose every vertex has k neighbours inside. A clique of c vertices
// has core numbers of at least c - 1, so cores bound cliques from above, and
// ordering by them finds large ones.
//
// Sources: Batagelj and Zaversnik, "An O(m) Algorithm for Cores Decomposition
// of Networks", 2003; Rossi, Gleich and Gebremedhin, "Parallel Maximum Clique
// Algorithms", SIAM J. Sci. Comput. 2015 (the greedy heuristic).

#ifndef QUATRO_ROBUST_GRAPH_MAX_CLIQUE_H_
#define QUATRO_ROBUST_GRAPH_MAX_CLIQUE_H_

#include <vector>

#include "robust/graph/graph.h"

namespace quatro {

// How deep in the graph each vertex lies.
struct CoreDecomposition {
  std::vector<int> core_number;  // Of each vertex.
  std::vector<int> order;        // Vertices as they are peeled, lowest first.
  int max_core = 0;              // 0 for a graph without edges.
};

// Time O(vertices + edges + bits).
CoreDecomposition DecomposeCores(const Graph& graph);

// The paper's MCIS-heuristic: grows a clique greedily from every vertex, in
// descending order of core numbers, and keeps the largest. Vertices in
// ascending order; empty only for a graph without vertices. Equal sizes: the
// first found.
std::vector<int> FindCliqueGreedily(const Graph& graph);

// All vertices of the largest core number: no clique, but it holds every clique
// of more than max_core vertices. In ascending order.
std::vector<int> FindMaxCore(const Graph& graph);

}  // namespace quatro

#endif  // QUATRO_ROBUST_GRAPH_MAX_CLIQUE_H_
