// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Messages about flags that are out of range, with the value and the allowed
// values.

#ifndef QUATRO_EXPERIMENTS_PROGRAMS_FLAG_PROBLEMS_H_
#define QUATRO_EXPERIMENTS_PROGRAMS_FLAG_PROBLEMS_H_

#include <optional>
#include <sstream>
#include <string>

#include "robust/registration/registration.h"

namespace quatro {

// "--seeds=0, must be 1 to 1000".
template <typename T>
std::string FlagProblem(const std::string& name,
                        const T& value,
                        const std::string& expected) {
  std::ostringstream text;
  text << "--" << name << "=" << value << ", must be " << expected;
  return text.str();
}

// The preset of this name. If it does not exist, returns nullopt and lists all
// presets in *error.
std::optional<RegistrationOptions> FindPreset(const std::string& name,
                                              std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PROGRAMS_FLAG_PROBLEMS_H_
