// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/metrics/pair_result.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "experiments/base/csv_line.h"
#include "features/base/degree.h"
#include "tests/support/random_problems.h"
#include "tests/support/run_program.h"

namespace quatro::pair_result_test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

Rigid3 RandomPose(std::uint64_t seed) {
  return {RandomRotation(seed), 20.0 * RandomDirection(seed + 1000)};
}

PairResult Example(std::uint64_t seed) {
  Random random(seed);
  PairResult result;
  result.pair = "00/004413-000850, \"again\"";
  result.set = "00";
  result.bin = "8-10 m";
  result.method = "quatro";
  result.status = "registered";
  const Rigid3 truth = RandomPose(seed);
  result.target_from_source = RandomPose(seed + 7);
  result.distance = truth.translation.norm();
  result.true_yaw = Yaw(truth.rotation);
  result.true_tilt = AngleBetween(RotationZ(*result.true_yaw), truth.rotation);
  result.error = MeasureError(truth, *result.target_from_source);
  result.probability = random.Uniform();
  result.num_matches = static_cast<long>(random.Below(100000));
  result.num_consistent = static_cast<long>(random.Below(1000));
  result.num_inliers = static_cast<long>(random.Below(1000));
  result.stage_times = {{"voxels", random.Uniform()},
                        {"features", 1e-9 * random.Uniform()},
                        {"solve", 0.0}};
  result.total_seconds = 100.0 * random.Uniform();
  return result;
}

PairResult Parsed(const std::string& line) {
  std::string error;
  const auto result = ParseResultCsv(line, &error);
  EXPECT_TRUE(result.has_value()) << error;
  EXPECT_TRUE(error.empty());
  return result.value_or(PairResult{});
}

// Equality bit for bit.
void ExpectSame(const PairResult& a, const PairResult& b) {
  EXPECT_EQ(a.pair, b.pair);
  EXPECT_EQ(a.set, b.set);
  EXPECT_EQ(a.bin, b.bin);
  EXPECT_EQ(a.method, b.method);
  EXPECT_EQ(a.status, b.status);
  ASSERT_EQ(a.target_from_source.has_value(), b.target_from_source.has_value());
  if (a.target_from_source) {
    EXPECT_EQ(a.target_from_source->rotation, b.target_from_source->rotation);
    EXPECT_EQ(a.target_from_source->translation,
              b.target_from_source->translation);
  }
  EXPECT_EQ(a.distance, b.distance);
  EXPECT_EQ(a.true_yaw, b.true_yaw);
  EXPECT_EQ(a.true_tilt, b.true_tilt);
  ASSERT_EQ(a.error.has_value(), b.error.has_value());
  if (a.error) {
    EXPECT_EQ(a.error->rotation, b.error->rotation);
    EXPECT_EQ(a.error->yaw, b.error->yaw);
    EXPECT_EQ(a.error->translation, b.error->translation);
  }
  EXPECT_EQ(a.probability, b.probability);
  EXPECT_EQ(a.num_matches, b.num_matches);
  EXPECT_EQ(a.num_consistent, b.num_consistent);
  EXPECT_EQ(a.num_inliers, b.num_inliers);
  EXPECT_EQ(a.total_seconds, b.total_seconds);
  ASSERT_EQ(a.stage_times.size(), b.stage_times.size());
  for (std::size_t i = 0; i < a.stage_times.size(); ++i) {
    EXPECT_EQ(a.stage_times[i].stage, b.stage_times[i].stage);
    EXPECT_EQ(a.stage_times[i].seconds, b.stage_times[i].seconds);
  }
}

TEST(PairError, IsByHand) {
  const Rigid3 truth{RotationZ(170.0 * kDegree), {1.0, 2.0, 3.0}};
  const Rigid3 estimate{RotationZ(-175.0 * kDegree), {4.0, 6.0, 3.0}};
  const PairError error = MeasureError(truth, estimate);
  EXPECT_NEAR(error.rotation, 15.0 * kDegree, 1e-12);
  EXPECT_NEAR(error.yaw, 15.0 * kDegree, 1e-12);
  EXPECT_DOUBLE_EQ(error.translation, 5.0);
}

