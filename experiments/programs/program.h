// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Common startup and exit of all programs.

#ifndef QUATRO_EXPERIMENTS_PROGRAMS_PROGRAM_H_
#define QUATRO_EXPERIMENTS_PROGRAMS_PROGRAM_H_

#include <functional>
#include <optional>
#include <string>

namespace quatro {

enum ExitCode {
  kExitDone = 0,           // Registration programs: registered.
  kExitNotVouchedFor = 1,  // Not registered; the JSON gives the reason.
  kExitBadInput = 2,       // Flag or file; one line on stderr says which.
  kExitStopped = 3,        // Interrupted, out of memory or another exception.
};

// Runs a whole program: run(argc, argv) returns its exit code. If memory runs
// out or a library throws an exception, prints one line on stderr and returns
// kExitStopped. If standard output cannot be written, prints one line on stderr
// and returns kExitBadInput.
int RunProgram(const std::function<int(int argc, char** argv)>& run,
               int argc,
               char** argv);

// Parses the flags. Returns an exit code if the program should end: after
// --help or --version, or for an unknown flag or argument. --help shows only
// the flags that sources in experiments/programs/ define.
std::optional<int> ParseFlags(const std::string& usage, int argc, char** argv);

// Prints "<program>: <error>" on stderr, with options spelled as flags
// (bad_flag.h), and returns kExitBadInput.
int Fail(const std::string& error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PROGRAMS_PROGRAM_H_
