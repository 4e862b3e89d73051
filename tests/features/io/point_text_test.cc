// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/io/point_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace quatro::point_text_test {
namespace {

using ::testing::HasSubstr;

PointCloud Read(const std::string& text) {
  std::string error;
  const auto cloud = ParsePointText(text, &error);
  EXPECT_TRUE(cloud) << error << " in\n" << text;
  return cloud.value_or(PointCloud());
}

// Of the points 1 2 3 and 4 5 6.
void ExpectTwoPoints(const std::string& text) {
  SCOPED_TRACE(text);
  const PointCloud cloud = Read(text);
  ASSERT_EQ(cloud.points.cols(), 2);
  EXPECT_EQ(cloud.points.col(0), Eigen::Vector3d(1.0, 2.0, 3.0));
  EXPECT_EQ(cloud.points.col(1), Eigen::Vector3d(4.0, 5.0, 6.0));
  EXPECT_EQ(cloud.num_dropped, 0);
}

std::string ErrorOf(const std::string& text) {
  std::string error;
  EXPECT_FALSE(ParsePointText(text, &error)) << text;
  EXPECT_EQ(error.find('\n'), std::string::npos);
  return error;
}

std::string Replaced(std::string text,
                     const std::string& from,
                     const std::string& to) {
  for (std::size_t i = text.find(from); i != std::string::npos;
       i = text.find(from, i + to.size())) {
    text.replace(i, from.size(), to);
  }
  return text;
}

TEST(ParsePointText, TakesEverySeparatorLineEndAndMark) {
  int num_read = 0;
  for (const std::string separator :
       {" ", "\t", "  \t ", ",", ", ", ";", " ; "}) {
    for (const std::string end : {"\n", "\r\n", "\r", " \n", "\n\n"}) {
      for (const std::string start : {"", "\xef\xbb\xbf"}) {
        for (const std::string last : {"", "\n", "\n\n \n"}) {
          const std::string text = Replaced("1_2_3\n4_5_6" + last, "\n", end);
          ExpectTwoPoints(start + Replaced(text, "_", separator));
          ++num_read;
        }
      }
    }
  }
  EXPECT_EQ(num_read, 7 * 5 * 2 * 3);
  ExpectTwoPoints("1,2,3,\n4,5,6,\n");
  ExpectTwoPoints("   1 2 3\n\t4 5.0e0 +6   \n");
}

TEST(ParsePointText, CommentsArePassedOver) {
  ExpectTwoPoints("# made by hand\n1 2 3\n  # and\n4 5 6 # the last\n#\n");
  ExpectTwoPoints("// made by hand\n1,2,3\n//\n4,5,6 // the last\n");
}

TEST(ParsePointText, AHeaderNamesTheColumns) {
  ExpectTwoPoints("x y z\n1 2 3\n4 5 6\n");
  ExpectTwoPoints("X;Y;Z\n1;2;3\n4;5;6\n");
  ExpectTwoPoints("\"x\",\"y\",\"z\"\n1,2,3\n4,5,6\n");
  for (const std::string start : {"", "# ", "//"}) {
    const PointCloud cloud = Read(
        start + "stamp,z,y,x,Intensity,label\n9,3,2,1,0.25,car\n8,6,5,4,7,\n");
    ASSERT_EQ(cloud.points.cols(), 2);
    EXPECT_EQ(cloud.points.col(1), Eigen::Vector3d(4.0, 5.0, 6.0));
    EXPECT_EQ(cloud.intensity, Eigen::Vector2f(0.25f, 7.0f));
  }
  // A comment with other words is none.
  ExpectTwoPoints("# columns: x y z\n1 2 3\n4 5 6\n");
  ExpectTwoPoints("# three columns here\n1 2 3\n4 5 6\n");
}

TEST(ParsePointText, WithoutAHeaderTheLastOfFourIsTheIntensity) {
  EXPECT_EQ(Read("1 2 3 0.5\n4 5 6 0.25\n").intensity,
            Eigen::Vector2f(0.5f, 0.25f));
  ExpectTwoPoints("1 2 3 255 0 0\n4 5 6 0 255 0\n");
  EXPECT_EQ(Read("1 2 3 255 0 0\n").intensity.size(), 0);
}

TEST(ParsePointText, AFirstLineMayBeTheNumberOfPoints) {
  ExpectTwoPoints("2\n1 2 3\n4 5 6\n");
  EXPECT_EQ(ErrorOf("3\n1 2 3\n4 5 6\n"),
            "line 1 says 3 points, but there are 2; is the file truncated?");
}

// With commas as separators, decimal commas would be other points.
TEST(ParsePointText, DecimalCommasAreRefused) {
  EXPECT_EQ(ErrorOf("1,5;2,5;3,5\n"),
            "line 1: has semicolons and commas, must have points in numbers "
            "and one separator");
  EXPECT_EQ(ErrorOf("1,5 2,5 3,5\n"), "line 1: '5 2' is not a number");
  EXPECT_EQ(ErrorOf("1;2;3\n1,5;2,5;3,5\n"),
            "line 2: has semicolons and commas, must have points in numbers "
            "and one separator");
}

TEST(ParsePointText, NamesTheLineAndTheReason) {
  EXPECT_EQ(ErrorOf("1 2 3\n\n4 five 6\n"), "line 3: 'five' is not a number");
  EXPECT_EQ(ErrorOf("# c\n1 2 3\n4 5\n"), "line 3: has 2 values, line 2 has 3");
  EXPECT_EQ(ErrorOf("1 2 3\n4 5 6 7\n"), "line 2: has 4 values, line 1 has 3");
  EXPECT_EQ(ErrorOf("1,2,3\n4,,6\n"), "line 2: '' is not a number");
  EXPECT_EQ(ErrorOf("1 2\n3 4\n"),
            "line 1: has 2 numbers, must have at least three: x y z");
  EXPECT_EQ(ErrorOf("lon,lat,height\n1,2,3\n"),
            "line 1: header 'lon,lat,height': x: must be there exactly once "
            "and as a single number; name the columns x, y and z, or remove "
            "the line");
  EXPECT_EQ(ErrorOf("x,y,z,intensity\n1,2,3\n"),
            "line 1: header 'x,y,z,intensity': has 4 names, must have one for "
            "each of 3 columns; name the columns x, y and z, or remove the "
            "line");
  EXPECT_EQ(ErrorOf("points of\nmy scan\n1 2 3\n"),
            "line 2: 'my' is not a number; a header must be one line");
  EXPECT_EQ(ErrorOf("hello\n"),
            "line 1: 'hello' is not a point, and no line follows; must be "
            "numbers x y z");
  EXPECT_EQ(ErrorOf("# nothing\n\n"), "points: there are none");
  EXPECT_EQ(ErrorOf("17\n"), "points: there are none");
  for (const char c : {'\0', '\x08', '\x0e', '\x1f', '\x7f'}) {
    EXPECT_EQ(ErrorOf(std::string("1 2 3\n") + c),
              "is binary, not text with a point on each line");
  }
}

TEST(ParsePointText, TrajectoriesAreRefused) {
  const std::string tum = "1.5 7 8 9 0 0 0.6 0.8\n1.6 7 8 9 0 0 0 1\n";
  EXPECT_EQ(ErrorOf(tum),
            "is a trajectory (format TUM), not points; give the file of a "
            "scan");
  const std::string kitti =
      "1 0 0 7 0 1 0 8 0 0 1 9\n0 -1 0 7 1 0 0 8 0 0 1 9\n";
  EXPECT_EQ(ErrorOf(kitti),
            "is a trajectory (format KITTI), not points; give the file of a "
            "scan");
  // Times that do not increase, a norm of 1.1, a reflection, a name.
  EXPECT_EQ(Read(Replaced(tum, "1.6 ", "1.5 ")).points.cols(), 2);
  EXPECT_EQ(Read(Replaced(tum, "0.6 0.8", "0.6 0.9")).points.cols(), 2);
  EXPECT_EQ(Read(Replaced(kitti, "0 0 1 9", "0 0 -1 9")).points.cols(), 2);
  EXPECT_EQ(Read("x y z a b c d e\n" + tum).points.cols(), 2);
}

}  // namespace
}  // namespace quatro::point_text_test
