// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/programs/program.h"

#include <fcntl.h>
#include <gflags/gflags.h>
#include <unistd.h>

#include <quatro/version.h>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <system_error>
#include <vector>

#include "experiments/base/flag_files.h"
#include "experiments/base/one_line.h"
#include "experiments/base/outputs.h"
#include "experiments/base/progress_line.h"
#include "experiments/programs/bad_flag.h"

DECLARE_bool(help);
DECLARE_bool(helpshort);
DECLARE_bool(version);

namespace GFLAGS_NAMESPACE {
extern void (*gflags_exitfunc)(int);  // Called after an invalid flag.
}

namespace quatro {
namespace {

// Creates no string, because there may be no memory for it.
void TellOutOfMemory() {
  EndProgressLine();
  std::fprintf(stderr,
               "%s: out of memory; free some, raise the limit (ulimit -v), or "
               "take fewer --threads or a smaller input\n",
               gflags::ProgramInvocationShortName());
}

// Whether memory ran out. EAGAIN means that a thread could not be started,
// because there is no memory for its stack.
bool IsForMemory(const std::system_error& error) {
  return error.code() == std::errc::resource_unavailable_try_again ||
         error.code() == std::errc::not_enough_memory;
}

// Prints the message of the exception that is being handled.
void TellException() {
  try {
    throw;
  } catch (const std::bad_alloc&) {
    return TellOutOfMemory();
  } catch (const std::system_error& error) {
    if (IsForMemory(error)) return TellOutOfMemory();
    Fail(std::string(error.what()) + "; not expected here, please report it");
  } catch (const std::exception& error) {
    Fail(std::string(error.what()) + "; not expected here, please report it");
  }
}

// Ends the program after an exception that is not caught on its thread, for
// example a thread of a library.
[[noreturn]] void EndOrderly() {
  if (!std::current_exception()) std::abort();
  try {
    TellException();
  } catch (...) {
    std::abort();
  }
  std::_Exit(kExitStopped);
}

// Opens /dev/null in place of closed standard streams. Otherwise the first
// files that are opened would receive what is printed. Printing fails as before
// because the direction is the opposite one.
void OpenStandardStreams() {
  for (const int fd : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(fd, F_GETFD) >= 0) continue;
    const int mode = fd == STDIN_FILENO ? O_WRONLY : O_RDONLY;
    if (open("/dev/null", mode) != fd) std::_Exit(kExitBadInput);
  }
}

}  // namespace

int RunProgram(const std::function<int(int argc, char** argv)>& run,
               int argc,
               char** argv) {
  OpenStandardStreams();
  // Beyond ulimit -f, a write fails instead.
  std::signal(SIGXFSZ, SIG_IGN);
  std::set_terminate(EndOrderly);
  try {
    const int exit_code = run(argc, argv);
    const bool has_answer =
        exit_code == kExitDone || exit_code == kExitNotVouchedFor;
    std::string error;
    return has_answer && !FlushOutput(&error) ? Fail(error) : exit_code;
  } catch (const std::exception&) {
    TellException();
  }
  return kExitStopped;
}

std::optional<int> ParseFlags(const std::string& usage, int argc, char** argv) {
  gflags::SetUsageMessage(usage + " Exits with 3 if memory runs out.");
  GFLAGS_NAMESPACE::gflags_exitfunc = [](int) { std::exit(kExitBadInput); };
  // Fail() prints the program's name.
  gflags::SetArgv(argc, const_cast<const char**>(argv));
  std::string error;
  auto arguments = ExpandFlagFiles({argv + 1, argv + argc}, &error);
  if (!arguments) return Fail(error);
  if (const auto problem = TellBadFlag(*arguments)) return Fail(*problem);
  std::vector<char*> expanded = {argv[0]};
  for (std::string& argument : *arguments) expanded.push_back(argument.data());
  argc = static_cast<int>(expanded.size());
  expanded.push_back(nullptr);
  argv = expanded.data();
  gflags::ParseCommandLineNonHelpFlags(&argc, &argv, true);
  if (FLAGS_version) {
    std::printf(
        "%s %s\n", gflags::ProgramInvocationShortName(), QUATRO_VERSION);
    return kExitDone;
  }
  if (FLAGS_help || FLAGS_helpshort) {
    gflags::ShowUsageWithFlagsRestrict(argv[0], "/programs/");
    return kExitDone;
  }
  if (argc > 1) return Fail(TellNoFlag(argv[1]));
  return std::nullopt;
}

int Fail(const std::string& error) {
  EndProgressLine();
  std::fprintf(stderr,
               "%s: %s\n",
               gflags::ProgramInvocationShortName(),
               SpellAsFlags(OneLine(error)).c_str());
  return kExitBadInput;
}

}  // namespace quatro
