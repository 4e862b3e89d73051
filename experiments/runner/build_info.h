// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The source and compiler of this program, and the machine on which it runs.

#ifndef QUATRO_EXPERIMENTS_RUNNER_BUILD_INFO_H_
#define QUATRO_EXPERIMENTS_RUNNER_BUILD_INFO_H_

#include <string>

namespace quatro {

struct BuildInfo {
  std::string version;   // "0.2.0"
  std::string commit;    // 12 digits, then "-dirty" if files differ from it;
                         // "unknown" if not built in a clone.
  std::string compiler;  // "gcc 12.2.0, Release"
};

BuildInfo GetBuildInfo();

struct MachineInfo {
  int cores = 0;
  std::string cpu;      // The model's name, or "unknown".
  long memory_mib = 0;  // 0: unknown.
};

MachineInfo GetMachineInfo();

// "2026-01-31T23:59:59Z"
std::string UtcNow();

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_RUNNER_BUILD_INFO_H_
