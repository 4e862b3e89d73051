// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/programs/flag_problems.h"

#include <gflags/gflags.h>

#include <algorithm>

#include "experiments/base/number_text.h"
#include "robust/registration/presets.h"

namespace quatro {

std::string UnknownPreset(const std::string& name, bool has_auto) {
  std::string all;
  for (const std::string& known : PresetNames()) {
    all += (all.empty() ? "" : ", ") + known;
  }
  return FlagProblem(
      "preset", name, "one of " + all + (has_auto ? ", auto" : ""));
}

std::optional<RegistrationOptions> FindPreset(const std::string& name,
                                              std::string* error) {
  auto options = MakePreset(name);
  if (!options) *error = UnknownPreset(name, /*has_auto=*/false);
  return options;
}

bool IsListed(std::string_view list, std::string_view name) {
  const auto names = SplitFields(list, ", ");
  return std::ranges::find(names, name) != names.end();
}

bool UsesAllFlags(const std::string& protocol,
                  std::span<const FlagUse> uses,
                  std::string* error) {
  for (const auto& [name, protocols] : uses) {
    if (gflags::GetCommandLineFlagInfoOrDie(name).is_default ||
        IsListed(protocols, protocol)) {
      continue;
    }
    *error = std::string("--") + name +
             " cannot be used with --protocol=" + protocol +
             ", only with: " + std::string(protocols);
    return false;
  }
  return true;
}

}  // namespace quatro
