// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Results of other programs, and the table that contains them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "experiments/datasets/kitti_poses.h"
#include "experiments/odometry/outside_drift.h"
#include "experiments/odometry/table_two.h"
#include "tests/support/random_problems.h"
#include "tests/support/run_program.h"

namespace quatro::outside_results_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class OutsideResultsTest : public ProgramTest {
 protected:
  // Expects one line that names the file and gives the reason `why`.
  void ExpectBadPoses(const std::string& text, const std::string& why) const {
    const std::string path = Write("poses.txt", text);
    std::string error;
    EXPECT_FALSE(ReadKittiPoses(path, &error)) << text;
    EXPECT_THAT(error, HasSubstr(path + ": "));
    EXPECT_THAT(error, HasSubstr(why));
    EXPECT_EQ(error.find('\n'), std::string::npos);
  }
};

constexpr char kIdentity[] = "1 0 0 0 0 1 0 0 0 0 1 0";

TEST_F(OutsideResultsTest, PosesComeBack) {
  std::vector<Rigid3> poses;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    poses.push_back({RandomRotation(seed), 1e3 * RandomDirection(seed)});
  }
  std::string error;
  const auto read =
      ReadKittiPoses(Write("p.txt", FormatKittiPoses(poses)), &error);
  ASSERT_TRUE(read) << error;
  ASSERT_EQ(read->size(), poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_LT(((*read)[i].ToMatrix() - poses[i].ToMatrix()).norm(), 1e-8);
  }
}

// As written by KITTI, with six digits and a carriage return.
TEST_F(OutsideResultsTest, RoundedRotationsAreMadeRotations) {
  std::string error;
  const auto read = ReadKittiPoses(
      Write("p.txt",
            "9.999978e-01 5.272628e-04 -2.066935e-03 -4.690294e-02 "
            "-5.296506e-04 9.999992e-01 -1.154865e-03 -2.839928e-02 "
            "2.066324e-03 1.155958e-03 9.999971e-01 8.586941e-01\r\n"),
      &error);
  ASSERT_TRUE(read) << error;
  const Eigen::Matrix3d& rotation = read->front().rotation;
  EXPECT_LT(
      (rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).norm(),
      1e-14);
  EXPECT_NEAR(rotation(0, 2), -2.066935e-03, 1e-6);
}

TEST_F(OutsideResultsTest, BadPosesAreNamed) {
  ExpectBadPoses("", "is empty");
  ExpectBadPoses("1 2 3\n", "line 1 has 3 numbers, must have 12");
  ExpectBadPoses(std::string(kIdentity) + "\n\n" + kIdentity + "\n",
                 "line 2 is blank, must have 12 numbers");
  ExpectBadPoses(std::string(kIdentity) + " 1\n", "line 1 has 13 numbers");
  ExpectBadPoses("1 0 0 0 0 1 0 x 0 0 1 0\n",
                 "line 1 number 8 is not a finite number");
  ExpectBadPoses("1 0 0 nan 0 1 0 0 0 0 1 0\n", "number 4 is not a finite");
  ExpectBadPoses("2 0 0 0 0 1 0 0 0 0 1 0\n", "is not a rotation");
  ExpectBadPoses("-1 0 0 0 0 1 0 0 0 0 1 0\n", "is not a rotation");
  ExpectBadPoses("0 0 0 0 0 0 0 0 0 0 0 0\n", "is not a rotation");
  std::string error;
  EXPECT_FALSE(ReadKittiPoses(PathOf("none.txt"), &error));
  EXPECT_THAT(error, HasSubstr("none.txt"));
}

