// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Voxel sampling: replaces the points in each occupied cell of a grid by their
// mean.
//
//   cell(p) = floor(p / voxel_size),   sample(c) = mean { p : cell(p) = c }.
//
// Cells are anchored at the origin. Samples are ordered by the indices of their
// cells (x, then y, then z). Means are summed in fixed point, which is
// associative. So the result depends, bit for bit, only on the set of points.

#ifndef QUATRO_FEATURES_VOXEL_GRID_H_
#define QUATRO_FEATURES_VOXEL_GRID_H_

#include <optional>
#include <string>

#include "features/base/types.h"

namespace quatro {

// The squares of smaller distances have no digits, so that all points count as
// equally near [m].
inline constexpr double kMinCloudWidth = 1e-100;

// `voxel_size` is in meters. Returns nullopt and sets *error if it is not
// positive and finite, if a point is not finite, if the cloud is wider than
// 2^21 cells, or if its points differ but its width is below kMinCloudWidth.
std::optional<Points> SampleVoxels(const PointsRef& points,
                                   double voxel_size,
                                   std::string* error);

}  // namespace quatro

#endif  // QUATRO_FEATURES_VOXEL_GRID_H_
