// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The points around each point of a cloud, all at once: all points of a cell
// (features/cells.h) have theirs in the same 27 cells, so these are put in
// order once a cell, and every distance from a point of it to one of them is
// computed, 16 at once. Distances and their order are those of
// KdTree::WithinRadius(), to the last bit.

#ifndef QUATRO_FEATURES_CELL_NEIGHBORHOODS_H_
#define QUATRO_FEATURES_CELL_NEIGHBORHOODS_H_

#include <optional>

#include "features/base/simd.h"
#include "features/base/types.h"
#include "features/neighborhoods.h"

namespace quatro {

// Nullopt if the cloud is wider than 2^20 radii or more than can be computed
// with. `level` no more than BestSimdLevel().
std::optional<Neighborhoods> FindNeighborhoodsByCells(const Points& points,
                                                      double radius,
                                                      int num_threads,
                                                      SimdLevel level);

}  // namespace quatro

#endif  // QUATRO_FEATURES_CELL_NEIGHBORHOODS_H_