// A tilt does not change the yaw error.
TEST(PairError, OfATiltHasNoYaw) {
  const Eigen::Matrix3d tilt =
      Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitX()).toRotationMatrix();
  const PairError error =
      MeasureError({RotationZ(1.0), Eigen::Vector3d::Zero()},
                   {RotationZ(1.0) * tilt, Eigen::Vector3d::Zero()});
  EXPECT_NEAR(error.rotation, 0.1, 1e-12);
  EXPECT_NEAR(error.yaw, 0.0, 1e-12);
}

TEST(PairError, OfTheTruthIsNone) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const PairError error = MeasureError(RandomPose(seed), RandomPose(seed));
    EXPECT_NEAR(error.rotation, 0.0, 1e-15);
    EXPECT_EQ(error.yaw, 0.0);
    EXPECT_EQ(error.translation, 0.0);
  }
}

TEST(PairError, StaysInRange) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const PairError error =
        MeasureError(RandomPose(seed), RandomPose(seed + 500));
    EXPECT_GE(error.yaw, 0.0);
    EXPECT_LE(error.yaw, M_PI);
    EXPECT_LE(error.rotation, M_PI);
  }
}

// Both scans' poses in another frame of the target.
TEST(PairError, IsTheSameUnderACommonMotionOfTheTarget) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Rigid3 truth = RandomPose(seed), estimate = RandomPose(seed + 50);
    const PairError error = MeasureError(truth, estimate);
    ASSERT_GT(error.translation, 0.1);
    ASSERT_GT(error.rotation, 0.01);
    const Rigid3 any = RandomPose(seed + 100);
    const PairError moved = MeasureError(any * truth, any * estimate);
    EXPECT_NEAR(moved.rotation, error.rotation, 1e-12);
    EXPECT_NEAR(moved.translation, error.translation, 1e-12);
    const Rigid3 level{RotationZ(0.1 * static_cast<double>(seed)),
                       any.translation};
    EXPECT_NEAR(
        MeasureError(level * truth, level * estimate).yaw, error.yaw, 1e-12);
  }
}

// In another frame of the source only the rotation error stays, because the
// origin changes.
TEST(PairError, OfRotationIsTheSameUnderAMotionOfTheSourceAndASwap) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Rigid3 truth = RandomPose(seed), estimate = RandomPose(seed + 50);
    const double rotation = MeasureError(truth, estimate).rotation;
    const Rigid3 any = RandomPose(seed + 100);
    EXPECT_NEAR(
        MeasureError(truth * any, estimate * any).rotation, rotation, 1e-12);
    EXPECT_NEAR(MeasureError(Inverse(truth), Inverse(estimate)).rotation,
                rotation,
                1e-12);
  }
}

TEST(PairResultCsv, ComesBackBitForBit) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const PairResult result = Example(seed);
    const std::string line = FormatResultCsv(result);
    ExpectSame(Parsed(line), result);
    EXPECT_EQ(FormatResultCsv(Parsed(line)), line);
  }
}

TEST(PairResultCsv, ExtremeNumbersComeBackToo) {
  using Limits = std::numeric_limits<double>;
  PairResult result = Example(1);
  result.distance = Limits::max();
  result.true_yaw = -M_PI;
  result.true_tilt = Limits::denorm_min();
  result.error = PairError{M_PI, 1e-200, 1e7 / 3.0};
  result.probability = 1.0 - Limits::epsilon();
  result.num_matches = Limits::max_digits10;
  result.target_from_source->translation = {-0.0, -1e7 / 3.0, 1e-300};
  result.total_seconds = 1.0 / 3.0;
  ExpectSame(Parsed(FormatResultCsv(result)), result);
}

