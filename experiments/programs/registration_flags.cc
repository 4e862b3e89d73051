// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/programs/registration_flags.h"

#include <algorithm>
#include <string_view>

#include "experiments/programs/methods.h"
#include "robust/registration/methods.h"

namespace quatro {
namespace {

// Sets the option of this name. Returns false and sets *error if there is none,
// or for a value of another type.
bool SetOption(const OptionList& list,
               const std::string& name,
               const std::string& value,
               std::string* error) {
  std::string known;
  for (const Option& option : list) {
    if (option.name == name) return option.Parse(value, error);
    known += (known.empty() ? "" : ", ") + option.name;
  }
  *error = "no option " + name + ", must be one of " + known;
  return false;
}

// "name=value;name=value".
bool SetOptions(const OptionList& list,
                std::string_view text,
                std::string* error) {
  while (!text.empty()) {
    const std::string_view part = text.substr(0, text.find(';'));
    text.remove_prefix(std::min(text.size(), part.size() + 1));
    const std::size_t equals = part.find('=');
    if (equals == std::string_view::npos) {
      *error = std::string(part) + ", must be name=value";
      return false;
    }
    if (!SetOption(list,
                   std::string(part.substr(0, equals)),
                   std::string(part.substr(equals + 1)),
                   error)) {
      return false;
    }
  }
  return true;
}

bool SetSwitch(const OptionList& list,
               const std::string& flag,
               const std::string& option,
               const std::string& value,
               std::string* error) {
  if (value.empty() || SetOption(list, option, value, error)) return true;
  *error = "--" + flag + "=" + value + ", must be on or off";
  return false;
}

// What a method that starts from a guess has no use for.
bool CanStartFromGuess(const RegistrationFlags& flags,
                       const RegistrationOptions& options,
                       std::string* error) {
  const char* unused = nullptr;
  if (!flags.refine.empty() && flags.refine != "none") unused = "refine";
  if (options.ins.up != Eigen::Vector3d::UnitZ()) unused = "gravity";
  if (options.ins.mode != InsMode::kNone) unused = "ins_mode";
  if (unused == nullptr) return true;
  *error =
      std::string("--") + unused + " does not go with --method=" + flags.method;
  return false;
}

bool CheckMethod(const RegistrationFlags& flags,
                 bool has_clouds,
                 const RegistrationOptions& options,
                 std::string* error) {
  if (has_clouds ? !FindPairSolver(flags.method, {}, error)
                 : !FindMatchSolver(flags.method, {}, error)) {
    return false;
  }
  if (StartsFromGuess(flags.method)) {
    return CanStartFromGuess(flags, options, error);
  }
  std::string ignored;
  const Method* method = FindMethod(flags.method, &ignored);
  if (method != nullptr) return CanUseIns(*method, options.ins, error);
  if (options.ins.IsPlain()) return true;
  *error = "--ins_mode and --gravity do not go with --method=" + flags.method;
  return false;
}

}  // namespace

bool StartsFromGuess(const std::string& method) {
  const auto names = ExperimentMethodNames(MethodInput::kClouds);
  return std::find(names.begin(), names.end(), method) != names.end();
}

bool ApplyFlags(const RegistrationFlags& flags,
                bool has_clouds,
                RegistrationOptions* options,
                std::string* error) {
  if (flags.noise_bound != 0.0) options->noise_bound = flags.noise_bound;
  options->seed = flags.seed;
  options->num_threads = flags.threads;
  options->quatro.crosscheck = flags.crosscheck;
  options->teaser.crosscheck = flags.crosscheck;
  const OptionList quatro = QuatroOptionList(options);
  if (!SetSwitch(
          quatro, "recover", "recover_translation", flags.recover, error) ||
      !SetSwitch(quatro, "polish", "polish", flags.polish, error)) {
    return false;
  }
  if (!flags.refine.empty() &&
      !SetOption(
          RefinementOptionList(options), "refine", flags.refine, error)) {
    return false;
  }
  const auto ins = ParseInsFlags(flags.ins, error);
  if (!ins) return false;
  options->ins = *ins;
  const auto bounds =
      ParseBoundFlags(flags.bounds, StartsFromGuess(flags.method), error);
  if (!bounds) return false;
  options->bounds = *bounds;
  if (!CheckMethod(flags, has_clouds, *options, error)) return false;
  std::string ignored;
  const Method* method = FindMethod(flags.method, &ignored);
  if (method != nullptr) options->method = method->name;
  if (!flags.options.empty() &&
      !SetOptions(method ? OptionsOf(*method, has_clouds, options)
                         : CommonOptions(options),
                  flags.options,
                  error)) {
    *error = "--options: " + *error;
    return false;
  }
  return options->IsValid(error);
}

std::string DescribeOptionsOf(const std::string& method,
                              bool has_clouds,
                              std::string* error) {
  const Method* found = FindMethod(method, error);
  if (found == nullptr) return {};
  RegistrationOptions options;
  std::string text;
  for (const Option& option : OptionsOf(*found, has_clouds, &options)) {
    text += option.name + "  " + option.Describe() + "\n";
  }
  return text;
}

}  // namespace quatro
