// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A whole program, run again and again within one process: its main() is
// compiled under another name (see CMakeLists.txt).

#ifndef QUATRO_TESTS_FUZZ_WHOLE_PROGRAM_H_
#define QUATRO_TESTS_FUZZ_WHOLE_PROGRAM_H_

#include <gflags/gflags.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "features/base/file.h"
#include "tests/fuzz/fuzz.h"

int ProgramMain(int argc, char** argv);

namespace quatro {

// Takes lines "--NAME=VALUE" off the start of the text and sets those flags
// that are in `names` and take that value, as the command line would.
inline void TakeFlags(const std::vector<std::string>& names,
                      std::string_view* text) {
  while (text->starts_with("--")) {
    const std::size_t end = text->find('\n');
    const std::string_view line = text->substr(2, end - 2);
    text->remove_prefix(end == std::string_view::npos ? text->size() : end + 1);
    // Of an argument there is nothing after a zero.
    const std::string flag(line.substr(0, line.find('\0')));
    const std::size_t equals = std::min(flag.find('='), flag.size());
    const std::string name = flag.substr(0, equals);
    if (equals == flag.size() ||
        std::find(names.begin(), names.end(), name) == names.end()) {
      continue;
    }
    gflags::SetCommandLineOption(name.c_str(), flag.c_str() + equals + 1);
  }
}

inline void SetFlag(const char* name, const std::string& value) {
  CHECK(!gflags::SetCommandLineOption(name, value.c_str()).empty()) << name;
}

inline int RunMain() {
  std::string name = "program";
  char* args[] = {name.data(), nullptr};
  return ProgramMain(1, args);
}

// What either registering program leaves: exit code and report are of one mind.
inline void CheckReport(int exit_code, const std::string& path) {
  CHECK(exit_code >= 0 && exit_code <= 2) << exit_code;
  std::string error;
  const auto text = ReadWholeFile(path, &error);
  CHECK_EQ(text.has_value(), exit_code != 2);
  if (!text) return;
  const auto report = nlohmann::json::parse(*text);
  CHECK_EQ(report["status"] == "registered", exit_code == 0);
  CHECK(!report["reason"].get<std::string>().empty());
  if (report["target_from_source"].is_null()) {
    CHECK_EQ(exit_code, 1);
    return;
  }
  for (const auto& row : report["target_from_source"]) {
    for (const auto& number : row) {
      CHECK(number.is_number() && std::isfinite(number.get<double>()))
          << report["target_from_source"];
    }
  }
}

}  // namespace quatro

#endif  // QUATRO_TESTS_FUZZ_WHOLE_PROGRAM_H_
