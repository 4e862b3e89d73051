// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Odometry: a pose for each scan, in the order in which the scans were taken,
//
//   x_in_world = world_from_scan x_in_scan,   world = the first scan.       (1)
//
// A method supplies Track(). This class handles the common part: the
// constant-velocity guess and unusable scans. An unusable scan is called lost,
// and its pose is the guess. The next scan continues from there, so that one
// bad file does not end a drive. Each scan is treated as taken at one instant;
// correcting it for the motion during a revolution is up to the caller (KITTI's
// scans are corrected).

#ifndef QUATRO_EXPERIMENTS_ODOMETRY_ODOMETRY_H_
#define QUATRO_EXPERIMENTS_ODOMETRY_ODOMETRY_H_

#include <optional>
#include <string>

#include "features/base/rigid3.h"
#include "features/io/point_cloud.h"

namespace quatro {

enum class OdometryStatus {
  kFirst,    // Defines the world frame.
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

// The result of a method for one scan.
struct TrackResult {
  std::optional<Rigid3> world_from_scan;
  std::string message = "nothing was tried";
};

// Replaces the rotation by the nearest one. Products accumulate rounding
// errors. Without this, the error grows without bound if the guess becomes the
// answer: the inverse of a pose uses the transpose, so each guess doubles the
// error.
Rigid3 Normalized(const Rigid3& pose);

class Odometry {
 public:
  virtual ~Odometry() = default;

  // Pass an empty cloud for a scan that could not be read.
  OdometryStep AddScan(const PointCloud& scan);

 private:
  // Makes this scan the world frame; called before any scan is tracked.
  virtual TrackResult Start(const PointCloud& scan) = 0;

  // Estimates the pose of a scan after the first. If there is no answer, the
  // method must not have changed its state.
  virtual TrackResult Track(const PointCloud& scan,
                            const Rigid3& world_from_scan_guess) = 0;

  bool has_world_ = false;
  Rigid3 world_from_last_;
  Rigid3 last_from_next_;  // Constant velocity.
};

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_ODOMETRY_ODOMETRY_H_
