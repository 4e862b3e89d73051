// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Registers clouds whose vertical may not be the one stated: as stated; if that
// pose is not registered, in the level frames that the matches give, and then
// in those of the normals (robust/registration/gravity.h). The answer is the
// first pose that is registered, otherwise the most probable one.

#ifndef QUATRO_ROBUST_REGISTRATION_ANY_VERTICAL_H_
#define QUATRO_ROBUST_REGISTRATION_ANY_VERTICAL_H_

#include "robust/registration/door.h"
#include "robust/registration/front_end.h"
#include "robust/registration/options.h"
#include "robust/registration/summary.h"

namespace quatro {

// Whether these options let the scans give the vertical. The method must
// search, and neither an INS nor bounds on the pose say which way is up.
bool MayLevelByScans(const RegistrationOptions& options);

// For Gravity::kNone the stated vertical is tried only if the clouds have no
// normals.
RegistrationSummary RegisterByAnyVertical(const MatchedClouds& clouds,
                                          const Prepared& prepared);

}  // namespace quatro

#endif  // QUATRO_ROBUST_REGISTRATION_ANY_VERTICAL_H_
