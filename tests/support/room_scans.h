// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Two small scans of a room, seen from two places: registered in milliseconds
// by the options of RoomOptions().

#ifndef QUATRO_TESTS_SUPPORT_ROOM_SCANS_H_
#define QUATRO_TESTS_SUPPORT_ROOM_SCANS_H_

#include "features/base/rigid3.h"
#include "features/io/point_cloud.h"
#include "robust/registration/registration.h"
#include "tests/support/matched_problems.h"

namespace quatro {

inline Rigid3 TrueRoomPose() { return {RotationZ(0.4), {0.8, -0.5, 0.1}}; }

// Floor and four walls of 24 x 16 x 6 m, in the frame of the target.
inline PointCloud RoomTarget() {
  Random random(7);
  PointCloud cloud;
  cloud.points = RandomPointsInBox(3000, {12.0, 8.0, 3.0}, &random);
  for (Eigen::Index i = 0; i < cloud.points.cols(); ++i) {
    auto p = cloud.points.col(i);
    if (i % 3 == 0) p.z() = -3.0;
    if (i % 3 == 1) p.x() = p.x() < 0.0 ? -12.0 : 12.0;
    if (i % 3 == 2) p.y() = p.y() < 0.0 ? -8.0 : 8.0;
  }
  return cloud;
}

inline PointCloud RoomSource() {
  PointCloud cloud;
  cloud.points = Inverse(TrueRoomPose()).Apply(RoomTarget().points);
  return cloud;
}

inline RegistrationOptions RoomOptions() {
  RegistrationOptions options;
  options.front_end.voxel_size = 0.5;
  options.front_end.normal_radius = 1.5;
  options.front_end.fpfh_radius = 2.5;
  return options;
}

}  // namespace quatro

#endif  // QUATRO_TESTS_SUPPORT_ROOM_SCANS_H_
