// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Flags for an INS. Angles are in degrees here, and in radians in the library.

#ifndef QUATRO_EXPERIMENTS_PROGRAMS_INS_FLAGS_H_
#define QUATRO_EXPERIMENTS_PROGRAMS_INS_FLAGS_H_

#include <optional>
#include <string>

#include "robust/registration/ins.h"

namespace quatro {

// The flags as given: --ins_mode, --source_rpy_deg, --target_rpy_deg,
// --ins_std_deg and --gravity.
struct InsFlags {
  std::string mode = "none";   // none, relative, leveled or fused.
  std::string source_rpy_deg;  // "roll,pitch,yaw"
  std::string target_rpy_deg;
  double std_deg = 0.5;
  // The up direction, nonzero; or scans or none (robust/registration/ins.h).
  std::string gravity = "0,0,1";
};

// Returns "none", "relative", "leveled" or "fused".
const char* InsModeName(InsMode mode);

// Returns nullopt if a flag is invalid, with the flag and the reason in *error.
// Both attitudes must be given if the mode needs them, and neither if it does
// not.
std::optional<InsOptions> ParseInsFlags(const InsFlags& flags,
                                        std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PROGRAMS_INS_FLAGS_H_
