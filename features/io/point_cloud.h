// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// One scan as read from a file: its finite points, and the number of others.

#ifndef QUATRO_FEATURES_IO_POINT_CLOUD_H_
#define QUATRO_FEATURES_IO_POINT_CLOUD_H_

#include <Eigen/Core>

#include "features/base/types.h"

namespace quatro {

// The points of one scan, in the frame of its file.
struct PointCloud {
  Points points;              // [m], all finite.
  Eigen::VectorXf intensity;  // Empty, or one number per point.

  // The number of points dropped because of a NaN or infinite coordinate.
  Eigen::Index num_dropped = 0;
};

}  // namespace quatro

#endif  // QUATRO_FEATURES_IO_POINT_CLOUD_H_
