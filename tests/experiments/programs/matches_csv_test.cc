// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/programs/matches_csv.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "features/base/types.h"
#include "tests/support/run_program.h"

namespace quatro::matches_csv_test {
namespace {

constexpr char kNames[] = "sx,sy,sz,tx,ty,tz\n";

class MatchesCsvTest : public ProgramTest {
 protected:
  std::optional<MatchedPoints> Parse(const std::string& text) const {
    std::string error;
    auto matches = ReadMatches(Write("a.csv", text), &error);
    EXPECT_EQ(matches.has_value(), error.empty()) << error;
    return matches;
  }

  // The reason why a text is rejected, without the file's name.
  std::string ErrorOf(const std::string& text) const {
    const std::string path = Write("a.csv", text);
    std::string error;
    EXPECT_FALSE(ReadMatches(path, &error).has_value());
    EXPECT_THAT(error, ::testing::StartsWith(path + ": "));
    EXPECT_THAT(error, ::testing::Not(::testing::HasSubstr("\n")));
    return error.substr(std::min(error.size(), path.size() + 2));
  }

  void ExpectTwoMatches(const std::string& text) const {
    const auto matches = Parse(text);
    ASSERT_TRUE(matches.has_value()) << text;
    EXPECT_EQ(matches->source,
              (Points(3, 2) << 1, -7, 2, 8, 3.5, 9e3).finished())
        << text;
    EXPECT_EQ(matches->target, (Points(3, 2) << 4, 1, 5, 2, 6, 3).finished())
        << text;
  }
};

TEST_F(MatchesCsvTest, ReadsWhatPeopleWrite) {
  ExpectTwoMatches("1,2,3.5,4,5,6\n-7,8,9e3,1,2,3\n");
  ExpectTwoMatches(std::string(kNames) + "1,2,3.5,4,5,6\n-7,8,9e3,1,2,3");
  ExpectTwoMatches("1 2 3.5 4 5 6\n-7 8 9e3 1 2 3\n");
  ExpectTwoMatches("  1\t2\t3.5   4 5 6 \r\n-7 8 9e3 1 2 3\r\n");
  ExpectTwoMatches(" 1 , 2,3.5 ,4, 5,6\n\n# more\n-7,8,+9E+03,1.0,2.,3\n\n");
  ExpectTwoMatches("# by hand\n" + std::string(kNames) +
                   "1,2,3.5,4,5,6\r\n-7,8,9000,1,2,3\r\n");
}

TEST_F(MatchesCsvTest, ReadsWhatProgramsWrite) {
  ExpectTwoMatches("\xef\xbb\xbf" + std::string(kNames) +
                   "1,2,3.5,4,5,6\r-7,8,9e3,1,2,3\r\r");
  const auto matches = Parse("-1.2e-400,1e-400,3,4,5,6\n");
  ASSERT_TRUE(matches);
  EXPECT_EQ(matches->source.col(0), Eigen::Vector3d(0.0, 0.0, 3.0));
  EXPECT_TRUE(std::signbit(matches->source(0, 0)));
  EXPECT_EQ(ErrorOf("1e400,2,3,4,5,6\n"),
            "line 1, column sx: '1e400' is not a number");
  EXPECT_EQ(ErrorOf("1,0;2,0;3,0;4,0;5,0;6,0\n"),
            "line 1 has semicolons, must have commas between columns and "
            "points in numbers");
}

TEST_F(MatchesCsvTest, NamesAloneAreNoMatches) {
  const auto matches = Parse(kNames);
  ASSERT_TRUE(matches.has_value());
  EXPECT_EQ(matches->source.cols(), 0);
  EXPECT_EQ(matches->target.cols(), 0);
}

TEST_F(MatchesCsvTest, RefusesNamesInAnotherOrder) {
  const std::string why =
      "line 1: names of columns must be sx,sy,sz,tx,ty,tz in order";
  EXPECT_EQ(ErrorOf("sx,sz,sy,tx,tz,ty\n1,2,3,4,5,6\n"), why);
  EXPECT_EQ(ErrorOf("tx ty tz sx sy sz\n1 2 3 4 5 6\n"), why);
  EXPECT_EQ(ErrorOf("sx,sy,sz,tx,ty,weight\n1,2,3,4,5,6\n"), why);
  ExpectTwoMatches(" sx , sy,sz\t,tx,ty,tz \r\n1,2,3.5,4,5,6\n-7,8,9e3,1,2,3");
}

TEST_F(MatchesCsvTest, RefusesAnEmptyFile) {
  for (const char* nothing : {"", "\n \n", "# a comment\n"}) {
    EXPECT_EQ(ErrorOf(nothing),
              "is empty or has only comments, must have a line for each match: "
              "sx,sy,sz,tx,ty,tz");
  }
}

TEST_F(MatchesCsvTest, CloudsAndPosesAreToldFromMatches) {
  std::string error;
  for (const char* name : {"a.bin", "a.PCD", "a.ply", "a.npy", "a.npy.gz"}) {
    const std::string path = Write(name, "1,2,3,4,5,6\n");
    EXPECT_FALSE(ReadMatches(path, &error)) << name;
    EXPECT_EQ(error,
              path +
                  ": is a cloud by its ending, must be text with a line for "
                  "each match: sx,sy,sz,tx,ty,tz; quatro_register registers "
                  "clouds of points");
    EXPECT_FALSE(ReadMatches(PathOf("no_") + name, &error));
    EXPECT_THAT(error, ::testing::HasSubstr("No such file"));
  }
  const std::string columns = " columns, must have 6: sx,sy,sz,tx,ty,tz; ";
  EXPECT_EQ(
      ErrorOf("1 2 3\n"),
      "line 1 has 3" + columns + "quatro_register registers clouds of points");
  EXPECT_EQ(ErrorOf("1 0 0 0 0 1 0 0 0 0 1 0\n"),
            "line 1 has 12" + columns + "is this a file of poses?");
}

TEST_F(MatchesCsvTest, RefusesAnotherNumberOfColumns) {
  EXPECT_EQ(ErrorOf("1,2,3,4,5\n"),
            "line 1 has 5 columns, must have 6: sx,sy,sz,tx,ty,tz");
  EXPECT_EQ(ErrorOf("1,2,3,4,5,6\n\n1,2,3,4,5,6,7\n"),
            "line 3 has 7 columns, must have 6: sx,sy,sz,tx,ty,tz");
  EXPECT_EQ(ErrorOf("1,2,3,4,5,6,\n"),
            "line 1 has 7 columns, must have 6: sx,sy,sz,tx,ty,tz");
}

TEST_F(MatchesCsvTest, RefusesWhatIsNotANumber) {
  EXPECT_EQ(ErrorOf("1,2,three,4,5,6\n"),
            "line 1, column sz: 'three' is not a number");
  EXPECT_EQ(ErrorOf("1,2,3,4,,6\n"), "line 1, column ty: '' is not a number");
  EXPECT_EQ(ErrorOf("1,2,3,4,5 5,6\n"),
            "line 1, column ty: '5 5' is not a number");
  EXPECT_EQ(ErrorOf("0x1,2,3,4,5,6\n"),
            "line 1, column sx: '0x1' is not a number");
  EXPECT_EQ(ErrorOf("1,2,3,4,5,6\n" + std::string(kNames)),
            "line 2, column sx: 'sx' is not a number");
}

TEST_F(MatchesCsvTest, RefusesWhatIsNotFinite) {
  EXPECT_EQ(ErrorOf("1,2,3,nan,5,6\n"),
            "line 1, column tx: 'nan' is not finite");
  EXPECT_EQ(ErrorOf("1,2,3,4,5,inf\n"),
            "line 1, column tz: 'inf' is not finite");
  EXPECT_EQ(ErrorOf("1,-Infinity,3,4,5,6\n"),
            "line 1, column sy: '-Infinity' is not finite");
  EXPECT_EQ(ErrorOf("1,2,3,4,5,1e999\n"),
            "line 1, column tz: '1e999' is not a number");
}

TEST_F(MatchesCsvTest, QuotesOnlyTheStartOfBinaryRubbish) {
  EXPECT_EQ(ErrorOf("1,2,3,4,5,\x1b[1m\n"),
            "line 1, column tz: '?[1m' is not a number");
  const std::string error =
      ErrorOf("1,2,3,4,5," + std::string(100000, 'x') + "\n");
  EXPECT_LT(error.size(), 100u);
}

TEST_F(MatchesCsvTest, EveryNumberComesBackBitForBit) {
  using Limits = std::numeric_limits<double>;
  Points source(3, 2);
  source << 0.1, -0.0, Limits::max(), Limits::denorm_min(), 1.0 / 3.0, 1e7;
  Points target(3, 2);
  target << M_PI, -1e-300, 123456789.123456789, 2, Limits::lowest(),
      Limits::epsilon();
  const auto matches = Parse(FormatMatches(source, target));
  ASSERT_TRUE(matches.has_value());
  EXPECT_EQ(matches->source, source);
  EXPECT_EQ(matches->target, target);
  EXPECT_TRUE(std::signbit(matches->source(0, 1)));
}

TEST_F(MatchesCsvTest, NoMatchesComeBackToo) {
  EXPECT_EQ(FormatMatches(Points(3, 0), Points(3, 0)), kNames);
}

}  // namespace
}  // namespace quatro::matches_csv_test
