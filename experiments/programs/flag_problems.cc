// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/programs/flag_problems.h"

#include "robust/registration/presets.h"

namespace quatro {

std::optional<RegistrationOptions> FindPreset(const std::string& name,
                                              std::string* error) {
  auto options = MakePreset(name);
  if (options) return options;
  std::string all;
  for (const std::string& known : PresetNames()) all += " " + known;
  *error = FlagProblem("preset", name, "one of" + all);
  return std::nullopt;
}

}  // namespace quatro
