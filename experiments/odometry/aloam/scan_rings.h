// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The rings of a scan of a spinning lidar, one per beam, from the points alone,
// because KITTI's .bin files have no ring numbers. With azimuth a and elevation
// e,
//
//   a = atan2(y, x),   e = atan2(z, hypot(x, y)),                          (1)
//
// the rings are identified in one of two ways:
//
//   order       The points are stored beam by beam, as in KITTI: a increases
//               or decreases along a ring, and each restart begins a new ring.
//               This works even if e is not constant along a ring, as in
//               KITTI's scans, whose motion correction exceeds the distance
//               between beams.
//   elevation   Points in any order: beams are the maxima of the histogram of
//               e, and each point belongs to the nearest beam. This requires
//               distinct maxima.
//
// Works for the HDL-64E, VLP-16, OS1-64 and other sensors that rotate about z.

#ifndef QUATRO_EXPERIMENTS_ODOMETRY_ALOAM_SCAN_RINGS_H_
#define QUATRO_EXPERIMENTS_ODOMETRY_ALOAM_SCAN_RINGS_H_

#include <Eigen/Core>
#include <vector>

#include "features/base/types.h"

namespace quatro {

// How the rings were identified.
enum class RingSource {
  kNone,  // Not found: a merged, sampled or tiny cloud.
  kOrder,
  kElevation,
};

// The rings of a scan, as columns of its cloud.
struct ScanRings {
  RingSource source = RingSource::kNone;

  // Columns of the cloud along each ring, in order of rotation; rings from top
  // to bottom. Rings of fewer than kMinRingSize points are left out.
  std::vector<std::vector<Eigen::Index>> rings;
  std::vector<double> elevations;  // The median of each ring [rad].
};

inline constexpr int kMinRingSize = 11;

// `points` are in the sensor frame and finite. Points at the origin are left
// out.
ScanRings EstimateScanRings(const PointsRef& points);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_ODOMETRY_ALOAM_SCAN_RINGS_H_
