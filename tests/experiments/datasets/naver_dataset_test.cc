// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/datasets/naver.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "experiments/datasets/kitti_odometry.h"
#include "experiments/simulator/drives.h"
#include "experiments/simulator/naver_layout.h"
#include "features/io/cloud_io.h"
#include "tests/support/random_problems.h"
#include "tests/support/run_program.h"

namespace quatro::naver_dataset_test {
namespace {

namespace fs = std::filesystem;

using ::testing::Contains;
using ::testing::HasSubstr;

double Difference(const Rigid3& a, const Rigid3& b) {
  return (a.ToMatrix() - b.ToMatrix()).norm();
}

class NaverTest : public ProgramTest {
 protected:
  void Put(const std::string& name, const std::string& text) const {
    const fs::path path = PathOf("b1/sensors/" + name);
    fs::create_directories(path.parent_path());
    Write("b1/sensors/" + name, text);
  }
  NaverOptions In(const std::string& folder) const {
    NaverOptions options;
    options.folder = PathOf(folder);
    return options;
  }
  SequenceData ReadFrom(const NaverOptions& options) const {
    std::string error;
    const auto data = ReadNaver(options, &error);
    EXPECT_TRUE(data) << error;
    return data.value_or(SequenceData());
  }
  void ExpectBad(const NaverOptions& options,
                 const std::string& what,
                 const std::string& why) const {
    std::string error;
    EXPECT_FALSE(ReadNaver(options, &error)) << why;
    EXPECT_THAT(error, HasSubstr(what));
    EXPECT_THAT(error, HasSubstr(why));
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  }
};

TEST_F(NaverTest, WhatTheWriterWritesComesBack) {
  std::string error;
  const auto writer = MakeNaverWriter(PathOf("hd_b1"), false, &error);
  ASSERT_NE(writer, nullptr) << error;
  std::vector<Rigid3> poses;
  std::vector<Attitude> attitudes;
  for (std::uint64_t i = 0; i < 12; ++i) {
    poses.push_back({RandomRotation(i), 30.0 * RandomDirection(i)});
    attitudes.push_back(AttitudeOf(RandomRotation(i + 50)));
    InsReading reading;
    reading.attitude = attitudes.back();
    PointCloud cloud;
    cloud.points = RandomPoints(4, 9.0, i).cast<float>().cast<double>();
    ASSERT_TRUE(writer->Add(
        cloud, poses[i], 0.1 * static_cast<double>(i), &reading, &error))
        << error;
  }
  ASSERT_FALSE(fs::exists(PathOf("hd_b1")));
  ASSERT_TRUE(writer->Finish(&error)) << error;
  const SequenceData data = ReadFrom(In("hd_b1"));
  EXPECT_EQ(data.name, "hd_b1");
  EXPECT_EQ(data.num_missing_scans + data.num_missing_poses, 0);
  ASSERT_EQ(data.world_from_sensor.size(), poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const int frame = static_cast<int>(i);
    EXPECT_LT(Difference(data.world_from_sensor.at(frame), poses[i]), 1e-12);
    EXPECT_NEAR(data.ins.at(frame).roll, attitudes[i].roll, 1e-15);
    EXPECT_NEAR(data.ins.at(frame).pitch, attitudes[i].pitch, 1e-15);
    EXPECT_NEAR(data.ins.at(frame).yaw, attitudes[i].yaw, 1e-15);
    const auto cloud = ReadCloud(data.scans.at(frame), &error);
    ASSERT_TRUE(cloud) << error;
    EXPECT_EQ(cloud->points,
              RandomPoints(4, 9.0, i).cast<float>().cast<double>());
  }
}

// Both layouts of one drive give the same drive.
TEST_F(NaverTest, SimulatedDriveIsTheSameInBothLayouts) {
  DriveOptions options;
  options.name = "hd_b1";
  options.num_frames = 2;
  std::string error;
  ASSERT_TRUE(SimulateDrive(options, PathOf("kitti"), nullptr, &error));
  options.layout = "naver";
  ASSERT_TRUE(SimulateDrive(options, PathOf("naver"), nullptr, &error));
  KittiOdometryOptions kitti_options;
  kitti_options.folder = PathOf("kitti");
  const auto kitti = ReadKittiOdometry(kitti_options, &error);
  ASSERT_TRUE(kitti) << error;
  const SequenceData naver = ReadFrom(In("naver"));
  ASSERT_EQ(naver.scans.size(), 2u);
  EXPECT_LT(Difference(*MakePairTask(naver, 1, 0)->true_target_from_source,
                       *MakePairTask(*kitti, 1, 0)->true_target_from_source),
            1e-9);
  EXPECT_GT(
      MakePairTask(naver, 1, 0)->true_target_from_source->translation.norm(),
      0.5);
  for (const int frame : {0, 1}) {
    EXPECT_NEAR(naver.ins.at(frame).roll, kitti->ins.at(frame).roll, 1e-9);
    EXPECT_NEAR(naver.ins.at(frame).yaw, kitti->ins.at(frame).yaw, 1e-9);
    const auto a = ReadCloud(naver.scans.at(frame), &error);
    const auto b = ReadCloud(kitti->scans.at(frame), &error);
    ASSERT_TRUE(a && b) << error;
    EXPECT_GT(a->points.cols(), 1000);
    EXPECT_EQ(a->points, b->points);
    EXPECT_EQ(a->intensity, b->intensity);
  }
  // One layout may replace the other, but nothing else.
  options.overwrite = true;
  options.layout = "kitti";
  ASSERT_TRUE(SimulateDrive(options, PathOf("naver"), nullptr, &error))
      << error;
  EXPECT_FALSE(fs::exists(PathOf("naver/sensors")));
  options.layout = "sphere";
  EXPECT_FALSE(options.IsValid(&error));
  EXPECT_THAT(error, HasSubstr("layout = 'sphere', must be kitti or naver"));
}

// As in NAVER LABS' data: two lidars on a rig, stamps of 16 digits that are not
// in order, spaces, comments.
TEST_F(NaverTest, RigsStampsAndSeveralLidars) {
  Put("records_lidar.txt",
      "# kapture format: 1.1\n"
      "# timestamp, device_id, point_cloud_path\n"
      "1555396546400000, lidar0, pcd/lidar0_3.pcd\n"
      "1555396546200000,lidar1,pcd/lidar1_1.pcd\n"
      "\n"
      "1555396546200000 , lidar0 , pcd/lidar0_1.pcd\r\n"
      "1555396546300000, lidar0, pcd/lidar0_2.pcd\n"
      "1555396546300000, lidar1, pcd/lidar1_2.pcd\n");
  // The rig is rotated by a quarter turn to the left, the lidar is one meter
  // ahead of it and rotated by half a turn; a rig in a rig, 0.2 m behind and
  // 0.5 m up.
  Put("rigs.txt",
      "# rig_device_id, sensor_device_id, qw, qx, qy, qz, tx, ty, tz\n"
      "head, lidar0, 0, 0, 0, 1, 1, 0, 0\n"
      "robot, head, 1, 0, 0, 0, 0.2, 0, -0.5\n"
      "robot, lidar1, 1, 0, 0, 0, 0, 0, 0\n");
  Put("trajectories.txt",
      "1555396546200000, robot, 1, 0, 0, 0, 0, 0, 0\n"
      "1555396546300000, robot, 0.70710678, 0, 0, -0.70710678, 0, 0, 0\n"
      "1555396546300000, lidar1, 1, 0, 0, 0, -7, 0, 0\n");
  Put("records_data/pcd/lidar0_1.pcd", "");
  Put("records_data/pcd/lidar0_3.pcd", "");
  SequenceData data = ReadFrom(In("b1"));
  EXPECT_EQ(data.name, "b1");
  ASSERT_EQ(data.scans.size(), 3u);
  EXPECT_THAT(data.scans.at(0), HasSubstr("records_data/pcd/lidar0_1.pcd"));
  EXPECT_THAT(data.scans.at(2), HasSubstr("records_data/pcd/lidar0_3.pcd"));
  EXPECT_THAT(data.notes, Contains("b1: of 2 lidars 'lidar0'"));
  EXPECT_THAT(data.notes, Contains("b1: 1 of 3 frames have no pose: 2"));
  EXPECT_THAT(data.notes, Contains("b1: 1 of 3 frames have no scan: 1"));
  EXPECT_TRUE(data.ins.empty());
  EXPECT_FALSE(MakePairTask(data, 2, 0));
  const Rigid3 expected = {RotationZ(M_PI), {0.8, 0.0, 0.5}};
  EXPECT_LT(Difference(data.world_from_sensor.at(0), expected), 1e-9);
  const Rigid3 turned = {RotationZ(M_PI / 2), Eigen::Vector3d::Zero()};
  EXPECT_LT(Difference(data.world_from_sensor.at(1), turned * expected), 1e-7);

  NaverOptions options = In("b1");
  options.lidar = "lidar1";
  data = ReadFrom(options);
  ASSERT_EQ(data.scans.size(), 2u);
  // The lidar's own pose takes precedence over that of its rig.
  EXPECT_EQ(data.world_from_sensor.at(1).translation.x(), 7.0);
  options.lidar = "lidar2";
  ExpectBad(options, "records_lidar.txt", "has no records of a lidar 'lidar2'");
}

TEST_F(NaverTest, TheReleasesFolderIsFoundAndGivesTheName) {
  Put("records_lidar.txt", "1, lidar0, a.pcd\n");
  Put("trajectories.txt", "1, lidar0, 1, 0, 0, 0, 0, 0, 0\n");
  fs::create_directories(PathOf("store/B1/release/mapping"));
  fs::rename(PathOf("b1/sensors"), PathOf("store/B1/release/mapping/sensors"));
  for (const char* folder : {"store/B1",
                             "store/B1/release",
                             "store/B1/release/mapping",
                             "store/B1/release/mapping/"}) {
    EXPECT_EQ(ReadFrom(In(folder)).name, "B1") << folder;
  }
  NaverOptions options = In("store/B1");
  options.name = "hd_b1";
  EXPECT_EQ(ReadFrom(options).name, "hd_b1");
}

TEST_F(NaverTest, BadInputIsNamed) {
  ExpectBad(NaverOptions(), "folder is empty", "must name one");
  NaverOptions options = In("b1");
  options.ins_std = -1.0;
  ExpectBad(options, "ins_std = -1", "must be in (0, 0.2]");
  ExpectBad(In("b1"), PathOf("b1"), "holds none of sensors");
  const std::string record = "10, lidar0, a.pcd\n";
  const std::string pose = "10, lidar0, 1, 0, 0, 0, 0, 0, 0\n";
  fs::create_directories(PathOf("b1/sensors"));
  ExpectBad(In("b1"), "records_lidar.txt", "No such file");
  Put("records_lidar.txt", "# none\n");
  ExpectBad(In("b1"), "records_lidar.txt", "has no records of a lidar");
  Put("records_lidar.txt", "#\n10, lidar0\n");
  ExpectBad(In("b1"), "records_lidar.txt: line 2", "2 values, must have 3");
  Put("records_lidar.txt", "1.5, lidar0, a.pcd\n");
  ExpectBad(In("b1"), "records_lidar.txt: line 1", "'1.5' is not an integer");
  Put("records_lidar.txt", "1\x1b[2J, lidar0, a.pcd\n");
  ExpectBad(In("b1"), "records_lidar.txt: line 1", "'1?[2J' is not an integer");
  Put("records_lidar.txt", record + record);
  ExpectBad(In("b1"), "records_lidar.txt: line 2", "was there before");
  Put("records_lidar.txt", record);
  ExpectBad(In("b1"), "trajectories.txt", "No such file");
  Put("trajectories.txt", "10, lidar0, 1, 0, 0, 0, 0, 0\n");
  ExpectBad(In("b1"), "trajectories.txt: line 1", "8 values, must have 9");
  Put("trajectories.txt", "10, lidar0, 1, 0, 0, 0, nan, 0, 0\n");
  ExpectBad(In("b1"), "trajectories.txt: line 1", "value 7 is not a finite");
  Put("trajectories.txt", "10, lidar0, 0, 0, 0, 0, 0, 0, 0\n");
  ExpectBad(In("b1"), "trajectories.txt: line 1", "is not of length 1");
  Put("trajectories.txt", pose + pose);
  ExpectBad(In("b1"), "trajectories.txt: line 2", "was there before");
  Put("trajectories.txt", pose);
  ReadFrom(In("b1"));
  Put("rigs.txt", "a, lidar0, 1, 0, 0, 0, 0, 0, x\n");
  ExpectBad(In("b1"), "rigs.txt: line 1", "value 9 is not a finite");
  Put("rigs.txt",
      "a, lidar0, 1, 0, 0, 0, 0, 0, 0\nb, lidar0, 1, 0, 0, 0, 0, 0, 0\n");
  ExpectBad(In("b1"), "rigs.txt: line 2", "is in a rig already");
  // Rigs in a cycle are an error.
  Put("rigs.txt",
      "a, lidar0, 1, 0, 0, 0, 0, 0, 0\nlidar0, a, 1, 0, 0, 0, 0, 0, 0\n");
  Put("trajectories.txt", "11, lidar0, 1, 0, 0, 0, 0, 0, 0\n");
  EXPECT_EQ(ReadFrom(In("b1")).num_missing_poses, 1);
  Put("records_ins.txt", "10, ins0, 0.1, 0.2\n");
  ExpectBad(In("b1"), "records_ins.txt: line 1", "4 values, must have 5");
}

}  // namespace
}  // namespace quatro::naver_dataset_test
