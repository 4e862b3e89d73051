// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The vertical of a scan from its own walls and trunks, whose normals n_i are
// horizontal:
//
//   u = argmin_{|u| = 1} sum_i w_i (n_i^T u)^2,                            (1)
//   w_i = 1 / (1 + (n_i^T u / s)^2)  if |n_i^T u| < 1/2, else 0,
//
// by iteratively reweighted least squares from a guess. s is 0.1.

#ifndef QUATRO_ROBUST_REGISTRATION_VERTICAL_H_
#define QUATRO_ROBUST_REGISTRATION_VERTICAL_H_

#include <Eigen/Core>
#include <optional>

#include "features/described_cloud.h"

namespace quatro {

// The minimum of (1) with u^T guess > 0, a unit vector. Returns nullopt if the
// normals do not constrain it: fewer than 50 have weight, or all are parallel.
std::optional<Eigen::Vector3d> EstimateVertical(const DescribedCloud& cloud,
                                                const Eigen::Vector3d& guess);

}  // namespace quatro

#endif  // QUATRO_ROBUST_REGISTRATION_VERTICAL_H_
