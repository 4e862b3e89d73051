// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A guess of the pose and bounds about it on the command line, in degrees.

#ifndef QUATRO_EXPERIMENTS_PROGRAMS_BOUND_FLAGS_H_
#define QUATRO_EXPERIMENTS_PROGRAMS_BOUND_FLAGS_H_

#include <optional>
#include <string>

#include "robust/estimators/pose_bounds.h"

namespace quatro {

// The flags --guess, --max_translation, --max_yaw_deg and --max_tilt_deg.
struct BoundFlags {
  // target_from_source: a text file, or the numbers themselves. 12 or 16 of
  // them are rows of a matrix; 4 are x,y,z,yaw_deg.
  std::string guess;
  double max_translation = 0.0;  // [m]; 0: any.
  double max_yaw_deg = 180.0;
  double max_tilt_deg = 5.0;
};

// Returns nullopt, with *error set to the invalid flag and the reason. A guess
// without bounds is refused unless the method starts from it (`is_local`).
std::optional<PoseBounds> ParseBoundFlags(const BoundFlags& flags,
                                          bool is_local,
                                          std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PROGRAMS_BOUND_FLAGS_H_
