// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The parts shared by the entry points of robust/registration/registration.h:
// the options of the method, and the transformation into level frames and back.

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

// The options, adjusted by the method and with shared values, and the solver,
// which is empty for a method that works on clouds.
struct Prepared {
  RegistrationOptions options;
  PoseSolver solver;
  bool works_on_matches = true;
};

// Returns false and sets *error if there is no such method, if it cannot use
// options.ins, or if an option is out of range.
bool Prepare(const RegistrationOptions& options,
             Prepared* prepared,
             std::string* error);

// Registers in these level frames and adds the result to the summary: rung 0 on
// the matches, then the ladder if there are clouds. `clouds` is null if there
// are only matches.
void RegisterBehindDoor(const Matches& matches,
                        const MatchedClouds* clouds,
                        const LevelFrames& frames,
                        const Prepared& prepared,
                        RegistrationSummary* summary);

// Like RegisterBehindDoor(), for matched clouds. The summary includes the front
// end.
RegistrationSummary RegisterIn(const LevelFrames& frames,
                               const MatchedClouds& clouds,
                               const Prepared& prepared);

// Whether `a` is the better result: registered, or more probable.
bool IsBetter(const RegistrationSummary& a, const RegistrationSummary& b);

}  // namespace quatro

#endif  // QUATRO_ROBUST_REGISTRATION_DOOR_H_
