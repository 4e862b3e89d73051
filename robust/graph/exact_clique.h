// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The largest set of mutually consistent matches: a provably maximum clique.
//
// Branch and bound. Let C be a clique, K the largest clique found so far, and P
// the vertices adjacent to all of C. A clique larger than K can grow from C
// only if
//
//   |C| + omega(P) > |K|,   where   omega(P) <= colors(P).                 (1)
//
// Here omega(P) is the size of the largest clique in P, and colors(P) the
// number of color classes of a greedy coloring, computed on rows of bits. No
// two vertices of a class are adjacent, so a clique has at most one vertex in
// each. Vertices in the first |K| - |C| classes need no branch. For any other
// vertex v, two ways to avoid the branch are tried first:
//
//   re-coloring  v has one neighbor w in class A, and w has none in class B:
//                w moves to B and v takes its place in A;
//   conflict     v has one neighbor w in class A, and v and w have no common
//                neighbor in class B: {v}, A and B contain no triangle, so
//                v needs no branch. Each A and B is used only once.
//
// Before the search, core numbers bound cliques (robust/graph/max_clique.h):
// vertices with a core number below |K| are dropped, the others are searched in
// descending order of core numbers. Each branch at the root is searched on its
// own subgraph, so that rows of bits are short and ordered for that subgraph.
//
// Memory: the bits of the subgraphs and one row for each vertex of the clique.
// Time: exponential in the worst case, hence the time limit.
//
// Sources: Tomita et al., "A Simple and Faster Branch-and-Bound Algorithm for
// Finding a Maximum Clique", WALCOM 2010 (re-coloring); San Segundo,
// Rodriguez-Losada and Jimenez, "An Exact Bit-Parallel Algorithm for the
// Maximum Clique Problem", Comput. Oper. Res. 2011; San Segundo, Nikolaev and
// Batsyn, "Infra-Chromatic Bound for Exact Maximum Clique Search", Comput.
// Oper. Res. 2015 (conflicts, there with any number of neighbors in A).

#ifndef QUATRO_ROBUST_GRAPH_EXACT_CLIQUE_H_
#define QUATRO_ROBUST_GRAPH_EXACT_CLIQUE_H_

#include <cstdint>
#include <string>
#include <vector>

#include "robust/graph/graph.h"

namespace quatro {

// When the search may stop before the maximum is proved.
struct ExactCliqueOptions {
  // Wall time [s]; infinity for no limit. The search exceeds it by at most a
  // few milliseconds. The core decomposition is always completed; it takes 20
  // to 90 ms for 5,000 vertices.
  double time_limit_seconds = 1.0;

  // Stop once a clique is proved to have at least this share of the vertices of
  // the maximum clique; 1 requires the maximum. If half of thousands of matches
  // are inliers, the search finds nearly all of them early, and the proof for
  // the last few takes most of the time without changing the pose. A ratio of
  // 0.98 does not stop the search while the upper bound is below 50, since one
  // vertex is then more than 2 %.
  double near_clique_ratio = 0.98;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// How much is proved about the clique.
enum class ExactCliqueTermination {
  kInvalidOptions,  // The search was not run; see the message.
  kOptimal,         // There is no larger clique.
  kNearClique,      // Within near_clique_ratio of the upper bound.
  kTimeLimit,       // The largest clique found within the time limit.
};

// The result depends only on the graph, unless the time limit stopped the
// search; the progress up to then depends on the machine and its load. In any
// case the result is a clique, and no smaller than the greedy one in descending
// order of core numbers.
struct ExactCliqueSummary {
  ExactCliqueTermination termination = ExactCliqueTermination::kInvalidOptions;
  std::string message = "FindMaximumClique was not called";
  std::vector<int> clique;  // In ascending order; empty iff no vertices.
  bool is_optimal = false;
  int upper_bound = 0;            // For any clique; clique.size() iff optimal.
  std::int64_t num_branches = 0;  // Candidate sets that were colored.
};

// Returns the largest clique of the graph, or the largest one found.
ExactCliqueSummary FindMaximumClique(const Graph& graph,
                                     const ExactCliqueOptions& options);

}  // namespace quatro

#endif  // QUATRO_ROBUST_GRAPH_EXACT_CLIQUE_H_
