// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/base/flag_files.h"

#include <cstddef>
#include <string_view>

#include "experiments/base/number_text.h"
#include "features/base/cloud_text.h"
#include "features/base/file.h"

namespace quatro {
namespace {

constexpr int kMaxFlagFiles = 100;

// The flags in the lines of a file.
std::optional<std::vector<std::string>> ReadFlagFile(const std::string& path,
                                                     std::string* error) {
  const auto text = ReadTextFile(path, error);
  if (!text) {
    *error = "--flagfile: " + *error;
    return std::nullopt;
  }
  std::vector<std::string> flags;
  std::string_view rest = *text;
  for (int number = 1; !rest.empty(); ++number) {
    const std::string_view line = Trim(TakeLine(&rest));
    if (line.empty() || line.starts_with("#")) continue;
    if (!line.starts_with("-")) {
      *error = "--flagfile: " + path + ": line " + std::to_string(number) +
               ": " + Quoted(line) + " is not a flag, must be --name=value";
      return std::nullopt;
    }
    flags.emplace_back(line);
  }
  return flags;
}

// Appends the arguments to *expanded. *num_files counts files at all depths.
bool ExpandInto(const std::vector<std::string>& arguments,
                int* num_files,
                std::vector<std::string>* expanded,
                std::string* error) {
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& argument = arguments[i];
    if (argument == "--") {
      expanded->insert(expanded->end(),
                       arguments.begin() + static_cast<std::ptrdiff_t>(i),
                       arguments.end());
      return true;
    }
    const std::size_t equals = argument.find('=');
    const std::string flag = argument.substr(0, equals);
    const std::string name = flag.substr(flag.starts_with("--")  ? 2
                                         : flag.starts_with("-") ? 1
                                                                 : 0);
    const bool is_flag = name.size() < flag.size();
    if (is_flag && (name == "fromenv" || name == "tryfromenv")) {
      *error = "--" + name +
               " is not supported; write the flags on the command line or in a "
               "file, --flagfile";
      return false;
    }
    if (!is_flag || name != "flagfile") {
      expanded->push_back(argument);
      continue;
    }
    std::string paths;
    if (equals != std::string::npos) {
      paths = argument.substr(equals + 1);
    } else if (i + 1 < arguments.size()) {
      paths = arguments[++i];
    }
    if (paths.empty()) {
      *error = "--flagfile is empty, must name a file";
      return false;
    }
    for (const std::string_view path : SplitFields(paths, ",")) {
      if (++*num_files > kMaxFlagFiles) {
        *error = "--flagfile: " + std::string(path) +
                 ": more than 100 files to read; a file must not include "
                 "itself";
        return false;
      }
      const auto flags = ReadFlagFile(std::string(path), error);
      if (!flags || !ExpandInto(*flags, num_files, expanded, error)) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace

std::optional<std::vector<std::string>> ExpandFlagFiles(
    const std::vector<std::string>& arguments, std::string* error) {
  std::vector<std::string> expanded;
  int num_files = 0;
  if (!ExpandInto(arguments, &num_files, &expanded, error)) return std::nullopt;
  return expanded;
}

}  // namespace quatro
