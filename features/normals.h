// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Surface normals: the direction of least variance of the points around each
// point p,
//
//   n = argmin_{|n| = 1}  sum_j (n . (p_j - mean))^2,   |p_j - p| <= radius,
//
// oriented toward the sensor, n . (viewpoint - p) >= 0.

#ifndef QUATRO_FEATURES_NORMALS_H_
#define QUATRO_FEATURES_NORMALS_H_

#include <Eigen/Core>

#include "features/base/types.h"
#include "features/kd_tree.h"

namespace quatro {

// One unit normal per point, 3xN. It is zero if fewer than three points are
// within `radius` [m] or all of these are on one line. `neighborhoods` are
// those of `points` at a radius no smaller than `radius`. `viewpoint` is the
// sensor's position in the cloud's frame [m].
Points EstimateNormals(const PointsRef& points,
                       const Neighborhoods& neighborhoods,
                       double radius,
                       const Eigen::Vector3d& viewpoint,
                       int num_threads);

}  // namespace quatro

#endif  // QUATRO_FEATURES_NORMALS_H_
