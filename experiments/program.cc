// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/program.h"

#include <gflags/gflags.h>

#include <quatro/version.h>
#include <cstdio>
#include <cstdlib>

DECLARE_bool(help);
DECLARE_bool(helpshort);
DECLARE_bool(version);

namespace GFLAGS_NAMESPACE {
extern void (*gflags_exitfunc)(int);  // Called after a flag that is wrong.
}

namespace quatro {

std::optional<int> ParseFlags(const std::string& usage,
                              const std::string& main_file,
                              int argc,
                              char** argv) {
  gflags::SetUsageMessage(usage);
  GFLAGS_NAMESPACE::gflags_exitfunc = [](int) { std::exit(kExitBadInput); };
  gflags::ParseCommandLineNonHelpFlags(&argc, &argv, true);
  if (FLAGS_version) {
    std::printf(
        "%s %s\n", gflags::ProgramInvocationShortName(), QUATRO_VERSION);
    return kExitDone;
  }
  if (FLAGS_help || FLAGS_helpshort) {
    gflags::ShowUsageWithFlagsRestrict(argv[0], main_file.c_str());
    return kExitDone;
  }
  if (argc > 1) return Fail(std::string(argv[1]) + ": not a flag");
  return std::nullopt;
}

int Fail(const std::string& error) {
  std::fprintf(
      stderr, "%s: %s\n", gflags::ProgramInvocationShortName(), error.c_str());
  return kExitBadInput;
}

}  // namespace quatro
