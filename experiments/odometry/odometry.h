// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Odometry: scans in the order they were taken, a pose for each,
//
//   x_in_world = world_from_scan x_in_scan,   world = the first scan.       (1)
//
// A method supplies Track(); what all share is here: the guess from constant
// velocity, and what happens to a scan that can't be used. Such a scan gets the
// guess for its pose, is called lost, and the next goes on from there: one bad
// file does not end a drive. The scans are as of one moment: correcting them
// for the motion during a turn is up to the caller (KITTI's are).

#ifndef QUATRO_EXPERIMENTS_ODOMETRY_ODOMETRY_H_
#define QUATRO_EXPERIMENTS_ODOMETRY_ODOMETRY_H_

#include <optional>
#include <string>

#include "features/base/rigid3.h"
#include "features/io/point_cloud.h"

namespace quatro {

enum class OdometryStatus {
  kFirst,    // Became the world.
  kTracked,  // Its pose was measured.
  kLost,     // Its pose is the guess; the message says why.
};

// "first", "tracked", "lost".
const char* StatusName(OdometryStatus status);

struct OdometryStep {
  OdometryStatus status = OdometryStatus::kLost;
  std::string message = "nothing was tried";
  Rigid3 world_from_scan;
  double seconds = 0.0;
};

// What a method made of a scan.
struct TrackResult {
  std::optional<Rigid3> world_from_scan;
  std::string message = "nothing was tried";
};

// With the rotation nearest to one that products have worn. Left alone the
// error grows without bound where a guess comes back as an answer: the inverse
// of a pose is its transpose, so that each guess doubles what is off.
Rigid3 Normalized(const Rigid3& pose);

class Odometry {
 public:
  virtual ~Odometry() = default;

  // For a scan that could not be read: an empty cloud.
  OdometryStep AddScan(const PointCloud& scan);

 private:
  // Makes this scan the world, before any was tracked.
  virtual TrackResult Start(const PointCloud& scan) = 0;

  // The pose of a scan after the first. Without an answer the method must not
  // have learned from the scan.
  virtual TrackResult Track(const PointCloud& scan,
                            const Rigid3& world_from_scan_guess) = 0;

  bool has_world_ = false;
  Rigid3 world_from_last_;
  Rigid3 last_from_next_;  // Constant velocity.
};

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_ODOMETRY_ODOMETRY_H_
