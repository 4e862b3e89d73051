// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/runner/build_info.h"

#include <quatro/version.h>
#include <unistd.h>

#include <ctime>
#include <fstream>
#include <thread>

#include "experiments/runner/commit_text.h"

namespace quatro {
namespace {

// Reads a line such as "model name        : Fancy CPU".
std::string CpuModel() {
  std::ifstream file("/proc/cpuinfo");
  std::string line;
  while (std::getline(file, line)) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) {
      return line.substr(colon + 2);
    }
  }
  return "unknown";
}

}  // namespace

BuildInfo GetBuildInfo() {
#ifdef __clang__
  const std::string compiler = "clang " __clang_version__;
#else
  const std::string compiler = "gcc " __VERSION__;
#endif
  return {QUATRO_VERSION, QUATRO_COMMIT, compiler + ", " QUATRO_BUILD_TYPE};
}

MachineInfo GetMachineInfo() {
  MachineInfo machine;
  machine.cores = static_cast<int>(std::thread::hardware_concurrency());
  machine.cpu = CpuModel();
  const long pages = sysconf(_SC_PHYS_PAGES);
  const long page_size = sysconf(_SC_PAGE_SIZE);
  if (pages > 0 && page_size > 0) {
    machine.memory_mib = pages / 1024 * page_size / 1024;
  }
  return machine;
}

std::string UtcNow() {
  const std::time_t now = std::time(nullptr);
  std::tm utc = {};
  gmtime_r(&now, &utc);
  char text[32];
  std::strftime(text, sizeof(text), "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

}  // namespace quatro
