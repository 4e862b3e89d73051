// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Voxel sampling: one point per occupied cell of a grid, the mean of those in
// it.
//
//   cell(p) = floor(p / voxel_size),   sample(c) = mean { p : cell(p) = c }.
//
// The cells are anchored at the origin and come out in the order of their
// indices (x, then y, then z). Means are summed in fixed point, which is
// associative: the result depends, bit for bit, on the set of points alone.

#ifndef QUATRO_FEATURES_VOXEL_GRID_H_
#define QUATRO_FEATURES_VOXEL_GRID_H_

#include <optional>
#include <string>

#include "features/base/types.h"

namespace quatro {

// `voxel_size` [m]. Returns nullopt and says why in *error if voxel_size is not
// positive and finite, a point is not finite, or the cloud is wider than 2^21
// cells.
std::optional<Points> SampleVoxels(const PointsRef& points,
                                   double voxel_size,
                                   std::string* error);

}  // namespace quatro

#endif  // QUATRO_FEATURES_VOXEL_GRID_H_
