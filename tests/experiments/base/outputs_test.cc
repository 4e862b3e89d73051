// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/base/outputs.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <iostream>
#include <string>

#include "experiments/base/one_line.h"
#include "tests/support/run_program.h"

namespace quatro::outputs_test {
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

TEST_F(OutputsTest, ADeviceIsWrittenNotReplaced) {
  std::string error;
  ASSERT_TRUE(
      CanWriteAll({{"json", "/dev/null"}, {"report", "/dev/null"}}, {}, &error))
      << error;
  EXPECT_TRUE(WriteOutputs({{"/dev/null", "one\n"}, {"a.txt", "two"}}, &error));
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
  EXPECT_EQ(Read("a.txt"), "two");
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  ASSERT_TRUE(CanWriteAll({{"json", "/dev/full"}}, {}, &error)) << error;
  EXPECT_FALSE(
      WriteOutputs({{"/dev/full", "one\n"}, {"b.txt", "two"}}, &error));
  EXPECT_EQ(error, "/dev/full: could not be written");
  EXPECT_FALSE(std::filesystem::exists("b.txt"));
}

TEST_F(OutputsTest, APipeIsRefused) {
  std::string error;
  ASSERT_EQ(mkfifo("pipe", 0600), 0);
  EXPECT_FALSE(CanWrite("pipe", &error));
  EXPECT_EQ(error, "pipe: is not a regular file; - is standard output");
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
  std::cout.clear();
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

TEST_F(OutputsTest, ALinkToAMissingFileIsFollowedToo) {
  std::string error;
  std::filesystem::create_directory("results");
  std::filesystem::create_symlink("results/link.json", "link.json");
  std::filesystem::create_symlink("real.json", "results/link.json");
  EXPECT_FALSE(CanWriteAll(
      {{"json", "link.json"}, {"report", "results/real.json"}}, {}, &error));
  EXPECT_THAT(error, HasSubstr("is to be written, but is also"));
  ASSERT_TRUE(CanWriteAll({{"json", "link.json"}}, {}, &error)) << error;
  EXPECT_TRUE(WriteOutputs({{"link.json", "new"}}, &error)) << error;
  EXPECT_TRUE(std::filesystem::is_symlink("link.json"));
  EXPECT_TRUE(std::filesystem::is_symlink("results/link.json"));
  EXPECT_EQ(Read("results/real.json"), "new");
}

TEST_F(OutputsTest, ALoopOfLinksIsRefused) {
  std::string error;
  std::filesystem::create_symlink("b.json", "a.json");
  std::filesystem::create_symlink("a.json", "b.json");
  EXPECT_FALSE(CanWriteAll({{"json", "a.json"}}, {}, &error));
  EXPECT_EQ(error, "a.json: is a loop of symbolic links; name another file");
}

TEST_F(OutputsTest, AnOpenFileIsWrittenNotReplaced) {
  std::string error;
  const int fd = open("a.txt", O_WRONLY | O_CREAT | O_APPEND, 0600);
  ASSERT_GE(fd, 0);
  ASSERT_EQ(write(fd, "one\n", 4), 4);
  const std::string path = "/dev/fd/" + std::to_string(fd);
  ASSERT_TRUE(CanWriteAll({{"json", path}}, {}, &error)) << error;
  EXPECT_TRUE(WriteOutputs({{path, "two\n"}}, &error)) << error;
  ASSERT_EQ(write(fd, "three\n", 6), 6);
  close(fd);
  EXPECT_EQ(Read("a.txt"), "one\ntwo\nthree\n");
  EXPECT_FALSE(CanWriteAll({{"json", path}}, {}, &error));
  EXPECT_EQ(error, path + ": is not open for writing");
}

TEST_F(OutputsTest, DevStdoutIsADash) {
  std::string error;
  EXPECT_FALSE(
      CanWriteAll({{"json", "/dev/stdout"}, {"report", "-"}}, {}, &error));
  EXPECT_THAT(error, HasSubstr("would both go to standard output"));
  EXPECT_EQ(SummaryStream({"/dev/stdout"}), stderr);
  ::testing::internal::CaptureStdout();  // Into a file.
  std::printf("one\n");
  EXPECT_TRUE(WriteOutputs({{"/dev/stdout", "two\n"}}, &error)) << error;
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "one\ntwo\n");
}

TEST_F(OutputsTest, PermissionsAreKept) {
  std::string error;
  for (const mode_t mode : {0600u, 0664u}) {
    Write("a.json", "old");
    ASSERT_EQ(chmod("a.json", mode), 0);
    ASSERT_TRUE(WriteOutputs({{"a.json", "new"}}, &error)) << error;
    struct stat status = {};
    ASSERT_EQ(stat("a.json", &status), 0);
    EXPECT_EQ(status.st_mode & 0777, mode);
  }
  EXPECT_EQ(Read("a.json"), "new");
}

TEST(OneLine, PrintsOnlyUtf8) {
  EXPECT_EQ(OneLine("a\nb\x1b[2J caf\xc3\xa9 \xe2\x82\xac"),
            "a?b?[2J caf\xc3\xa9 \xe2\x82\xac");
  // Not UTF-8, overlong, a surrogate, cut off, and a control character.
  EXPECT_EQ(OneLine("\xff \xc0\xaf \xed\xa0\x80 \xe2\x82 \xc2\x9b"),
            "? ?? ??? ?? ??");
}

TEST(OneLine, LongTextIsShortened) {
  const std::string fits(200, 'x');
  EXPECT_EQ(OneLine("'" + fits.substr(1) + "'"), "'" + fits.substr(1) + "'");
  EXPECT_EQ(OneLine(fits + "x: is empty"), fits + "...: is empty");
  const std::string line = OneLine("--guess=" + std::string(9000, ' ') + "bad");
  EXPECT_LT(line.size(), 2010u);
  EXPECT_THAT(line, ::testing::StartsWith("--guess="));
  EXPECT_THAT(line, ::testing::EndsWith("bad"));
}

}  // namespace
}  // namespace quatro::outputs_test
