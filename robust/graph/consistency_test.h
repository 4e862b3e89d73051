// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// When two matches are consistent: the offset between their source points could
// become that between their target points by the motion that is estimated.
// With a = p_i - p_j, b = q_i - q_j:
//
//   kLength           | |a| - |b| | <= bound                       any rotation
//   kPlanar           | |a_xy| - |b_xy| | <= bound                 yaw
//   kPlanarAndHeight  the planar test, and
//                     |a_z - b_z| <= bound + max(|a_xy|, |b_xy|) sin(tilt)
//
// The first is the paper's (and TEASER++'s). Under a pure yaw both the planar
// length and the height difference are preserved, which is a sharper test. A
// match that is an inlier in xy and off in z ("quasi-inlier") passes kPlanar
// alone.

#ifndef QUATRO_ROBUST_GRAPH_CONSISTENCY_TEST_H_
#define QUATRO_ROBUST_GRAPH_CONSISTENCY_TEST_H_

#include <string>

namespace quatro {

// Which lengths two consistent matches share.
enum class ConsistencyTest { kLength, kPlanar, kPlanarAndHeight };

// The test, and how far a pair may miss it.
struct ConsistencyOptions {
  ConsistencyTest test = ConsistencyTest::kLength;
  double bound = 0.6;       // [m], both points of a pair may be off.
  double max_tilt = 0.035;  // [rad], for kPlanarAndHeight.

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

}  // namespace quatro

#endif  // QUATRO_ROBUST_GRAPH_CONSISTENCY_TEST_H_
