// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A cloud as surfaces seen from one place, and which of them are structure:
// points whose normal is more than 45 deg from the vertical.

#ifndef QUATRO_ROBUST_VERDICT_SURFACE_CLOUD_H_
#define QUATRO_ROBUST_VERDICT_SURFACE_CLOUD_H_

#include <Eigen/Core>

#include "features/base/types.h"
#include "features/kd_tree.h"

namespace quatro {

// A cloud as a surface seen from somewhere.
struct SurfaceCloud {
  Eigen::Vector3d sensor;  // Where it stood, in the frame of the points [m].
  const KdTree& tree;      // Of the points [m].
  const Points& normals;   // Unit, or zero where there is none.

  // All was seen from `sensor`, so that nothing stands before what was seen.
  bool is_scan = true;

  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  // What the vertical is.
};

// Whether a surface with this normal stands; false for zero.
bool IsStructure(const Eigen::Vector3d& normal, const Eigen::Vector3d& up);

// The distance from the sensor that holds three quarters of the points [m]; 0
// without points.
double UsefulRange(const SurfaceCloud& cloud);

}  // namespace quatro

#endif  // QUATRO_ROBUST_VERDICT_SURFACE_CLOUD_H_
