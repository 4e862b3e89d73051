// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Edge and plane points of a scan, by the curvature along its rings. With p_i
// the points of a ring in order,
//
//   c_i = | sum_{|j| <= 5} (p_{i+j} - p_i) |^2   [m^2].                    (1)
//
// Each ring is cut into sectors. In each, from the largest c down, points with
// c > edge_curvature are edges: `sharp` the first few, `less_sharp` a few more;
// from the smallest up, points with c < edge_curvature are planes: `flat` the
// first few. Neighbors of a chosen point are passed over where they are close
// to it. `less_flat` are all points that are no edge, voxel by voxel.
//
// Not chosen are points that would not be seen from elsewhere: those behind
// the rim of something nearer, whose edge moves with the sensor, and those on
// a surface nearly parallel to the beam.
//
// Source: Zhang and Singh, "LOAM: Lidar Odometry and Mapping in Real-time", RSS
// 2014, Section V.A; curvature and counts as in the A-LOAM that is in use,
// where (1) is not divided by the range.

#ifndef QUATRO_EXPERIMENTS_ODOMETRY_ALOAM_RING_FEATURES_H_
#define QUATRO_EXPERIMENTS_ODOMETRY_ALOAM_RING_FEATURES_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "experiments/odometry/aloam/scan_rings.h"
#include "features/base/types.h"

namespace quatro {

// What counts as an edge or a plane, and how many are wanted.
struct RingFeatureOptions {
  int num_sectors = 6;
  int max_sharp = 2;        // A sector.
  int max_less_sharp = 20;  // Sharp ones included.
  int max_flat = 4;
  double edge_curvature = 0.1;   // [m^2]
  double less_flat_voxel = 0.2;  // [m]

  // Nearer points are the car's own [m].
  double min_range = 3.0;

  // A step along the ring by more than this part of the range is the rim of
  // something [m/m]; two in a row, a surface parallel to the beam.
  double max_relative_step = 0.014;
  double min_rim = 0.3;  // Depth of a rim [m].

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// Points of one kind and the rings they are from.
struct RingPoints {
  Points points;          // [m]
  std::vector<int> ring;  // 0 is the top.
};

// The four kinds.
struct RingFeatures {
  RingPoints sharp, less_sharp, flat, less_flat;
};

// Those of all rings, by (1). `points` in the frame of the sensor.
RingFeatures FindRingFeatures(const PointsRef& points,
                              const ScanRings& rings,
                              const RingFeatureOptions& options);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_ODOMETRY_ALOAM_RING_FEATURES_H_
