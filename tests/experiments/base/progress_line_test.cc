// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/base/progress_line.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "tests/support/run_program.h"

namespace quatro::progress_line_test {
namespace {

class ProgressLineTest : public ::testing::Test {
 protected:
  ~ProgressLineTest() override { std::fclose(file_); }

  ProgressLine Line(bool is_terminal) {
    return ProgressLine(
        "scans", "05: ", {file_, is_terminal, [this] { return seconds_; }});
  }

  std::string Printed() const { return ReadFromStart(file_); }

  std::FILE* const file_ = std::tmpfile();
  double seconds_ = 100.0;
};

// 2,000 scans of 50 ms.
TEST_F(ProgressLineTest, ALogGetsALineEveryTenSeconds) {
  ProgressLine line = Line(/*is_terminal=*/false);
  for (int i = 1; i <= 2000; ++i) {
    seconds_ += 0.05078125;  // A binary fraction: sums are exact.
    line(i, 2000);
  }
  EXPECT_EQ(Printed(),
            "05: 197 of 2000 scans, 92 s left\n"
            "05: 394 of 2000 scans, 82 s left\n"
            "05: 591 of 2000 scans, 72 s left\n"
            "05: 788 of 2000 scans, 62 s left\n"
            "05: 985 of 2000 scans, 52 s left\n"
            "05: 1182 of 2000 scans, 42 s left\n"
            "05: 1379 of 2000 scans, 32 s left\n"
            "05: 1576 of 2000 scans, 22 s left\n"
            "05: 1773 of 2000 scans, 12 s left\n"
            "05: 1970 of 2000 scans, 2 s left\n"
            "05: 2000 of 2000 scans, 0 s left\n");
}

TEST_F(ProgressLineTest, TheLastLineIsPrintedOnce) {
  ProgressLine line = Line(/*is_terminal=*/false);
  line(1, 2);
  line(2, 2);
  line(2, 2);
  EXPECT_EQ(Printed(), "05: 2 of 2 scans, 0 s left\n");
}

TEST_F(ProgressLineTest, ATerminalGetsOneLineThatIsWrittenOver) {
  ProgressLine line = Line(/*is_terminal=*/true);
  seconds_ += 1.0;
  line(1, 3);
  line(2, 3);
  line(3, 3);
  EXPECT_EQ(Printed(),
            "\r05: 1 of 3 scans, 2 s left   "
            "\r05: 2 of 3 scans, 0 s left   "
            "\r05: 3 of 3 scans, 0 s left   \n");
}

}  // namespace
}  // namespace quatro::progress_line_test
