// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// One scan as read from a file: its measured points, and the number of dropped
// points.

#ifndef QUATRO_FEATURES_IO_POINT_CLOUD_H_
#define QUATRO_FEATURES_IO_POINT_CLOUD_H_

#include <Eigen/Core>

#include "features/base/types.h"

namespace quatro {

// The points of one scan, in the frame of its file.
struct PointCloud {
  Points points;              // [m], all finite, none at the origin.
  Eigen::VectorXf intensity;  // Empty, or one number per point.

  // The number of points dropped: with a NaN or infinite coordinate, or exactly
  // at the origin.
  Eigen::Index num_dropped = 0;
};

}  // namespace quatro

#endif  // QUATRO_FEATURES_IO_POINT_CLOUD_H_
