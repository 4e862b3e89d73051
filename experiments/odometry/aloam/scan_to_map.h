// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Matches the features of a scan with the map of all previous scans. A feature
// matches the line or plane through the five nearest points of the map, if
// these points form one. With their mean m, the eigenvalues l0 <= l1 <= l2 of
// their covariance and its eigenvectors v0, v1, v2,
//
//   line   d = v2, a = m   if  l2 > 3 l1,                                  (1)
//   plane  n = v0, a = m   if  l1 > 3 l0 and all are within 0.2 m of it.   (2)
//
// Source: Zhang and Singh, RSS 2014, Section VI, with the numbers of A-LOAM.
// The first condition of (2) is our own; it prevents five points of one ring
// from forming a plane.

#ifndef QUATRO_EXPERIMENTS_ODOMETRY_ALOAM_SCAN_TO_MAP_H_
#define QUATRO_EXPERIMENTS_ODOMETRY_ALOAM_SCAN_TO_MAP_H_

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "experiments/odometry/aloam/line_plane_residuals.h"
#include "features/base/rigid3.h"
#include "features/kd_tree.h"

namespace quatro {

// Match of the point `source`, which is at `query` in the frame of the map.
// Returns nullopt if the fifth neighbor is farther than `max_distance` [m].
std::optional<SurfaceMatch> FitLine(const KdTree& map,
                                    const Eigen::Vector3d& source,
                                    const Eigen::Vector3d& query,
                                    double max_distance);
std::optional<SurfaceMatch> FitPlane(const KdTree& map,
                                     const Eigen::Vector3d& source,
                                     const Eigen::Vector3d& query,
                                     double max_distance);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_ODOMETRY_ALOAM_SCAN_TO_MAP_H_
