// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// gMock matchers whose failure message carries the number one needs.

#ifndef QUATRO_TESTS_SUPPORT_MATCHERS_H_
#define QUATRO_TESTS_SUPPORT_MATCHERS_H_

#include <gmock/gmock.h>

#include <cmath>

namespace quatro {

// Angles in radians, equal up to whole turns. NaN matches nothing.
MATCHER_P2(IsAngleNear, expected, tolerance, "") {
  const double difference = std::remainder(arg - expected, 2.0 * M_PI);
  *result_listener << "off by " << difference * 180.0 / M_PI << " deg";
  return std::abs(difference) <= tolerance;
}

}  // namespace quatro

#endif  // QUATRO_TESTS_SUPPORT_MATCHERS_H_
