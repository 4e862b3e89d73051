// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// What every program does before its own work, and how it ends.

#ifndef QUATRO_EXPERIMENTS_PROGRAMS_PROGRAM_H_
#define QUATRO_EXPERIMENTS_PROGRAMS_PROGRAM_H_

#include <functional>
#include <optional>
#include <string>

namespace quatro {

enum ExitCode {
  kExitDone = 0,  // Of the registering programs: registered.
  kExitNotVouchedFor =
      1,              // There may be an answer; the JSON says what is wrong.
  kExitBadInput = 2,  // Flags or files; one line on stderr says which.
  kExitStopped = 3,   // On request, or for want of memory.
};

// The whole of a program: run(argc, argv) gives its exit code. Where there is
// not enough memory for it, one line on stderr says so, and the exit code is
// kExitStopped; so for all else that a library throws. Where standard output
// could not be written, one line says that, and the exit code is kExitBadInput.
int RunProgram(const std::function<int(int argc, char** argv)>& run,
               int argc,
               char** argv);

// Parses the flags. Returns the exit code if the program is to end here: after
// --help or --version, or for a flag or argument that is not known. `main_file`
// is the name of the program's source without its ending: --help shows its
// flags alone.
std::optional<int> ParseFlags(const std::string& usage,
                              const std::string& main_file,
                              int argc,
                              char** argv);

// Prints "<program>: <error>" on stderr and returns kExitBadInput.
int Fail(const std::string& error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PROGRAMS_PROGRAM_H_
