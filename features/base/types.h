// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Types that all folders share. They have no behavior.

#ifndef QUATRO_FEATURES_BASE_TYPES_H_
#define QUATRO_FEATURES_BASE_TYPES_H_

#include <Eigen/Core>

#include "features/base/abi_guard.h"

namespace quatro {

// One point per column [m]. Functions take `const PointsRef&`, which binds to a
// matrix, a Map or a block of columns without copying.
using Points = Eigen::Matrix3Xd;

// See Points.
using PointsRef = Eigen::Ref<const Points>;

// One number >= 0 per point.
using Weights = Eigen::VectorXd;

// See Weights.
using WeightsRef = Eigen::Ref<const Weights>;

}  // namespace quatro

#endif  // QUATRO_FEATURES_BASE_TYPES_H_
