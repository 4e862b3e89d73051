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

// `source` and `target` hold the matches column by column. Points are stored in
// single precision relative to the clouds' medians, so distances are exact to
// about 1e-7 of the distance of the points from the median. Points more than a
// million bounds from it are tested in double precision, so a far outlier
// neither spoils an edge nor gains one by rounding.
Graph BuildConsistencyGraph(const PointsRef& source,
                            const PointsRef& target,
                            const ConsistencyOptions& options,
                            int num_threads);

}  // namespace quatro

#endif  // QUATRO_ROBUST_GRAPH_CONSISTENCY_GRAPH_H_
