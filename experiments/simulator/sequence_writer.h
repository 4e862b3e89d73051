// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Writes a drive to disk frame by frame, in one of the layouts (kitti_layout.h,
// naver_layout.h).

#ifndef QUATRO_EXPERIMENTS_SIMULATOR_SEQUENCE_WRITER_H_
#define QUATRO_EXPERIMENTS_SIMULATOR_SEQUENCE_WRITER_H_

#include <Eigen/Core>
#include <string>

#include "features/base/rigid3.h"
#include "features/io/point_cloud.h"
#include "solvers/closed_form/gravity.h"

namespace quatro {

// The measurement of an INS, in a world with x to the east, y to the north and
// z up, for a body with x ahead, y to the left and z up.
struct InsReading {
  Attitude attitude;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();      // [m], in the world.
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();      // [m/s], likewise.
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();  // [m/s^2], likewise.
  Eigen::Vector3d turn_rate = Eigen::Vector3d::Zero();  // [rad/s], in the body.
};

class SequenceWriter {
 public:
  SequenceWriter() = default;
  virtual ~SequenceWriter() = default;
  SequenceWriter(const SequenceWriter&) = delete;
  SequenceWriter& operator=(const SequenceWriter&) = delete;

  // Adds the next frame at `time` [s]. `reading` is nullptr for all frames or
  // for none.
  virtual bool Add(const PointCloud& cloud,
                   const Rigid3& world_from_sensor,
                   double time,
                   const InsReading* reading,
                   std::string* error) = 0;

  // Call once, after the last frame. Without this call no files remain.
  virtual bool Finish(std::string* error) = 0;
};

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_SIMULATOR_SEQUENCE_WRITER_H_
