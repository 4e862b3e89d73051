// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Flags for an initial guess of the pose and for bounds around it. Angles are
// in degrees.

#ifndef QUATRO_EXPERIMENTS_PROGRAMS_BOUND_FLAGS_H_
#define QUATRO_EXPERIMENTS_PROGRAMS_BOUND_FLAGS_H_

#include <optional>
#include <string>

#include "features/base/rigid3.h"
#include "robust/estimators/pose_bounds.h"

namespace quatro {

// The flags --guess, --max_translation, --max_yaw_deg and --max_tilt_deg.
struct BoundFlags {
  // target_from_source: a text file, or the numbers themselves. 12 or 16
  // numbers are the rows of a matrix; 4 numbers are x,y,z,yaw_deg.
  std::string guess;
  double max_translation = 0.0;  // [m]; 0: any.
  double max_yaw_deg = 180.0;
  double max_tilt_deg = 5.0;
};

// The pose in the value of a flag: as BoundFlags::guess, or the JSON of
// quatro_register. Returns nullopt and names the flag in *error if it is none.
std::optional<Rigid3> ParsePose(const std::string& flag,
                                const std::string& value,
                                std::string* error);

// Returns nullopt if a flag is invalid, with the flag and the reason in *error.
// A guess without bounds is invalid unless the method starts from the guess
// (`is_local`).
std::optional<PoseBounds> ParseBoundFlags(const BoundFlags& flags,
                                          bool is_local,
                                          std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PROGRAMS_BOUND_FLAGS_H_
