// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The largest set of mutually consistent matches: a maximum clique, proved.
//
// Branch and bound. With C a clique, K the largest found and P the vertices
// next to all of C, a clique larger than K can be grown from C only if
//
//   |C| + omega(P) > |K|,   where   omega(P) <= colours(P).                (1)
//
// Colours(P) comes from classes of pairwise unconnected vertices, filled
// greedily on rows of bits; a clique takes at most one vertex of each. What
// fits into |K| - |C| classes needs no branch. For a vertex v that does not,
// two repairs are tried first:
//
//   re-colouring   v has one neighbour w in class A, and w none in class B:
//                  w moves to B and v takes its place in A;
//   conflict       v has one neighbour w in class A, and v and w none in
//                  common in class B: {v}, A and B hold no three mutual
//                  neighbours, so v comes for free, once for each A and B.
//
// Before that, core numbers bound cliques (robust/graph/max_clique.h): vertices
// of a core number below |K| are dropped, the others searched highest core
// first. Each branch at the root is searched on its own subgraph, so that the
// rows of bits are short and in the subgraph's own order.
//
// Memory: the subgraphs' bits and one row for each vertex of the clique. Time:
// exponential at worst, hence a limit.
//
// Sources: Tomita et al., "A Simple and Faster Branch-and-Bound Algorithm for
// Finding a Maximum Clique", WALCOM 2010 (re-colouring); San Segundo,
// Rodriguez-Losada and Jimenez, "An Exact Bit-Parallel Algorithm for the
// Maximum Clique Problem", Comput. Oper. Res. 2011; San Segundo, Nikolaev and
// Batsyn, "Infra-Chromatic Bound for Exact Maximum Clique Search", Comput.
// Oper. Res. 2015 (conflicts, there with any number of neighbours in A).

#ifndef QUATRO_ROBUST_GRAPH_EXACT_CLIQUE_H_
#define QUATRO_ROBUST_GRAPH_EXACT_CLIQUE_H_

#include <cstdint>
#include <string>
#include <vector>

#include "robust/graph/graph.h"

namespace quatro {

// When to be content with less than the largest.
struct ExactCliqueOptions {
  // Wall time; infinity for no limit. Kept to a few milliseconds, except that
  // the core decomposition is always done: 20 to 90 ms for 5,000 vertices.
  double time_limit_seconds = 1.0;

  // Stop once a clique is proved to be at least this share of the maximum; 1
  // for the maximum itself. Where half of thousands of matches are right, all
  // but a few of them are soon together and the proof of the last takes longest
  // and changes nothing. Bounds too low for the share to spare one vertex, at
  // 0.98 those under 50, are searched to the end.
  double near_clique_ratio = 0.98;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// What is known of the clique found.
enum class ExactCliqueTermination {
  kInvalidOptions,  // Nothing was tried; see message.
  kOptimal,         // There is no larger clique.
  kNearClique,      // Within near_clique_ratio of the upper bound.
  kTimeLimit,       // The largest found in time, its rank unknown.
};

// The same for the same graph, unless stopped by the time limit: then how far
// the search came depends on the machine and its load. It is a clique in any
// case, and no smaller than the greedy one of the highest cores.
struct ExactCliqueSummary {
  ExactCliqueTermination termination = ExactCliqueTermination::kInvalidOptions;
  std::string message = "FindMaximumClique was not called";
  std::vector<int> clique;  // In ascending order; empty iff no vertices.
  bool is_optimal = false;
  int upper_bound = 0;  // On the size of any clique; the size iff optimal.
  std::int64_t num_branches = 0;  // Sets of candidates that were coloured.
};

// The largest clique of the graph, or the largest found.
ExactCliqueSummary FindMaximumClique(const Graph& graph,
                                     const ExactCliqueOptions& options);

}  // namespace quatro

#endif  // QUATRO_ROBUST_GRAPH_EXACT_CLIQUE_H_
