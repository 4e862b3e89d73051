// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/benchmarks/peak_memory.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace quatro {
namespace {

// Reads a value [bytes] from a line such as "VmRSS:   1234 kB".
std::optional<double> ReadStatus(const std::string& name) {
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with(name + ":")) continue;
    double kilobytes = 0.0;
    std::istringstream number(line.substr(name.size() + 1));
    if (number >> kilobytes) return kilobytes * 1024.0;
  }
  return std::nullopt;
}

}  // namespace

std::optional<double> MeasurePeakMemory(const std::function<void()>& work) {
#if defined(__GLIBC__)
  malloc_trim(0);
#endif
  // Resets the peak to the current resident size.
  std::ofstream reset("/proc/self/clear_refs");
  const bool is_reset = static_cast<bool>(reset << "5" << std::flush);
  const auto before = ReadStatus("VmHWM");
  work();
  const auto peak = ReadStatus("VmHWM");
  if (!is_reset || !before || !peak) return std::nullopt;
  return std::max(0.0, *peak - *before);
}

}  // namespace quatro
