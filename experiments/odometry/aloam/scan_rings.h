// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The rings of a scan of a spinning lidar, one a beam, from the points alone:
// KITTI's .bin has no ring number. With azimuth a and elevation e,
//
//   a = atan2(y, x),   e = atan2(z, hypot(x, y)),                          (1)
//
// they are told in one of two ways:
//
//   order       The points come beam by beam, as in KITTI: a turns one way and
//               each time that it starts again is a new ring. Holds where e is
//               no longer constant along a ring, as in KITTI's scans, which
//               are corrected for the car's motion by more than the distance
//               between beams.
//   elevation   In any order: beams are the maxima of the histogram of e and
//               each point belongs to the nearest. Only if they stand out.
//
// Works for the HDL-64E, VLP-16 and OS1-64 and whatever else spins about z.

#ifndef QUATRO_EXPERIMENTS_ODOMETRY_ALOAM_SCAN_RINGS_H_
#define QUATRO_EXPERIMENTS_ODOMETRY_ALOAM_SCAN_RINGS_H_

#include <Eigen/Core>
#include <vector>

#include "features/base/types.h"

namespace quatro {

// By what the rings were told apart.
enum class RingSource {
  kNone,  // Neither way: a merged, sampled or tiny cloud.
  kOrder,
  kElevation,
};

// The rings of a scan, as columns of its cloud.
struct ScanRings {
  RingSource source = RingSource::kNone;

  // Columns of the cloud along each ring, in the order of the turn; the rings
  // from top to bottom. Rings of fewer than kMinRingSize points are left out.
  std::vector<std::vector<Eigen::Index>> rings;
  std::vector<double> elevations;  // The median of each ring [rad].
};

inline constexpr int kMinRingSize = 11;

// `points` in the frame of the sensor, finite. Points at its origin are left
// out.
ScanRings EstimateScanRings(const PointsRef& points);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_ODOMETRY_ALOAM_SCAN_RINGS_H_
