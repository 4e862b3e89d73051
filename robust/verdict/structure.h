// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Structure: the points of a cloud whose normal is more than 45 deg from the
// vertical, z. The ground is not structure, as it fits under any yaw.

#ifndef QUATRO_ROBUST_VERDICT_STRUCTURE_H_
#define QUATRO_ROBUST_VERDICT_STRUCTURE_H_

#include <Eigen/Core>

#include "features/described_cloud.h"

namespace quatro {

// The largest |n_z| of structure, at 45 deg.
inline constexpr double kMaxVertical = 0.7071;

// Whether a point with this normal is structure; false for a zero normal.
bool IsStructure(const Eigen::Vector3d& normal);

// The distance from the sensor within which three quarters of the points lie
// [m]; 0 without points.
double UsefulRange(const DescribedCloud& cloud);

}  // namespace quatro

#endif  // QUATRO_ROBUST_VERDICT_STRUCTURE_H_