TEST(PairResultCsv, WhatIsNotKnownStaysSo) {
  PairResult result;
  result.pair = "a";
  result.method = "m";
  result.status = "unreadable";
  EXPECT_EQ(FormatResultCsv(result),
            "a,,,m,unreadable,,,,,,,,0,0,0,,,,,,,,,,,,,0,");
  ExpectSame(Parsed(FormatResultCsv(result)), result);
}

TEST(PairResultCsv, AnglesAreInDegreesAndTimesInMilliseconds) {
  PairResult result = Example(1);
  result.true_yaw = 90.0 * kDegree;
  result.error = PairError{2.5 * kDegree, 0.5 * kDegree, 0.25};
  result.stage_times = {{"voxels", 0.0015}, {"features", 0.06}};
  const std::string line = FormatResultCsv(result);
  EXPECT_THAT(line, HasSubstr(",90,"));
  EXPECT_THAT(line, HasSubstr(",2.5,0.5,0.25,"));
  EXPECT_THAT(line, HasSubstr(",voxels=1.5;features=60"));
}

// A valid line with the cell of `column` replaced.
std::string ErrorWith(const std::string& column, const std::string& text) {
  const auto names = SplitCsvLine(ResultCsvHeader());
  auto cells = SplitCsvLine(FormatResultCsv(Example(3)));
  const auto at = std::find(names->begin(), names->end(), column);
  EXPECT_NE(at, names->end()) << column;
  (*cells)[static_cast<std::size_t>(at - names->begin())] = text;
  std::string error;
  EXPECT_FALSE(ParseResultCsv(JoinCsvLine(*cells), &error)) << column;
  return error;
}

TEST(PairResultCsv, AnUnknownTruthComesBack) {
  PairResult result = Example(3);
  result.is_truth_known = false;
  result.distance.reset();
  std::string error;
  const auto read = ParseResultCsv(FormatResultCsv(result), &error);
  ASSERT_TRUE(read) << error;
  EXPECT_FALSE(read->is_truth_known);
  EXPECT_FALSE(read->distance);
  result.is_truth_known = true;
  EXPECT_TRUE(ParseResultCsv(FormatResultCsv(result), &error)->is_truth_known);
}

TEST(PairResultCsv, ABadLineNamesItsColumn) {
  EXPECT_EQ(ErrorWith("pair", ""), "column pair is empty");
  EXPECT_EQ(ErrorWith("method", ""), "column method is empty");
  EXPECT_EQ(ErrorWith("status", "fine"),
            "column status is not a status: 'fine'");
  // No control characters for the terminal.
  for (const char* const column : {"status", "m22", "matches", "stages_ms"}) {
    EXPECT_THAT(ErrorWith(column, "1\x1b[2J\x7f"), HasSubstr("'1?[2J?'"));
  }
  for (const char* const column : {"distance_m",
                                   "true_yaw_deg",
                                   "true_tilt_deg",
                                   "rotation_error_deg",
                                   "yaw_error_deg",
                                   "translation_error_m",
                                   "probability",
                                   "m00",
                                   "m03",
                                   "m23",
                                   "total_ms"}) {
    for (const char* const text : {"x", "nan", "inf", "1e999", "1 ", "0x1"}) {
      EXPECT_EQ(ErrorWith(column, text),
                std::string("column ") + column + " is not a finite number: '" +
                    text + "'");
    }
  }
  for (const char* const column : {"matches", "consistent", "inliers"}) {
    for (const char* const text : {"", "-1", "1.5", "99999999999999999999"}) {
      EXPECT_EQ(
          ErrorWith(column, text),
          std::string("column ") + column + " is not a count: '" + text + "'");
    }
  }
  EXPECT_THAT(ErrorWith("probability", "1.1"),
              StartsWith("column probability"));
  EXPECT_THAT(ErrorWith("true_yaw_deg", "181"), HasSubstr("out of range"));
  EXPECT_THAT(ErrorWith("distance_m", "-1"), HasSubstr("out of range"));
  EXPECT_THAT(ErrorWith("yaw_error_deg", ""),
              StartsWith("column yaw_error_deg is empty"));
  EXPECT_THAT(ErrorWith("m11", ""), StartsWith("column m11 is empty"));
  EXPECT_THAT(ErrorWith("m11", "0.5"), HasSubstr("not a rotation"));
  EXPECT_THAT(ErrorWith("total_ms", ""), StartsWith("column total_ms"));
  for (const char* const text : {"voxels", "=3", "voxels=x", "voxels=-1"}) {
    EXPECT_THAT(ErrorWith("stages_ms", text), StartsWith("column stages_ms"));
  }
}

