// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// What both doors of robust/registration/registration.h share: the options of
// the method, and the way through level frames and back.

#ifndef QUATRO_ROBUST_REGISTRATION_DOOR_H_
#define QUATRO_ROBUST_REGISTRATION_DOOR_H_

#include <string>

#include "robust/estimators/pose_summary.h"
#include "robust/registration/front_end.h"
#include "robust/registration/ins.h"
#include "robust/registration/matches.h"
#include "robust/registration/options.h"
#include "robust/registration/summary.h"

namespace quatro {

// The options as the method adjusts them, with shared values, and its solver:
// empty for a method that works on clouds.
struct Prepared {
  RegistrationOptions options;
  PoseSolver solver;
  bool works_on_matches = true;
};

// Returns false and sets *error if there is no such method, or an option is out
// of range.
bool Prepare(const RegistrationOptions& options,
             Prepared* prepared,
             std::string* error);

// Adds to the summary what is found in these level frames: rung 0 on the
// matches, and the ladder if there are clouds. `clouds` is null without.
void RegisterBehindDoor(const Matches& matches,
                        const MatchedClouds* clouds,
                        const LevelFrames& frames,
                        const Prepared& prepared,
                        RegistrationSummary* summary);

// The same for matched clouds, whose front end is part of the summary.
RegistrationSummary RegisterIn(const LevelFrames& frames,
                               const MatchedClouds& clouds,
                               const Prepared& prepared);

// Whether `a` is the better answer: registered, or more probable.
bool IsBetter(const RegistrationSummary& a, const RegistrationSummary& b);

}  // namespace quatro

#endif  // QUATRO_ROBUST_REGISTRATION_DOOR_H_
