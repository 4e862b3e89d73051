// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Large sets of mutually consistent matches: cliques and cores of a graph.
//
// The core number of a vertex is the largest k such that the vertex belongs to
// a subgraph in which every vertex has at least k neighbors. In a clique of c
// vertices every core number is at least c - 1. So core numbers bound the
// clique size from above, and a search in descending order of core numbers
// finds large cliques early.
//
// Sources: Batagelj and Zaversnik, "An O(m) Algorithm for Cores Decomposition
// of Networks", 2003; Rossi, Gleich and Gebremedhin, "Parallel Maximum Clique
// Algorithms", SIAM J. Sci. Comput. 2015 (the greedy heuristic).

#ifndef QUATRO_ROBUST_GRAPH_MAX_CLIQUE_H_
#define QUATRO_ROBUST_GRAPH_MAX_CLIQUE_H_

#include <vector>

#include "robust/graph/graph.h"

namespace quatro {

// The core numbers of a graph.
struct CoreDecomposition {
  std::vector<int> core_number;  // One for each vertex.
  std::vector<int> order;        // Vertices in the order of removal.
  int max_core = 0;              // 0 for a graph without edges.
};

// Takes O(vertices + edges + bits) time.
CoreDecomposition DecomposeCores(const Graph& graph);

// The MCIS heuristic of the Quatro paper: grows a clique greedily from every
// vertex, in descending order of core numbers, and returns the largest one, the
// first of equal ones. Vertices are in ascending order. Empty only for a graph
// without vertices.
std::vector<int> FindCliqueGreedily(const Graph& graph);

// All vertices of the largest core number, in ascending order. They need not
// form a clique, but include every clique of more than max_core vertices.
std::vector<int> FindMaxCore(const Graph& graph);

}  // namespace quatro

#endif  // QUATRO_ROBUST_GRAPH_MAX_CLIQUE_H_
