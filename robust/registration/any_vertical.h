// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Registers clouds whose stated vertical may be wrong. Level frames are tried
// in this order: by the stated vertical, by the matches, by the normals
// (robust/registration/gravity.h). The result is the first pose that is
// registered; if none is, the most probable one.

#ifndef QUATRO_ROBUST_REGISTRATION_ANY_VERTICAL_H_
#define QUATRO_ROBUST_REGISTRATION_ANY_VERTICAL_H_

#include "robust/registration/door.h"
#include "robust/registration/front_end.h"
#include "robust/registration/options.h"
#include "robust/registration/summary.h"

namespace quatro {

// Whether the vertical may come from the scans. This requires Gravity::kScans
// or kNone and a method that searches, without an INS or bounds on the pose.
bool MayLevelByScans(const RegistrationOptions& options);

// With Gravity::kNone, the stated vertical is tried only if the scans give no
// level frames.
RegistrationSummary RegisterByAnyVertical(const MatchedClouds& clouds,
                                          const Prepared& prepared);

}  // namespace quatro

#endif  // QUATRO_ROBUST_REGISTRATION_ANY_VERTICAL_H_
