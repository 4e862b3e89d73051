// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Edge and plane points of a scan, from the curvature along its rings. With p_i
// the points of a ring in order,
//
//   c_i = | sum_{|j| <= 5} (p_{i+j} - p_i) |^2   [m^2].                    (1)
//
// Each ring is cut into sectors. In each sector, points with c > edge_curvature
// are edges, in descending order of c: the first few are `sharp`, a few more
// are `less_sharp`. Points with c < edge_curvature are planes, in ascending
// order of c: the first few are `flat`. Close neighbors of a chosen point are
// skipped. `less_flat` are all points that are not edges, sampled by voxels.
//
// Points that would not be visible from elsewhere are not chosen: points behind
// the rim of a nearer object, whose edge moves with the sensor, and points on a
// surface nearly parallel to the beam.
//
// Source: Zhang and Singh, "LOAM: Lidar Odometry and Mapping in Real-time", RSS
// 2014, Section V.A. Curvature and counts are those of A-LOAM, where (1) is not
// divided by the range.

#ifndef QUATRO_EXPERIMENTS_ODOMETRY_ALOAM_RING_FEATURES_H_
#define QUATRO_EXPERIMENTS_ODOMETRY_ALOAM_RING_FEATURES_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "experiments/odometry/aloam/scan_rings.h"
#include "features/base/types.h"

namespace quatro {

// The criteria for edges and planes, and how many to select.
struct RingFeatureOptions {
  int num_sectors = 6;
  int max_sharp = 2;        // Per sector.
  int max_less_sharp = 20;  // Including the sharp ones.
  int max_flat = 4;
  double edge_curvature = 0.1;   // [m^2]
  double less_flat_voxel = 0.2;  // [m]

  // Nearer points belong to the vehicle itself [m].
  double min_range = 3.0;

  // A step along the ring larger than this fraction of the range is the rim of
  // an object [m/m]; two in a row are a surface parallel to the beam.
  double max_relative_step = 0.014;
  double min_rim = 0.3;  // Minimum depth of a rim [m].

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// Points of one kind and their rings.
struct RingPoints {
  Points points;          // [m]
  std::vector<int> ring;  // 0 is the top ring.
};

// The four kinds of points.
struct RingFeatures {
  RingPoints sharp, less_sharp, flat, less_flat;
};

// Finds the features of all rings by (1). `points` are in the sensor frame.
RingFeatures FindRingFeatures(const PointsRef& points,
                              const ScanRings& rings,
                              const RingFeatureOptions& options);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_ODOMETRY_ALOAM_RING_FEATURES_H_
