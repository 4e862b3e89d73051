// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/base/outputs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <string>

#include "tests/support/run_program.h"

namespace quatro {
namespace {

using ::testing::HasSubstr;

class OutputsTest : public ProgramTest {
 protected:
  // As a user in the folder.
  OutputsTest() { std::filesystem::current_path(PathOf(".")); }
  ~OutputsTest() override { std::filesystem::current_path(before_); }

 private:
  const std::filesystem::path before_ = std::filesystem::current_path();
};

TEST_F(OutputsTest, ADashIsStandardOutput) {
  std::string error;
  ASSERT_TRUE(CanWriteAll({{"json", "-"}, {"picture", ""}}, {}, &error));
  ::testing::internal::CaptureStdout();
  EXPECT_TRUE(WriteOutputs({{"-", "one\n"}, {"a.txt", "two"}}, &error));
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "one\n");
  EXPECT_FALSE(std::filesystem::exists("-"));
  EXPECT_EQ(Read("a.txt"), "two");
}

TEST_F(OutputsTest, ADashBehindAFolderIsAFile) {
  std::string error;
  ASSERT_TRUE(CanWriteAll({{"json", "./-"}}, {"-"}, &error)) << error;
  ::testing::internal::CaptureStdout();
  EXPECT_TRUE(WriteOutputs({{"./-", "one\n"}}, &error));
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(Read("-"), "one\n");
}

TEST_F(OutputsTest, StandardOutputTakesOneFile) {
  std::string error;
  EXPECT_FALSE(CanWriteAll(
      {{"json", "-"}, {"picture", "a.png"}, {"report", "-"}}, {}, &error));
  EXPECT_EQ(error,
            "--json and --report would both go to standard output; name a "
            "file for one of them");
}

// Standard input and standard output are no file that would be overwritten.
TEST_F(OutputsTest, AFilterReadsAndWritesADash) {
  std::string error;
  EXPECT_TRUE(CanWriteAll({{"json", "-"}}, {"-"}, &error)) << error;
}

TEST_F(OutputsTest, AFileIsWrittenOnce) {
  std::string error;
  EXPECT_FALSE(
      CanWriteAll({{"json", "a.txt"}, {"report", "./a.txt"}}, {}, &error));
  EXPECT_THAT(error, HasSubstr("./a.txt: is to be written, but is also"));
}

TEST_F(OutputsTest, SummariesMakeWayForAFile) {
  EXPECT_EQ(SummaryStream({"", "a.txt", "./-"}), stdout);
  EXPECT_EQ(SummaryStream({"", "-"}), stderr);
}

// As in quatro_register ... | head.
TEST_F(OutputsTest, AReaderThatHasGoneIsToldAndLeavesFilesAlone) {
  std::string error;
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  close(ends[0]);
  const int before = dup(STDOUT_FILENO);
  dup2(ends[1], STDOUT_FILENO);
  EXPECT_FALSE(WriteOutputs({{"-", "one\n"}, {"a.txt", "two"}}, &error));
  dup2(before, STDOUT_FILENO);
  std::clearerr(stdout);
  EXPECT_EQ(error, "standard output: could not be written");
  EXPECT_TRUE(Contents().empty());
}

TEST_F(OutputsTest, AnEndingSaysTheFormat) {
  std::string error;
  for (const char* path : {"", "-", "a.png", "./-.png"}) {
    EXPECT_TRUE(HasEnding({"picture", path}, ".png", &error)) << path;
  }
  EXPECT_FALSE(HasEnding({"picture", "a.jpg"}, ".png", &error));
  EXPECT_THAT(error, HasSubstr("--picture=a.jpg, must end with .png"));
}

TEST_F(OutputsTest, ALinkIsFollowedNotReplaced) {
  std::string error;
  Write("real.json", "old");
  std::filesystem::create_symlink("real.json", "link.json");
  ASSERT_TRUE(CanWriteAll({{"json", "link.json"}}, {}, &error)) << error;
  EXPECT_TRUE(WriteOutputs({{"link.json", "new"}}, &error)) << error;
  EXPECT_TRUE(std::filesystem::is_symlink("link.json"));
  EXPECT_EQ(Read("real.json"), "new");
}

TEST_F(OutputsTest, WriteProtectedFilesAndPathsThroughFilesAreRefused) {
  std::string error;
  Write("a.json", "old");
  EXPECT_FALSE(CanWrite("a.json/b.json", &error));
  EXPECT_EQ(error, "a.json/b.json: a.json is a file, not a folder");
  if (geteuid() == 0) GTEST_SKIP() << "root may write to any file";
  std::filesystem::permissions("a.json", std::filesystem::perms::owner_read);
  EXPECT_FALSE(CanWrite("a.json", &error));
  EXPECT_THAT(error, HasSubstr("is write-protected"));
}

TEST_F(OutputsTest, AFolderIsNotStandardOutput) {
  std::string error;
  EXPECT_TRUE(CanBeFolder({"output", "./-"}, &error));
  EXPECT_FALSE(CanBeFolder({"output", "-"}, &error));
  EXPECT_THAT(error, HasSubstr("--output=-: a folder cannot go to"));
  EXPECT_FALSE(CanBeFolder({"output", ""}, &error));
  EXPECT_EQ(error, "--output is empty, must name a folder");
}

}  // namespace
}  // namespace quatro
