// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/programs/bad_flag.h"

#include <gflags/gflags.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <numeric>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include "robust/registration/methods.h"

namespace quatro {
namespace {

// The largest edit distance of a misspelled name: letters to insert, remove or
// replace.
constexpr std::size_t kMaxMisspelled = 3;

std::size_t EditDistance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({row[j] + 1, row[j + 1] + 1, replaced});
    }
  }
  return row.back();
}

// Whether this is a flag of gflags itself, such as --flagfile, which may be
// repeated and must not be set here.
bool IsOfGflags(const gflags::CommandLineFlagInfo& flag) {
  return flag.filename.find("gflags") != std::string::npos;
}

bool IsFlag(const std::string& name) {
  gflags::CommandLineFlagInfo flag;
  return gflags::GetCommandLineFlagInfo(name.c_str(), &flag) &&
         !IsOfGflags(flag);
}

std::string NearestFlag(const std::string& name) {
  std::vector<gflags::CommandLineFlagInfo> flags;
  gflags::GetAllFlags(&flags);
  std::vector<std::string> names;
  for (const gflags::CommandLineFlagInfo& flag : flags) {
    if (!IsOfGflags(flag)) names.push_back(flag.name);
  }
  return NearestName(name, names);
}

// The flags that quatro_register or quatro_solve has and the other lacks.
constexpr std::pair<std::string_view, const char*> kFlagsOfOneProgram[] = {
    {"correspondences", "quatro_solve"},
    {"correspondences_out", "quatro_register"},
    {"fpfh_radius", "quatro_register"},
    {"normal_radius", "quatro_register"},
    {"output", "quatro_register"},
    {"output_clouds", "quatro_register"},
    {"point_floats", "quatro_register"},
    {"refine", "quatro_register"},
    {"report", "quatro_register"},
    {"source", "quatro_register"},
    {"target", "quatro_register"},
    {"voxel_size", "quatro_register"}};

// Whether a method on clouds, or on matches alone, has an option of this name.
bool IsOption(const std::string& name, bool has_clouds) {
  RegistrationOptions options;
  return std::ranges::any_of(Methods(), [&](const Method& method) {
    return std::ranges::any_of(
        OptionsOf(method, has_clouds, &options),
        [&](const Option& option) { return option.name == name; });
  });
}

// Describes an unknown flag that is one of another program, or an option. Empty
// if it is neither, or if an option has a flag with a similar name.
std::string TellFlagOfAnother(const std::string& name) {
  const std::string unknown = "has no flag --" + name + "; it is one of ";
  for (const auto& [flag, program] : kFlagsOfOneProgram) {
    if (name == flag) return unknown + program + "'s";
  }
  if (!IsFlag("options") || IsFlag(name + "_deg") || name == "num_threads") {
    return "";
  }
  const std::string as_option = "--options=" + name + "=...";
  if (IsOption(name, IsFlag("source"))) {
    return "--" + name + ": is an option, not a flag; write " + as_option +
           "; --list_options lists all";
  }
  return IsOption(name, /*has_clouds=*/true)
             ? unknown + "quatro_register's options, " + as_option
             : "";
}

// Describes the values of a type of gflags.
std::string Describe(const std::string& type) {
  if (type == "bool") return "true or false";
  if (type == "double") return "a number";
  if (type == "int32") return "a whole number from -2147483648 to 2147483647";
  if (type == "uint64") {
    return "a whole number from 0 to 18446744073709551615";
  }
  return "of type " + type;
}

// Sets the flag, except for a flag of gflags itself, and returns whether the
// value has its type.
bool CanHold(const gflags::CommandLineFlagInfo& flag,
             const std::string& value) {
  return IsOfGflags(flag) ||
         !gflags::SetCommandLineOption(flag.name.c_str(), value.c_str())
              .empty();
}

std::string Twice(const std::string& name) {
  return "--" + name + ": is given twice, must be given once";
}

bool IsPartOfWord(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
         (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '.' || c == '/';
}

// Options that may occur anywhere in a message of the library, and their flags.
constexpr std::pair<const char*, const char*> kOptionsInMessages[] = {
    {"point_floats", "point_floats"},
    {"first_frame", "first_frame"},
    {"last_frame", "last_frame"},
    {"ins_mode", "ins_mode"},
    {"source_rpy", "source_rpy_deg"},
    {"target_rpy", "target_rpy_deg"},
    {"max_translation", "max_translation"},
    {"max_yaw_deg", "max_yaw_deg"}};

void ReplaceWord(std::string_view word,
                 const std::string& replacement,
                 std::string* message) {
  std::size_t i = 0;
  while ((i = message->find(word, i)) != std::string::npos) {
    const std::size_t end = i + word.size();
    const bool is_part =
        (i > 0 && IsPartOfWord((*message)[i - 1])) ||
        (end < message->size() && IsPartOfWord((*message)[end]));
    if (!is_part) message->replace(i, word.size(), replacement);
    i += is_part ? word.size() : replacement.size();
  }
}

// Replaces "name = " by "--name=" wherever `name` is a flag, at the start of
// the message or after a space or a bracket. "num_pairs" stands for the flag
// --pairs if there is no --num_pairs.
void ReplaceAssignments(std::string* message) {
  constexpr std::string_view kIs = " = ", kNumber = "num_";
  std::size_t is = 0;
  while ((is = message->find(kIs, is)) != std::string::npos) {
    std::size_t begin = is;
    while (begin > 0 && IsPartOfWord((*message)[begin - 1])) --begin;
    std::string name = message->substr(begin, is - begin);
    if (!IsFlag(name) && name.starts_with(kNumber)) {
      name.erase(0, kNumber.size());
    }
    const bool follows_quote =
        begin > 0 && std::string_view(" [(").find((*message)[begin - 1]) ==
                         std::string_view::npos;
    if (!IsFlag(name) || follows_quote) {
      is += kIs.size();
      continue;
    }
    const std::string flag = "--" + name + "=";
    message->replace(begin, is + kIs.size() - begin, flag);
    is = begin + flag.size();
  }
}

}  // namespace

