// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Points in six bytes each: p is origin + step * (i, j, k), where i, j and k
// are signed 16-bit integers. The error is at most half a step on each axis.
// The step is the longest edge of the bounding box over 65,534: 3 mm for 200 m.

#ifndef QUATRO_EXPERIMENTS_REPORT_QUANTIZED_POINTS_H_
#define QUATRO_EXPERIMENTS_REPORT_QUANTIZED_POINTS_H_

#include <Eigen/Core>
#include <string>

#include "features/base/types.h"

namespace quatro {

struct PointGrid {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  // [m]
  double step = 1.0;                                 // [m], > 0.
};

// The finest grid that contains all points, which must be finite.
PointGrid FindGrid(const PointsRef& points);

// i, j, k of each point, low byte first. Points outside the grid's box are
// moved to its boundary.
std::string QuantizePoints(const PointsRef& points, const PointGrid& grid);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_REPORT_QUANTIZED_POINTS_H_
