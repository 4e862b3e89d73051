// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Re-estimates the translation from all matches, once the rotation is known.
//
// The largest clique does not always consist of inliers. If many matches are
// inliers in x and y but not in z, the clique can consist of matches with
// similar errors in z and miss true inliers. Its yaw is still correct. So three
// translations are compared: that of the clique; its x and y with z
// re-estimated from all matches that are inliers in x and y; and x and y each
// re-estimated from all matches, with z from the matches that are inliers in
// both. The translation with the lowest truncated cost
// (robust/estimators/consensus.h) is returned.

#ifndef QUATRO_ROBUST_ESTIMATORS_RECOVERY_H_
#define QUATRO_ROBUST_ESTIMATORS_RECOVERY_H_

#include "features/base/rigid3.h"
#include "features/base/types.h"

namespace quatro {

// `target_from_source` is the pose with the translation of the clique.
// `noise_bound` is the bound on each axis (half the edge of a box) and the
// radius of the truncated cost [m].
Rigid3 RecoverTranslation(const PointsRef& source,
                          const PointsRef& target,
                          const Rigid3& target_from_source,
                          double noise_bound);

}  // namespace quatro

#endif  // QUATRO_ROBUST_ESTIMATORS_RECOVERY_H_
