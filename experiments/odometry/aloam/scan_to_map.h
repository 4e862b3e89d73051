// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// What the features of a scan should be on, by the map of all scans before it:
// the line or plane through the five nearest points of the map, where these
// spread like one. With m their mean and l0 <= l1 <= l2 the eigenvalues of
// their covariance, v0, v1, v2 its eigenvectors,
//
//   line   d = v2, a = m   if  l2 > 3 l1,                                  (1)
//   plane  n = v0, a = m   if  l1 > 3 l0 and all are within 0.2 m of it.   (2)
//
// Source: Zhang and Singh, RSS 2014, Section VI, with the numbers of A-LOAM;
// the first condition of (2), which keeps five points of one ring from making a
// plane, is ours.

#ifndef QUATRO_EXPERIMENTS_ODOMETRY_ALOAM_SCAN_TO_MAP_H_
#define QUATRO_EXPERIMENTS_ODOMETRY_ALOAM_SCAN_TO_MAP_H_

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "experiments/odometry/aloam/line_plane_residuals.h"
#include "features/base/rigid3.h"
#include "features/kd_tree.h"

namespace quatro {

// Of `source`, a point now at `query` in the frame of the map; none where the
// fifth neighbor is farther than `max_distance` [m].
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
