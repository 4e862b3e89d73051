// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The consistency graph: a vertex per match, and an edge (i, j) iff matches i
// and j pass the consistency test (robust/graph/consistency_test.h).

#ifndef QUATRO_ROBUST_GRAPH_CONSISTENCY_GRAPH_H_
#define QUATRO_ROBUST_GRAPH_CONSISTENCY_GRAPH_H_

#include <Eigen/Core>

#include "features/base/types.h"
#include "robust/graph/consistency_test.h"
#include "robust/graph/graph.h"

namespace quatro {

// `source` and `target` hold the matches column by column. Distances are in
// single precision about the clouds' medians: exact to about 1e-7 of how far
// from there the points are. Points a million bounds from there are compared in
// double precision, so a far outlier spoils no edge, nor does it get one by
// rounding.
Graph BuildConsistencyGraph(const PointsRef& source,
                            const PointsRef& target,
                            const ConsistencyOptions& options,
                            int num_threads);

}  // namespace quatro

#endif  // QUATRO_ROBUST_GRAPH_CONSISTENCY_GRAPH_H_
