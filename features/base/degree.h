// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Angles are in radians throughout the code, in degrees in flags and files.

#ifndef QUATRO_FEATURES_BASE_DEGREE_H_
#define QUATRO_FEATURES_BASE_DEGREE_H_

#include <cmath>

namespace quatro {

inline constexpr double kDegree = M_PI / 180.0;  // [rad]
inline constexpr double kRadian = 180.0 / M_PI;  // [deg]

}  // namespace quatro

#endif  // QUATRO_FEATURES_BASE_DEGREE_H_
