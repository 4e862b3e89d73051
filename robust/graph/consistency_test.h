// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The test whether two matches are consistent, that is, whether one rigid
// motion of the estimated kind can explain both. With a = p_i - p_j and b = q_i
// - q_j:
//
//   kLength           | |a| - |b| | <= bound                       any rotation
//   kPlanar           | |a_xy| - |b_xy| | <= bound                 yaw
//   kPlanarAndHeight  the planar test, and
//                     |a_z - b_z| <= bound + max(|a_xy|, |b_xy|) sin(tilt)
//
// kLength is the test of the Quatro paper and of TEASER++. A pure yaw preserves
// both the planar length and the height difference, so the other tests are
// stricter. A match that is an inlier in x and y but not in z ("quasi-inlier")
// passes only kPlanar.

#ifndef QUATRO_ROBUST_GRAPH_CONSISTENCY_TEST_H_
#define QUATRO_ROBUST_GRAPH_CONSISTENCY_TEST_H_

#include <string>

namespace quatro {

// The lengths that two consistent matches must share.
enum class ConsistencyTest { kLength, kPlanar, kPlanarAndHeight };

// The test and its tolerances.
struct ConsistencyOptions {
  ConsistencyTest test = ConsistencyTest::kLength;
  double bound = 0.6;       // Twice the noise bound of one match [m].
  double max_tilt = 0.035;  // For kPlanarAndHeight [rad].

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

}  // namespace quatro

#endif  // QUATRO_ROBUST_GRAPH_CONSISTENCY_TEST_H_
