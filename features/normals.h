// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Surface normals: at each point the direction of least spread of the points
// around it,
//
//   n = argmin_{|n| = 1}  sum_j (n . (p_j - mean))^2,   |p_j - p| <= radius,
//
// turned towards the sensor, n . (viewpoint - p) >= 0.

#ifndef QUATRO_FEATURES_NORMALS_H_
#define QUATRO_FEATURES_NORMALS_H_

#include <Eigen/Core>

#include "features/base/types.h"
#include "features/kd_tree.h"

namespace quatro {

// One unit normal per point, or zero where fewer than three points are within
// `radius` [m], or all of them on a line. `neighborhoods` are those of
// `points`, at a radius no smaller than this one; `viewpoint` is the sensor's
// place in the cloud's frame [m].
Points EstimateNormals(const PointsRef& points,
                       const Neighborhoods& neighborhoods,
                       double radius,
                       const Eigen::Vector3d& viewpoint,
                       int num_threads);

}  // namespace quatro

#endif  // QUATRO_FEATURES_NORMALS_H_
