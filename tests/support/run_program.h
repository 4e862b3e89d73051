// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Our programs run as a user runs them, in a folder that is removed afterwards.

#ifndef QUATRO_TESTS_SUPPORT_RUN_PROGRAM_H_
#define QUATRO_TESTS_SUPPORT_RUN_PROGRAM_H_

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace quatro {

struct ProgramRun {
  int exit_code = -1;  // 128 + the signal if one ended it.
  std::string out;
  std::string err;
};

// All that `file` holds.
inline std::string ReadFromStart(std::FILE* file) {
  std::rewind(file);
  std::string bytes;
  char buffer[4096];
  while (const std::size_t n = std::fread(buffer, 1, sizeof(buffer), file)) {
    bytes.append(buffer, n);
  }
  return bytes;
}

// The last of each flag --name=value: a test's own replace its fixture's, which
// the programs would refuse.
inline std::vector<std::string> WithoutReplaced(
    const std::vector<std::string>& args) {
  std::vector<std::string> kept;
  for (std::size_t i = 0; i < args.size(); ++i) {
    const std::string name = args[i].substr(0, args[i].find('=') + 1);
    const bool is_replaced =
        name.starts_with("--") &&
        std::any_of(args.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                    args.end(),
                    [&](const auto& arg) { return arg.starts_with(name); });
    if (!is_replaced) kept.push_back(args[i]);
  }
  return kept;
}

// bin/<name> of the build. With `out_path` its output goes there, and with
// `in_path` its input is this file's.
inline ProgramRun RunProgram(const std::string& name,
                             const std::vector<std::string>& args,
                             const char* out_path = nullptr,
                             const char* in_path = nullptr) {
  std::vector<std::string> command = {std::string(QUATRO_BIN_DIR) + "/" + name};
  for (std::string& arg : WithoutReplaced(args)) {
    command.push_back(std::move(arg));
  }
  std::vector<char*> argv;
  for (std::string& arg : command) argv.push_back(arg.data());
  argv.push_back(nullptr);

  std::FILE* const out =
      out_path == nullptr ? std::tmpfile() : std::fopen(out_path, "w");
  std::FILE* const err = std::tmpfile();
  ProgramRun run;
  const pid_t child = fork();
  if (child == 0) {
    if (in_path != nullptr && !std::freopen(in_path, "r", stdin)) _exit(127);
    dup2(fileno(out), STDOUT_FILENO);
    dup2(fileno(err), STDERR_FILENO);
    execv(argv[0], argv.data());
    _exit(127);
  }
  int status = 0;
  if (child > 0 && waitpid(child, &status, 0) == child) {
    run.exit_code =
        WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
  run.out = ReadFromStart(out);
  run.err = ReadFromStart(err);
  std::fclose(out);
  std::fclose(err);
  EXPECT_NE(run.exit_code, 127) << command[0] << " could not be run";
  return run;
}

// The report without what may differ from run to run, as bytes.
inline std::string WithoutTimings(const std::string& json) {
  auto report = nlohmann::ordered_json::parse(json);
  EXPECT_EQ(report.erase("timings_ms"), 1u);
  return report.dump(2);
}

// The eight bytes every PNG starts with.
inline constexpr char kPngSignature[] = "\x89PNG\r\n\x1a\n";

class ProgramTest : public ::testing::Test {
 protected:
  ProgramTest() {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    std::string name =
        std::string(test->test_suite_name()) + "_" + test->name();
    std::replace(name.begin(), name.end(), '/', '_');
    folder_ = ::testing::TempDir() + name + "_" + std::to_string(getpid());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~ProgramTest() override { std::filesystem::remove_all(folder_); }

  std::string PathOf(const std::string& name) const {
    return folder_ + "/" + name;
  }

  std::string Write(const std::string& name, const std::string& bytes) const {
    std::ofstream(PathOf(name), std::ios::binary) << bytes;
    return PathOf(name);
  }

  std::string Read(const std::string& name) const {
    std::ifstream file(PathOf(name), std::ios::binary);
    EXPECT_TRUE(file.is_open()) << "there is no " << name;
    return (std::ostringstream() << file.rdbuf()).str();
  }

  // Everything below the folder, and what the files hold.
  std::map<std::string, std::string> Contents() const {
    std::map<std::string, std::string> contents;
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(folder_)) {
      const std::string name =
          std::filesystem::relative(entry.path(), folder_).string();
      contents[name] = entry.is_regular_file() ? Read(name) : "";
    }
    return contents;
  }

  // Standard output on a full disk is told in one last line, and files are as
  // they were.
  void ExpectFullOutputTold(const std::string& program,
                            const std::vector<std::string>& args) const {
    const auto before = Contents();
    const ProgramRun run = RunProgram(program, args, "/dev/full");
    EXPECT_EQ(run.exit_code, 2) << run.err;
    const std::string line =
        program + ": standard output: could not be written\n";
    EXPECT_THAT(run.err, ::testing::EndsWith(line));
    EXPECT_EQ(run.err.find(line), run.err.size() - line.size()) << run.err;
    EXPECT_EQ(Contents(), before);
  }

  // Exit code 2, one line on stderr that names `what` is wrong and `why`,
  // nothing on stdout and no trace in the folder.
  void ExpectBadInput(const std::string& program,
                      const std::vector<std::string>& args,
                      const std::string& what,
                      const std::string& why) const {
    const auto before = Contents();
    const ProgramRun run = RunProgram(program, args);
    EXPECT_EQ(run.exit_code, 2) << run.err;
    EXPECT_EQ(run.out, "");
    EXPECT_THAT(run.err, ::testing::HasSubstr(what));
    EXPECT_THAT(run.err, ::testing::HasSubstr(why));
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_THAT(run.err, ::testing::EndsWith("\n"));
    EXPECT_EQ(Contents(), before);
  }

 private:
  std::string folder_;
};

}  // namespace quatro

#endif  // QUATRO_TESTS_SUPPORT_RUN_PROGRAM_H_
