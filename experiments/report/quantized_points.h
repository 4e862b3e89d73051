// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Points in six bytes each: p is origin + step * (i, j, k), i, j and k 16 bits
// with sign, off by half a step at most on each axis. The step is the widest
// axis of a box over 65,534: 3 mm for 200 m.

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

// The finest that holds all of these points, which must be finite.
PointGrid FindGrid(const PointsRef& points);

// i, j, k of each point, low byte first. What is outside of the grid's box
// comes to its side.
std::string QuantizePoints(const PointsRef& points, const PointGrid& grid);

// `bytes` are of whole points.
Points UnquantizePoints(const std::string& bytes, const PointGrid& grid);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_REPORT_QUANTIZED_POINTS_H_