std::string NearestName(const std::string& name,
                        const std::vector<std::string>& names) {
  // A part of another name, or that name with more, such as num_threads.
  constexpr std::size_t kMinPart = 5;
  for (const std::string& known : names) {
    if ((name.size() >= kMinPart && known.starts_with(name)) ||
        (known.size() >= kMinPart && name.ends_with("_" + known))) {
      return known;
    }
  }
  // A short name is within a small edit distance of many names.
  std::string nearest;
  std::size_t least = std::min(kMaxMisspelled, name.size() / 2) + 1;
  for (const std::string& known : names) {
    const std::size_t distance = EditDistance(name, known);
    if (distance >= least) continue;
    least = distance;
    nearest = known;
  }
  if (!nearest.empty() || name.size() < kMinPart) return nearest;
  const auto last_part = std::ranges::find_if(
      names, [&](const auto& known) { return known.ends_with("_" + name); });
  return last_part == names.end() ? "" : *last_part;
}

std::string SpellAsFlags(std::string message) {
  constexpr std::string_view kMethod = "method ";
  if (!message.starts_with("--")) ReplaceAssignments(&message);
  if (message.starts_with(kMethod) && IsFlag("method")) {
    message = "--" + message.replace(0, kMethod.size(), "method=");
  }
  for (const auto& [option, flag] : kOptionsInMessages) {
    if (IsFlag(flag)) ReplaceWord(option, "--" + std::string(flag), &message);
  }
  return message;
}

std::optional<std::string> TellBadFlag(
    const std::vector<std::string>& arguments) {
  std::set<std::string> given;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& argument = arguments[i];
    const std::size_t begin = argument.find_first_not_of('-');
    if (argument == "--") break;
    if (begin == 0 || begin == std::string::npos) continue;
    const std::size_t equals = argument.find('=');
    const std::string name = argument.substr(begin, equals - begin);
    if (name == "undefok") return std::nullopt;
    gflags::CommandLineFlagInfo flag;
    if (gflags::GetCommandLineFlagInfo(name.c_str(), &flag)) {
      if (!IsOfGflags(flag) && !given.insert(name).second) return Twice(name);
      const bool is_alone = equals == std::string::npos;
      if (is_alone && flag.type == "bool") continue;
      // The next argument is the value, even if it starts with a dash.
      if (is_alone && ++i == arguments.size()) break;
      const std::string value =
          is_alone ? arguments[i] : argument.substr(equals + 1);
      if (CanHold(flag, value)) continue;
      return "--" + name + "=" + value + ", must be " + Describe(flag.type);
    }
    if (name.starts_with("no") &&
        gflags::GetCommandLineFlagInfo(name.c_str() + 2, &flag) &&
        flag.type == "bool") {
      if (!given.insert(flag.name).second) return Twice(flag.name);
      continue;
    }
    const std::string of_another = TellFlagOfAnother(name);
    if (!of_another.empty()) return of_another;
    const std::string nearest = NearestFlag(name);
    return "--" + name + ": unknown flag" +
           (nearest.empty() ? "" : ", did you mean --" + nearest) +
           "; --help lists all";
  }
  return std::nullopt;
}

std::string TellNoFlag(const std::string& argument) {
  for (const char* dash : {"\u2012", "\u2013", "\u2014", "\u2015", "\u2212"}) {
    if (argument.starts_with(dash)) {
      return argument + ": starts with a long dash, must start with --";
    }
  }
  std::string problem = argument + ": not a flag, must be --name=value";
  std::error_code ignored;
  for (const char* name : {"source", "target", "correspondences", "input"}) {
    gflags::CommandLineFlagInfo flag;
    if (std::filesystem::exists(argument, ignored) &&
        gflags::GetCommandLineFlagInfo(name, &flag) && flag.is_default) {
      problem += ", for example --" + flag.name + "=" + argument;
      break;
    }
  }
  return problem + "; --help lists all";
}

}  // namespace quatro
