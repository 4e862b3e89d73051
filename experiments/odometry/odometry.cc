// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/odometry/odometry.h"

#include <Eigen/Geometry>
#include <string>

#include "features/base/stopwatch.h"

namespace quatro {
namespace {

// A scan with fewer points is unusable.
constexpr Eigen::Index kMinNumPoints = 100;

// Larger than the range of any lidar [m].
constexpr double kMaxCoordinate = 1e4;

// Returns an empty string if the scan can be used.
std::string WhyUnusable(const PointCloud& scan) {
  if (scan.points.cols() < kMinNumPoints) {
    return "the scan has " + std::to_string(scan.points.cols()) +
           " points, must have at least " + std::to_string(kMinNumPoints);
  }
  if (!scan.points.allFinite())
    return "the scan has a point that is not finite";
  if (scan.points.cwiseAbs().maxCoeff() > kMaxCoordinate) {
    return "the scan has a point more than 10 km from its sensor";
  }
  return "";
}

}  // namespace

Rigid3 Normalized(const Rigid3& pose) {
  return {Eigen::Quaterniond(pose.rotation).normalized().toRotationMatrix(),
          pose.translation};
}

const char* StatusName(OdometryStatus status) {
  switch (status) {
    case OdometryStatus::kFirst:
      return "first";
    case OdometryStatus::kTracked:
      return "tracked";
    case OdometryStatus::kLost:
      break;
  }
  return "lost";
}

OdometryStep Odometry::AddScan(const PointCloud& scan) {
  Stopwatch stopwatch;
  OdometryStep step;
  // The guess is kept if nothing better is found.
  step.world_from_scan = Normalized(world_from_last_ * last_from_next_);
  step.message = WhyUnusable(scan);
  if (step.message.empty()) {
    const TrackResult result =
        has_world_ ? Track(scan, step.world_from_scan) : Start(scan);
    step.message = result.message;
    if (result.world_from_scan &&
        !result.world_from_scan->ToMatrix().allFinite()) {
      step.message = "the pose is not finite";
    } else if (result.world_from_scan) {
      step.status =
          has_world_ ? OdometryStatus::kTracked : OdometryStatus::kFirst;
      step.world_from_scan = Normalized(*result.world_from_scan);
      last_from_next_ =
          Normalized(Inverse(world_from_last_) * step.world_from_scan);
      has_world_ = true;
    }
  }
  world_from_last_ = step.world_from_scan;
  step.seconds = stopwatch.Lap();
  return step;
}

}  // namespace quatro