TEST(PairResultCsv, ALineOfAnotherLengthIsRefused) {
  std::string error;
  EXPECT_FALSE(ParseResultCsv("a,b,c", &error));
  EXPECT_EQ(error, "has 3 columns, must have 29");
  EXPECT_FALSE(ParseResultCsv(FormatResultCsv(Example(1)) + ",", &error));
  EXPECT_FALSE(ParseResultCsv("", &error));
  EXPECT_FALSE(ParseResultCsv("\"a", &error));
  EXPECT_THAT(error, HasSubstr("quote"));
}

TEST(PairResultCsv, AnErrorNeedsAPose) {
  PairResult result = Example(1);
  result.target_from_source.reset();
  std::string error;
  EXPECT_FALSE(ParseResultCsv(FormatResultCsv(result), &error));
  EXPECT_THAT(error, HasSubstr("but the line has an error"));
}

class ResultFileTest : public ProgramTest {
 protected:
  std::string ErrorOf(const std::string& text) const {
    const std::string path = Write("results.csv", text);
    std::string error;
    EXPECT_FALSE(ReadResultCsv(path, &error));
    EXPECT_THAT(error, StartsWith(path + ": "));
    EXPECT_THAT(error, ::testing::Not(HasSubstr("\n")));
    return error.substr(std::min(error.size(), path.size() + 2));
  }
};

TEST_F(ResultFileTest, IsReadInOrder) {
  std::string text = ResultCsvHeader() + "\n";
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    text += FormatResultCsv(Example(seed)) + "\n";
  }
  std::string error;
  const auto results = ReadResultCsv(Write("results.csv", text), &error);
  ASSERT_TRUE(results) << error;
  ASSERT_EQ(results->size(), 3u);
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    ExpectSame((*results)[seed - 1], Example(seed));
  }
}

TEST_F(ResultFileTest, OfNoResultsIsEmpty) {
  std::string error;
  const auto results =
      ReadResultCsv(Write("results.csv", ResultCsvHeader() + "\n"), &error);
  ASSERT_TRUE(results) << error;
  EXPECT_TRUE(results->empty());
}

TEST_F(ResultFileTest, ThatIsBadNamesLineAndColumn) {
  const std::string header = ResultCsvHeader() + "\n";
  const std::string good = FormatResultCsv(Example(1));
  EXPECT_THAT(ErrorOf(""), StartsWith("line 1 must be pair,set"));
  EXPECT_THAT(ErrorOf(good + "\n"), StartsWith("line 1 must be pair,set"));
  EXPECT_EQ(ErrorOf(header + good + "\n" + "a,b\n"),
            "line 3 has 2 columns, must have 29");
  EXPECT_EQ(ErrorOf(header + good), "line 2 is truncated");
  EXPECT_THAT(ErrorOf(header + "\n" + good + "\n"), StartsWith("line 2 has 1"));
  std::string bad = good;
  bad.replace(bad.find("registered"), 10, "done");
  EXPECT_EQ(ErrorOf(header + bad + "\n"),
            "line 2 column status is not a status: 'done'");
}

TEST_F(ResultFileTest, ThatIsMissingIsNamed) {
  std::string error;
  EXPECT_FALSE(ReadResultCsv(PathOf("none.csv"), &error));
  EXPECT_THAT(error, HasSubstr("none.csv"));
}

}  // namespace
}  // namespace quatro::pair_result_test