TEST_F(OutsideResultsTest, CalibrationMovesPosesIntoCam0) {
  std::string error;
  const std::string path = Write("calib.txt",
                                 "P0: 1 2 3 4 5 6 7 8 9 10 11 12\n"
                                 "Tr: 0 -1 0 1 0 0 -1 2 1 0 0 3\n");
  const auto cam0_from_lidar = ReadKittiCalibration(path, &error);
  ASSERT_TRUE(cam0_from_lidar) << error;
  // One meter ahead of the lidar is one meter along z of cam0.
  const auto poses = MoveToCam0(
      {{Eigen::Matrix3d::Identity(), {1.0, 0.0, 0.0}}}, *cam0_from_lidar);
  EXPECT_LT((poses[0].translation - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
  EXPECT_FALSE(ReadKittiCalibration(Write("c.txt", "P0: 1\n"), &error));
  EXPECT_THAT(error, HasSubstr("has no line Tr:"));
  EXPECT_FALSE(ReadKittiCalibration(Write("c.txt", "Tr: 1 2\n"), &error));
  EXPECT_THAT(error, HasSubstr("Tr has 2 numbers"));
}

std::vector<Rigid3> Line(int num_poses, double step) {
  std::vector<Rigid3> poses(static_cast<std::size_t>(num_poses));
  for (std::size_t i = 0; i < poses.size(); ++i) {
    poses[i].translation.z() = step * static_cast<double>(i);
  }
  return poses;
}

TEST_F(OutsideResultsTest, AFileOfPosesIsOfTheRunOrOfTheDrive) {
  const auto truth = Line(401, 1.0);
  std::vector<int> frames;
  for (int i = 0; i <= 400; i += 2) frames.push_back(i);
  std::string error;
  for (const auto& poses : {Line(401, 1.01), Line(201, 2.02)}) {
    const std::string path = Write("net.txt", FormatKittiPoses(poses));
    const auto entry =
        DriftOfPoseFile("LO-Net", 2, path, truth, frames, &error);
    ASSERT_TRUE(entry) << error;
    EXPECT_EQ(entry->origin, DriftOrigin::kFile);
    EXPECT_NEAR(entry->translation_percent, 1.01, 0.02);
  }
  const std::string path = Write("net.txt", FormatKittiPoses(Line(7, 1.0)));
  EXPECT_FALSE(DriftOfPoseFile("LO-Net", 2, path, truth, frames, &error));
  EXPECT_THAT(error,
              HasSubstr("has 7 poses, must have 201 (of the run) or 401"));
  frames.push_back(500);
  EXPECT_FALSE(DriftOfPoseFile("LO-Net", 2, path, truth, frames, &error));
  EXPECT_THAT(error, HasSubstr("no pose of frame 500"));
}

TEST(TableTwo, QuotedRowsArePapersAndMarked) {
  const Table table = MakeTableTwo(QuotedTableTwo());
  EXPECT_EQ(table.rows.size(), 14u);
  for (const auto& row : table.rows) EXPECT_EQ(row[1], "quoted");
  EXPECT_THAT(table.rows[7],
              ElementsAre("A-LOAM",
                          "quoted",
                          "0.70",
                          "0.27",
                          "-",
                          "-",  //
                          "0.97",
                          "0.38",
                          "-",
                          "-",  //
                          "31.16",
                          "12.10",
                          "-",
                          "-"));
  // No values for intervals that the authors do not report.
  EXPECT_THAT(table.rows[8],
              ElementsAre("LO-Net",
                          "quoted",
                          "1.47",
                          "0.72",
                          "-",
                          "-",  //
                          "-",
                          "-",
                          "-",
                          "-",
                          "-",
                          "-",
                          "-",
                          "-"));
}

TEST(TableTwo, AMeasuredRowStandsBesideTheQuotedOne) {
  DriftEntry entry;
  entry.method = "LO-Net";
  entry.interval = 3;
  entry.translation_percent = 2.5;
  entry.rotation_deg_per_100m = std::nan("");
  entry.num_lost = 4;
  entry.median_seconds = 0.25;
  std::vector<DriftEntry> entries = QuotedTableTwo();
  entries.push_back(entry);
  const Table table = MakeTableTwo(entries);
  ASSERT_EQ(table.rows.size(), 15u);
  EXPECT_THAT(table.rows.back(),
              ElementsAre("LO-Net",
                          "measured",
                          "-",
                          "-",
                          "-",
                          "-",  //
                          "2.50",
                          "-",
                          "4",
                          "250",
                          "-",
                          "-",
                          "-",
                          "-"));
}

TEST(ParseOutsideTest, TakesNamesAndPaths) {
  std::string error;
  const auto results = ParseOutside("LO-Net=a.txt,DMLO=b=c.txt", &error);
  ASSERT_TRUE(results) << error;
  ASSERT_EQ(results->size(), 2u);
  EXPECT_EQ((*results)[0].method, "LO-Net");
  EXPECT_EQ((*results)[1].path, "b=c.txt");
  EXPECT_TRUE(ParseOutside("", &error)->empty());
  for (const char* bad : {"LO-Net", "=a.txt", "LO-Net=", "a=b,c"}) {
    EXPECT_FALSE(ParseOutside(bad, &error)) << bad;
    EXPECT_THAT(error, HasSubstr("is not NAME=POSES"));
  }
}

}  // namespace
}  // namespace quatro::outside_results_test
