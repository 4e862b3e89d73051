// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Messages about flags that are out of range, with the value and the allowed
// values.

#ifndef QUATRO_EXPERIMENTS_PROGRAMS_FLAG_PROBLEMS_H_
#define QUATRO_EXPERIMENTS_PROGRAMS_FLAG_PROBLEMS_H_

#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <string_view>

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

// "--preset=moon, must be one of kitti, ...": the names of all presets, and
// auto if the program has it.
std::string UnknownPreset(const std::string& name, bool has_auto);

// The preset of this name. If it does not exist, returns nullopt and lists all
// presets in *error.
std::optional<RegistrationOptions> FindPreset(const std::string& name,
                                              std::string* error);

// A flag, and the values of --protocol that use it: "loop, timing".
struct FlagUse {
  const char* name;
  std::string_view protocols;
};

// Whether `name` is in a list "a, b".
bool IsListed(std::string_view list, std::string_view name);

// Returns false and sets *error if a flag is given that the protocol ignores.
bool UsesAllFlags(const std::string& protocol,
                  std::span<const FlagUse> uses,
                  std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PROGRAMS_FLAG_PROBLEMS_H_
