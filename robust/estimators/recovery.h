// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Translation again, over all matches, once the rotation is known.
//
// The largest clique is not always the right one: where many matches are right
// in xy and wrong in z, it keeps those that happen to be wrong alike and leaves
// out true ones. Their yaw is right all the same. So three translations are
// tried: the one from the clique; its x and y with z over all matches that
// agree with them; and the best x and the best y over all matches, z again over
// those that agree. The one with the least truncated cost in space
// (robust/estimators/consensus.h) wins.

#ifndef QUATRO_ROBUST_ESTIMATORS_RECOVERY_H_
#define QUATRO_ROBUST_ESTIMATORS_RECOVERY_H_

#include "features/base/rigid3.h"
#include "features/base/types.h"

namespace quatro {

// `target_from_source` is the pose with the translation from the clique;
// `noise_bound` [m].
Rigid3 RecoverTranslation(const PointsRef& source,
                          const PointsRef& target,
                          const Rigid3& target_from_source,
                          double noise_bound);

}  // namespace quatro

#endif  // QUATRO_ROBUST_ESTIMATORS_RECOVERY_H_
