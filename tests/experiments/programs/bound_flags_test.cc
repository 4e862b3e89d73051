// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/programs/bound_flags.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

#include "features/base/degree.h"
#include "tests/support/run_program.h"

namespace quatro::bound_flags_test {
namespace {

using ::testing::HasSubstr;

class BoundFlagsTest : public ProgramTest {
 protected:
  static Rigid3 GuessOf(const std::string& text) {
    std::string error;
    const auto bounds = ParseBoundFlags({text, 5.0}, false, &error);
    EXPECT_TRUE(bounds) << error;
    return bounds.value_or(PoseBounds()).guess;
  }

  static std::string Problem(const BoundFlags& flags) {
    std::string error;
    EXPECT_FALSE(ParseBoundFlags(flags, false, &error));
    return error;
  }
};

constexpr char kRows[] = "0 -1 0 4\n1 0 0 5\n0 0 1 6\n";

void ExpectQuarterTurn(const Rigid3& pose) {
  EXPECT_TRUE(pose.rotation.isApprox(RotationZ(90.0 * kDegree), 1e-12));
  EXPECT_EQ(pose.translation, Eigen::Vector3d(4.0, 5.0, 6.0));
}

TEST_F(BoundFlagsTest, AGuessIsInlineOrAFile) {
  ExpectQuarterTurn(GuessOf("4,5,6,90"));
  ExpectQuarterTurn(GuessOf("0,-1,0,4,1,0,0,5,0,0,1,6"));
  ExpectQuarterTurn(GuessOf("0, -1, 0, 4, 1, 0, 0, 5, 0, 0, 1, 6, 0, 0, 0, 1"));
  ExpectQuarterTurn(GuessOf(Write("pose.txt", kRows)));
  ExpectQuarterTurn(
      GuessOf(Write("a,b.txt", std::string(kRows) + "0 0 0 1\n")));
  ExpectQuarterTurn(
      GuessOf(Write("answer.json",
                    R"({"status": "registered", "target_from_source":
          [[0, -1, 0, 4], [1, 0, 0, 5], [0, 0, 1, 6], [0, 0, 0, 1]]})")));
}

// As a file of poses with six digits has it.
TEST_F(BoundFlagsTest, ARotationOfFewDigitsIsMadeOne) {
  const Rigid3 pose = GuessOf("0.866,-0.5,0,0,0.5,0.866,0,0,0,0,1,0");
  EXPECT_TRUE(pose.rotation.isUnitary(1e-12));
  EXPECT_TRUE(pose.rotation.isApprox(RotationZ(30.0 * kDegree), 1e-3));
}

TEST_F(BoundFlagsTest, BoundsAreInDegreesAndZeroMetresAreAny) {
  std::string error;
  const auto bounds = ParseBoundFlags({"", 0.0, 30.0, 2.0}, false, &error);
  ASSERT_TRUE(bounds);
  EXPECT_DOUBLE_EQ(bounds->max_yaw, 30.0 * kDegree);
  EXPECT_DOUBLE_EQ(bounds->max_tilt, 2.0 * kDegree);
  EXPECT_TRUE(std::isinf(bounds->max_translation));
  EXPECT_TRUE(bounds->IsActive());
  EXPECT_FALSE(ParseBoundFlags({}, false, &error)->IsActive());
}

TEST_F(BoundFlagsTest, WhatIsWrongIsToldWithWhatToDo) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(Problem({"1,2,3", 5.0}),
              HasSubstr("--guess=1,2,3 has 3 numbers, must be 4 numbers "
                        "x,y,z,yaw_deg, or 12 or 16"));
  EXPECT_THAT(Problem({"1,2,nan,0", 5.0}), HasSubstr("'nan' is not a finite"));
  EXPECT_THAT(Problem({"1,2,3,0,", -1.0}), HasSubstr("--max_translation=-1"));
  EXPECT_THAT(Problem({"", kNan}), HasSubstr("--max_translation=nan"));
  EXPECT_THAT(Problem({"", 0.0, 181.0}), HasSubstr("--max_yaw_deg=181"));
  EXPECT_THAT(Problem({"", 0.0, 10.0, -1.0}), HasSubstr("--max_tilt_deg=-1"));
  EXPECT_THAT(Problem({"none.txt", 5.0}),
              HasSubstr("--guess: none.txt: cannot open"));
  EXPECT_THAT(Problem({"1,0,0,0,0,2,0,0,0,0,1,0", 5.0}),
              HasSubstr("are no rotation"));
  EXPECT_THAT(Problem({"1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,2", 5.0}),
              HasSubstr("the last row must be 0 0 0 1"));
  EXPECT_THAT(Problem({"1,2,3,4"}), HasSubstr("--guess has no effect"));
  EXPECT_THAT(Problem({"", 0.0, 180.0, 2.0}),
              HasSubstr("--max_tilt_deg has no effect without other bounds"));
}

TEST_F(BoundFlagsTest, ALocalMethodTakesAGuessAlone) {
  std::string error;
  EXPECT_TRUE(ParseBoundFlags({"1,2,3,4"}, true, &error)) << error;
}

TEST_F(BoundFlagsTest, AnAnswerIsNotNestedDeeply) {
  const auto nested = [this](std::size_t depth) {
    return Write("answer.json",
                 R"({"target_from_source": )" + std::string(depth, '[') +
                     std::string(depth, ']') + "}");
  };
  EXPECT_THAT(Problem({nested(99), 5.0}), HasSubstr("has 0 numbers"));
  for (const std::size_t depth : {101u, 1'000'000u}) {
    EXPECT_THAT(Problem({nested(depth), 5.0}),
                HasSubstr("is nested more than 100 levels deep"));
  }
}

}  // namespace
}  // namespace quatro::bound_flags_test
