// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Recovery: estimates the translation again from all matches, once the rotation
// R is known. It returns the translation with the lowest truncated cost
// (robust/estimators/consensus.h) of three,
//
//   t = argmin  sum_i min( |q_i - R p_i - t|^2 / b^2, 1 ).
//
// The largest clique does not always consist of inliers. If many matches are
// inliers in x and y but not in z, the clique can consist of matches with
// similar errors in z and miss true inliers. Its yaw is still correct. So three
// translations are compared: that of the clique; its x and y with z estimated
// from all matches that are inliers in x and y; and x and y each estimated from
// all matches, with z from the matches that are inliers in both.

#ifndef QUATRO_ROBUST_ESTIMATORS_RECOVERY_H_
#define QUATRO_ROBUST_ESTIMATORS_RECOVERY_H_

#include "features/base/rigid3.h"
#include "features/base/types.h"

namespace quatro {

// Column i of `source` is matched with column i of `target` [m].
// `target_from_source` is the pose with the translation of the clique; it is
// returned if no other is better. `noise_bound` b is the bound on each axis
// (half the edge of a box) and the radius of the truncated cost [m].
Rigid3 RecoverTranslation(const PointsRef& source,
                          const PointsRef& target,
                          const Rigid3& target_from_source,
                          double noise_bound);

}  // namespace quatro

#endif  // QUATRO_ROBUST_ESTIMATORS_RECOVERY_H_
