// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Matches the features of a scan with the previous scan:
//
//   sharp  the line through the nearest edge point and the nearest edge point
//          of another ring beside it;
//   flat   the plane through the nearest plane point, the next one on its ring
//          and the nearest one on another ring beside it.
//
// Source: Zhang and Singh, RSS 2014, Section V.B.

#ifndef QUATRO_EXPERIMENTS_ODOMETRY_ALOAM_SCAN_TO_SCAN_H_
#define QUATRO_EXPERIMENTS_ODOMETRY_ALOAM_SCAN_TO_SCAN_H_

#include <Eigen/Core>
#include <optional>
#include <utility>
#include <vector>

#include "experiments/odometry/aloam/line_plane_residuals.h"
#include "experiments/odometry/aloam/ring_features.h"
#include "features/base/rigid3.h"
#include "features/kd_tree.h"

namespace quatro {

// Nearest-point search by ring.
class RingTrees {
 public:
  explicit RingTrees(const RingPoints& points);

  // The nearest point within `max_distance` [m], or -1.
  Eigen::Index Nearest(const Eigen::Vector3d& query, double max_distance) const;

  // The nearest other point on the ring of point `of`; or the nearest point on
  // the two rings above and the two below.
  Eigen::Index NearestOnRing(const Eigen::Vector3d& query,
                             Eigen::Index of,
                             double max_distance) const;
  Eigen::Index NearestBesideRing(const Eigen::Vector3d& query,
                                 Eigen::Index of,
                                 double max_distance) const;

  Eigen::Vector3d point(Eigen::Index i) const { return points_.points.col(i); }

 private:
  struct Ring {
    KdTree tree;
    std::vector<Eigen::Index> index;  // Its points in points_.
  };

  RingPoints points_;
  std::optional<KdTree> tree_;
  std::vector<std::optional<Ring>> rings_;
};

// A scan to which later scans are matched.
struct ScanModel {
  explicit ScanModel(const RingFeatures& features)
      : edges(features.less_sharp), planes(features.less_flat) {}

  RingTrees edges, planes;
};

struct SurfaceMatches {
  std::vector<SurfaceMatch> lines, planes;
};

// Matches in the frame of the model, up to `max_distance` [m].
SurfaceMatches MatchToScan(const RingFeatures& features,
                           const ScanModel& model,
                           const Rigid3& model_from_scan,
                           double max_distance,
                           int num_threads);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_ODOMETRY_ALOAM_SCAN_TO_SCAN_H_
