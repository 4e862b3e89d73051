// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The neighbors of every point p_i of a cloud within a radius,
//
//   N_i = { j : |p_j - p_i| <= radius },
//
// found cell by cell. All points of a cell (features/cells.h) have their
// neighbors in the same 27 cells. The points of these cells are sorted once per
// cell, and the distances to them are computed 16 at a time. Distances and
// order are those of KdTree::WithinRadius(), bit for bit.

#ifndef QUATRO_FEATURES_CELL_NEIGHBORHOODS_H_
#define QUATRO_FEATURES_CELL_NEIGHBORHOODS_H_

#include <optional>

#include "features/base/simd.h"
#include "features/base/types.h"
#include "features/neighborhoods.h"

namespace quatro {

// The points must be finite. Returns nullopt unless the width of the cloud is
// finite and less than 2^20 radii [m]. `level` must not exceed BestSimdLevel().
std::optional<Neighborhoods> FindNeighborhoodsByCells(const Points& points,
                                                      double radius,
                                                      int num_threads,
                                                      SimdLevel level);

}  // namespace quatro

#endif  // QUATRO_FEATURES_CELL_NEIGHBORHOODS_H_
