// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The flags that quatro_register and quatro_solve share, made into options.

#ifndef QUATRO_EXPERIMENTS_PROGRAMS_REGISTRATION_FLAGS_H_
#define QUATRO_EXPERIMENTS_PROGRAMS_REGISTRATION_FLAGS_H_

#include <cstdint>
#include <string>

#include "experiments/programs/bound_flags.h"
#include "experiments/programs/ins_flags.h"
#include "robust/registration/options.h"

namespace quatro {

// The flags as they were given; zero and empty mean the preset's value.
struct RegistrationFlags {
  std::string method;
  std::string recover;  // "on", "off" or empty.
  std::string polish;   // The same.
  std::string refine;   // Empty without clouds.
  std::string options;  // "name=value;name=value", by --list_options.
  bool crosscheck = false;
  double noise_bound = 0.0;  // [m]
  std::uint64_t seed = 0;
  int threads = 0;
  InsFlags ins;
  BoundFlags bounds;
};

// Whether the method works on clouds alone, from a guess.
bool StartsFromGuess(const std::string& method);

// Sets what the flags ask for. Returns false and sets *error, which names the
// flag, for a value that is not valid or does not go with the method.
bool ApplyFlags(const RegistrationFlags& flags,
                bool has_clouds,
                RegistrationOptions* options,
                std::string* error);

// One line per option of --options that the method takes, with its value in
// preset kitti. Returns an empty text and sets *error for an unknown method.
std::string DescribeOptionsOf(const std::string& method,
                              bool has_clouds,
                              std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PROGRAMS_REGISTRATION_FLAGS_H_
