// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <tuple>
#include <vector>

#include "experiments/datasets/any_sequence.h"
#include "experiments/datasets/kitti_odometry.h"
#include "experiments/datasets/kitti_poses.h"
#include "experiments/datasets/kitti_raw.h"
#include "experiments/datasets/oxts.h"
#include "experiments/datasets/sequence.h"
#include "experiments/metrics/kitti_metrics.h"
#include "experiments/simulator/kitti_layout.h"
#include "features/base/degree.h"
#include "features/io/cloud_io.h"
#include "tests/support/random_problems.h"
#include "tests/support/run_program.h"

namespace quatro::kitti_datasets_test {
namespace {

namespace fs = std::filesystem;

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr char kIdentity[] = "1 0 0 0 0 1 0 0 0 0 1 0\n";
// z ahead, x to the right, y down, one meter above the sensor.
constexpr char kCalibration[] =
    "P0: 1 0 0 0 0 1 0 0 0 0 1 0\nTr: 0 -1 0 0 0 0 -1 1 1 0 0 0\n";

double Difference(const Rigid3& a, const Rigid3& b) {
  return (a.ToMatrix() - b.ToMatrix()).norm();
}

Rigid3 RandomPose(std::uint64_t seed) {
  return {RandomRotation(seed), 50.0 * RandomDirection(seed)};
}

std::string Oxts(const InsReading& reading) { return FormatOxts(reading); }

class KittiTest : public ProgramTest {
 protected:
  std::string Put(const std::string& name, const std::string& text) const {
    fs::create_directories(fs::path(PathOf(name)).parent_path());
    return Write(name, text);
  }
  // 16 bytes: one point.
  void PutScan(const std::string& name) const {
    Put(name, std::string(16, 'a'));
  }
  static std::string OxtsName(int frame) {
    char name[32];
    std::snprintf(name, sizeof(name), "oxts/data/%010d.txt", frame);
    return name;
  }

  SequenceData ReadOdometry(const KittiOdometryOptions& options) const {
    std::string error;
    const auto data = ReadKittiOdometry(options, &error);
    EXPECT_TRUE(data) << error;
    return data.value_or(SequenceData());
  }
  KittiOdometryOptions In(const std::string& folder,
                          const std::string& sequence = "") const {
    KittiOdometryOptions options;
    options.folder = PathOf(folder);
    options.sequence = sequence;
    return options;
  }
  // Expects one line that names `what` and gives the reason `why`.
  static void ExpectLine(const std::string& error,
                         const std::string& what,
                         const std::string& why) {
    EXPECT_THAT(error, HasSubstr(what));
    EXPECT_THAT(error, HasSubstr(why));
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  }
  void ExpectBad(const KittiOdometryOptions& options,
                 const std::string& what,
                 const std::string& why) const {
    std::string error;
    EXPECT_FALSE(ReadKittiOdometry(options, &error)) << why;
    ExpectLine(error, what, why);
  }
};

class KittiOdometryTest : public KittiTest {};

// An independent drive of random poses, in the layout of KITTI.
TEST_F(KittiOdometryTest, WhatTheWriterWritesComesBack) {
  std::string error;
  const auto writer = MakeKittiWriter(PathOf("05"), false, &error);
  ASSERT_NE(writer, nullptr) << error;
  std::vector<Rigid3> poses;
  std::vector<InsReading> readings;
  for (std::uint64_t i = 0; i < 6; ++i) {
    poses.push_back(RandomPose(i + 1));
    readings.emplace_back();
    readings[i].attitude = AttitudeOf(RandomRotation(i + 20));
    PointCloud cloud;
    cloud.points = RandomPoints(5, 9.0, i).cast<float>().cast<double>();
    ASSERT_TRUE(writer->Add(
        cloud, poses[i], 0.1 * static_cast<double>(i), &readings[i], &error))
        << error;
  }
  ASSERT_TRUE(writer->Finish(&error)) << error;

  KittiOdometryOptions options = In("05");
  options.ins_std = 0.01;
  const SequenceData data = ReadOdometry(options);
  EXPECT_EQ(data.name, "05");
  EXPECT_EQ(data.num_missing_scans + data.num_missing_poses, 0);
  ASSERT_EQ(data.world_from_sensor.size(), 6u);
  ASSERT_EQ(data.ins.size(), 6u);
  for (int i = 0; i < 6; ++i) {
    const auto cloud = ReadCloud(data.scans.at(i), &error);
    ASSERT_TRUE(cloud) << error;
    EXPECT_EQ(cloud->points,
              RandomPoints(5, 9.0, static_cast<std::uint64_t>(i))
                  .cast<float>()
                  .cast<double>());
    const auto task = MakePairTask(data, i, (i + 2) % 6);
    ASSERT_TRUE(task);
    const std::size_t source = static_cast<std::size_t>(i);
    const std::size_t target = static_cast<std::size_t>((i + 2) % 6);
    EXPECT_LT(Difference(*task->true_target_from_source,
                         Inverse(poses[target]) * poses[source]),
              1e-9);
    ASSERT_TRUE(task->ins);
    EXPECT_EQ(task->ins->std, 0.01);
    EXPECT_LT(AngleBetween(WorldFromBody(task->ins->source),
                           WorldFromBody(readings[source].attitude)),
              1e-9);
    EXPECT_LT(AngleBetween(WorldFromBody(task->ins->target),
                           WorldFromBody(readings[target].attitude)),
              1e-9);
    EXPECT_EQ(task->set, "05");
    EXPECT_EQ(task->source, data.scans.at(i));
    EXPECT_EQ(task->target, data.scans.at((i + 2) % 6));
  }
  EXPECT_EQ(MakePairTask(data, 4, 1)->name, "05/000004-000001");
  EXPECT_FALSE(MakePairTask(data, 4, 6));
  EXPECT_FALSE(MakePairTask(data, -1, 4));
}

TEST_F(KittiOdometryTest, PosesAreMovedFromTheCameraToTheSensor) {
  Put("00/calib.txt", kCalibration);
  // One meter along z of cam0, then a quarter turn to the left, about -y.
  Put("00/poses.txt", std::string(kIdentity) + "0 0 -1 0 0 1 0 0 1 0 0 1\n");
  PutScan("00/velodyne/000000.bin");
  PutScan("00/velodyne/000001.bin");
  const SequenceData data = ReadOdometry(In("00"));
  const Rigid3& pose = data.world_from_sensor.at(1);
  EXPECT_LT((pose.translation - Eigen::Vector3d(1, 0, 0)).norm(), 1e-12);
  EXPECT_LT((pose.rotation - RotationZ(M_PI / 2)).norm(), 1e-12);
  EXPECT_FALSE(MakePairTask(data, 1, 0)->ins);
}

TEST_F(KittiOdometryTest, LayoutOfTheBenchmarkIsFoundFromItsRoot) {
  for (const char* root : {"kitti", "kitti/dataset", "plain"}) {
    const std::string place =
        std::string(root) + (std::string(root) == "plain" ? "" : "/sequences");
    Put(place + "/07/calib.txt", kCalibration);
    PutScan(place + "/07/velodyne/000000.bin");
    const std::string poses = std::string(root) == "plain"
                                  ? place + "/07/poses.txt"
                                  : std::string(root) + "/poses/07.txt";
    Put(poses, kIdentity);
    const SequenceData data =
        ReadOdometry(In(std::string(root).substr(0, 5), "07"));
    EXPECT_EQ(data.name, "07");
    EXPECT_EQ(data.scans.at(0), PathOf(place + "/07/velodyne/000000.bin"));
    EXPECT_THAT(ListKittiSequences(PathOf(std::string(root).substr(0, 5))),
                ElementsAre("07"));
    fs::remove_all(PathOf(place));
  }
  Put("kitti/sequences/00/calib.txt", kCalibration);
  Put("kitti/poses/00.txt", kIdentity);
  PutScan("kitti/sequences/00/velodyne/000000.bin");
  // Also from the sequence's own folder, with or without a trailing slash.
  EXPECT_EQ(ReadOdometry(In("kitti/sequences/00")).name, "00");
  EXPECT_EQ(ReadOdometry(In("kitti/sequences/00/")).name, "00");
  EXPECT_TRUE(ListKittiSequences(PathOf("none")).empty());
}

// SemanticKITTI adds a poses.txt to the sequence: it becomes the true poses,
// and the benchmark's own poses become the INS.
TEST_F(KittiOdometryTest, OfficialPosesBesideOthersAreTheIns) {
  const std::vector<Rigid3> truth = {Rigid3(), RandomPose(1), RandomPose(2)};
  const std::vector<Rigid3> official = {Rigid3(), RandomPose(3), RandomPose(4)};
  Put("kitti/sequences/00/calib.txt", kCalibration);
  Put("kitti/sequences/00/poses.txt", FormatKittiPoses(truth));
  Put("kitti/poses/00.txt", FormatKittiPoses(official));
  for (const char* name : {"000000", "000001", "000002"}) {
    PutScan(std::string("kitti/sequences/00/velodyne/") + name + ".bin");
  }
  std::string error;
  const auto cam0_from_sensor =
      ReadKittiCalibration(PathOf("kitti/sequences/00/calib.txt"), &error);
  const auto relative = [&](const std::vector<Rigid3>& poses) {
    return Inverse(*cam0_from_sensor) * Inverse(poses[1]) * poses[2] *
           *cam0_from_sensor;
  };
  KittiOdometryOptions options = In("kitti", "00");
  for (const bool is_given : {false, true}) {
    if (is_given) {  // Reversed.
      options.poses = PathOf("kitti/poses/00.txt");
      options.ins_poses = PathOf("kitti/sequences/00/poses.txt");
    }
    const SequenceData data = ReadOdometry(options);
    const auto task = MakePairTask(data, 2, 1);
    EXPECT_LT(Difference(*task->true_target_from_source,
                         relative(is_given ? official : truth)),
              1e-9);
    ASSERT_TRUE(task->ins);
    EXPECT_LT(AngleBetween(WorldFromBody(task->ins->target).transpose() *
                               WorldFromBody(task->ins->source),
                           relative(is_given ? truth : official).rotation),
              1e-9);
    EXPECT_THAT(data.notes, Contains(HasSubstr("INS from ")));
  }
  // Official poses alone become the true poses, without an INS.
  fs::remove(PathOf("kitti/sequences/00/poses.txt"));
  const SequenceData data = ReadOdometry(In("kitti", "00"));
  EXPECT_TRUE(data.ins.empty());
  EXPECT_LT(Difference(*MakePairTask(data, 2, 1)->true_target_from_source,
                       relative(official)),
            1e-9);
}

TEST_F(KittiOdometryTest, InsIsMovedToTheSensor) {
  Put("00/calib.txt", kCalibration);
  Put("00/poses.txt", kIdentity);
  PutScan("00/velodyne/000000.bin");
  InsReading reading;
  reading.attitude = {0.1, -0.2, 2.0};
  Put("00/" + OxtsName(0), Oxts(reading));
  EXPECT_NEAR(ReadOdometry(In("00")).ins.at(0).roll, 0.1, 1e-9);
  // Velodyne from IMU, rotated to the right by 30 deg.
  Put("00/calib_imu_to_velo.txt",
      "calib_time: 25-May-2012\n"
      "R: 0.8660254 0.5 0 -0.5 0.8660254 0 0 0 1\nT: -0.81 0.32 -0.8\n");
  const Attitude moved = ReadOdometry(In("00")).ins.at(0);
  EXPECT_LT(
      AngleBetween(WorldFromBody(moved),
                   WorldFromBody(reading.attitude) * RotationZ(30.0 * kDegree)),
      1e-6);
}

TEST_F(KittiOdometryTest, MissingFramesAreCountedAndStayTasks) {
  Put("00/calib.txt", kCalibration);
  std::string poses;
  for (int i = 0; i < 8; ++i) poses += kIdentity;
  Put("00/poses.txt", poses);
  for (const int frame : {0, 4, 6, 8, 9}) {  // 8 and 9 have no pose.
    PutScan("00/velodyne/00000" + std::to_string(frame) + ".bin");
  }
  const SequenceData data = ReadOdometry(In("00"));
  EXPECT_EQ(data.num_missing_scans, 5);
  EXPECT_EQ(data.num_missing_poses, 2);
  EXPECT_THAT(data.notes,
              Contains("00: 5 of 10 frames have no scan: 1-3, 5 and 7"));
  EXPECT_THAT(data.notes, Contains("00: 2 of 10 frames have no pose: 8-9"));
  EXPECT_EQ(data.scans.size(), 10u);
  const auto task = MakePairTask(data, 7, 0);
  ASSERT_TRUE(task);
  EXPECT_EQ(task->source, PathOf("00/velodyne/000007.bin"));
  EXPECT_FALSE(MakePairTask(data, 8, 0));
  // Reading only the poses needs no folder of scans.
  fs::remove_all(PathOf("00/velodyne"));
  ExpectBad(In("00"), PathOf("00/velodyne"), "No such file");
  KittiOdometryOptions options = In("00");
  options.poses_only = true;
  EXPECT_EQ(ReadOdometry(options).num_missing_scans, 8);
}

TEST(FormatFramesTest, JoinsRunsAndStopsAfterFive) {
  EXPECT_EQ(FormatFrames({}), "");
  EXPECT_EQ(FormatFrames({7}), "7");
  EXPECT_EQ(FormatFrames({7, 8, 9}), "7-9");
  EXPECT_EQ(FormatFrames({3, 7, 8, 9, 12}), "3, 7-9 and 12");
  EXPECT_EQ(FormatFrames({1, 3, 5, 7, 9, 11, 12}),
            "1, 3, 5, 7, 9 ... (7 in all)");
}

TEST_F(KittiOdometryTest, BadInputIsNamed) {
  ExpectBad(In("none"), PathOf("none"), "is not a folder");
  KittiOdometryOptions options;
  ExpectBad(options, "folder is empty", "must name one");
  options = In("00");
  options.ins_std = std::nan("");
  ExpectBad(options, "ins_std = nan", "must be in (0, 0.2]");

  fs::create_directories(PathOf("00/velodyne"));
  ExpectBad(In(".", "03"), "holds no sequence '03'", "looked for sequences/03");
  ExpectBad(In("00"), PathOf("00/calib.txt"), "No such file");
  Put("00/calib.txt", "P0: 1 2 3\n");
  ExpectBad(In("00"), PathOf("00/calib.txt"), "has no line Tr:");
  Put("00/calib.txt", kCalibration);
  ExpectBad(In("00"), PathOf("00"), "there are no poses; looked for poses.txt");
  Put("00/poses.txt", std::string(kIdentity) + "1 0 0 0 0 1 0\n");
  ExpectBad(In("00"), PathOf("00/poses.txt"), "line 2 has 7 numbers");
  Put("00/poses.txt", std::string(kIdentity) + "1 0 0 nan 0 1 0 0 0 0 1 0\n");
  ExpectBad(In("00"), PathOf("00/poses.txt"), "line 2 number 4 is not");
  Put("00/poses.txt", kIdentity);
  ExpectBad(In("00"), PathOf("00/velodyne"), "holds no .bin");
  PutScan("00/velodyne/first.bin");
  ExpectBad(In("00"), "velodyne/first.bin", "is not a frame number");
  fs::remove(PathOf("00/velodyne/first.bin"));
  PutScan("00/velodyne/000000.bin");
  options = In("00");
  options.ins_poses = PathOf("other.txt");
  ExpectBad(options, PathOf("other.txt"), "No such file");

  fs::create_directories(PathOf("00/oxts"));
  ExpectBad(In("00"), PathOf("00/oxts/data"), "No such file");
  fs::create_directories(PathOf("00/oxts/data"));
  ExpectBad(In("00"), PathOf("00/oxts/data"), "holds no readings");
  const std::string oxts = "00/" + OxtsName(0);
  Put(oxts, "49 8 100 0 0 0\n");
  ExpectBad(In("00"), PathOf(oxts), "line 1 has 6 numbers, must have 30");
  Put(oxts, "");
  ExpectBad(In("00"), PathOf(oxts), "has 0 lines, must have 1");
  std::string line = Oxts(InsReading());
  Put(oxts, line + line);
  ExpectBad(In("00"), PathOf(oxts), "has 2 lines, must have 1");
  Put(oxts, "inf" + line.substr(line.find(' ')));
  ExpectBad(In("00"), PathOf(oxts), "line 1 number 1 is not a finite number");
  Put(oxts, "95" + line.substr(line.find(' ')));
  ExpectBad(In("00"), PathOf(oxts), "latitude");
  const auto with_zeros = [](const std::string& first) {
    std::string reading = first;
    for (int i = 3; i < 30; ++i) reading += " 0";
    return reading + "\n";
  };
  Put(oxts, with_zeros("49 -360.5 100"));
  ExpectBad(In("00"), PathOf(oxts), "longitude");
  Put(oxts, with_zeros("49 1e300 100"));
  ExpectBad(In("00"), PathOf(oxts), "longitude");
  Put(oxts, with_zeros("49 8 -1e300"));
  ExpectBad(In("00"), PathOf(oxts), "altitude");
  Put(oxts, line);
  ReadOdometry(In("00"));
  Put("00/calib_imu_to_velo.txt", "R: 1 0 0 0 1 0 0 0 1\n");
  ExpectBad(In("00"), PathOf("00/calib_imu_to_velo.txt"), "has no line T:");
  Put("00/calib_imu_to_velo.txt", "R: 1 0 0 0 1 0 0 0\nT: 1 2 3\n");
  ExpectBad(
      In("00"), "calib_imu_to_velo.txt: line 1", "8 numbers, must have 9");
  Put("00/calib_imu_to_velo.txt", "R: 1 0 0 0 2 0 0 0 1\nT: 1 2 3\n");
  ExpectBad(In("00"), "calib_imu_to_velo.txt", "is not a rotation");
  fs::remove(PathOf("00/calib_imu_to_velo.txt"));
  Put("00/oxts/data/000000.txt", line);
  ExpectBad(In("00"), "00/oxts/data", "there is another reading of frame 0");
  Put("00/oxts/data/first.txt", line);
  fs::remove(PathOf("00/oxts/data/000000.txt"));
  ExpectBad(In("00"), "first.txt", "is not a frame number");
}

class KittiRawTest : public KittiTest {};

// Written with the projection of FormatOxts and read with that of equation (1)
// of oxts.h. The sensor is offset and rotated relative to the IMU.
TEST_F(KittiRawTest, PosesAreThoseOfTheSensor) {
  const Rigid3 velodyne_from_imu = {WorldFromBody({0.02, -0.01, 0.03}),
                                    {-0.8, 0.3, -0.8}};
  std::string calibration = "calib_time: 25-May-2012\nR:";
  for (int i = 0; i < 9; ++i) {
    calibration +=
        " " + std::to_string(velodyne_from_imu.rotation(i / 3, i % 3));
  }
  Put("date/calib_imu_to_velo.txt",
      calibration + "\nT: -0.8 0.3 -0.8\ndelta_f: 0\n");
  std::vector<Rigid3> world_from_imu;
  for (int i = 0; i < 4; ++i) {
    InsReading reading;
    reading.attitude = AttitudeOf(RandomRotation(5 + i));
    reading.position = Eigen::Vector3d(10.0 * i, 200.0 * i, 100.0 + i);
    world_from_imu.push_back(
        {WorldFromBody(reading.attitude), reading.position});
    Put("date/drive_0005_sync/" + OxtsName(i), Oxts(reading));
    if (i == 1) continue;
    char name[64];
    std::snprintf(name,
                  sizeof(name),
                  "date/drive_0005_sync/velodyne_points/data/%010d.bin",
                  i);
    PutScan(name);
  }
  std::string error;
  const auto data = ReadKittiRaw(PathOf("date/drive_0005_sync"), &error);
  ASSERT_TRUE(data) << error;
  EXPECT_EQ(data->name, "drive_0005_sync");
  EXPECT_EQ(data->num_missing_scans, 1);
  EXPECT_TRUE(data->ins.empty());
  for (int i = 1; i < 4; ++i) {
    const Rigid3 expected = velodyne_from_imu * Inverse(world_from_imu[0]) *
                            world_from_imu[static_cast<std::size_t>(i)] *
                            Inverse(velodyne_from_imu);
    const Rigid3 read = *MakePairTask(*data, i, 0)->true_target_from_source;
    EXPECT_LT((read.translation - expected.translation).norm(), 2e-3) << i;
    EXPECT_LT(AngleBetween(read.rotation, expected.rotation), 1e-5) << i;
  }
}

// By hand: one arc second of latitude is 30.9 m on a sphere of radius E
// everywhere; one of longitude is cos(lat) times that; z is up.
TEST(PosesOfOxtsTest, ArcsOfLatitudeAndLongitude) {
  OxtsReading first, north, east;
  first.latitude = north.latitude = east.latitude = 60.0;
  north.latitude += 1.0 / 3600.0;
  east.longitude = 1.0 / 3600.0;
  east.altitude = 2.0;
  const auto poses = PosesOfOxts({{5, first}, {7, north}, {8, east}});
  const double second = 6378137.0 * kDegree / 3600.0;
  EXPECT_EQ(poses.at(5).translation, Eigen::Vector3d::Zero());
  EXPECT_LT(
      (poses.at(7).translation - Eigen::Vector3d(0.0, second, 0.0)).norm(),
      1e-3);
  EXPECT_LT((poses.at(8).translation - Eigen::Vector3d(0.5 * second, 0.0, 2.0))
                .norm(),
            1e-3);
  EXPECT_TRUE(PosesOfOxts({}).empty());
}

TEST(PosesOfOxtsTest, CrossTheDateLineByTheShorterWay) {
  OxtsReading before, after;
  before.longitude = 179.9999;
  after.longitude = -179.9999;
  const double step = 6378137.0 * 0.0002 * kDegree;
  const Eigen::Vector3d east =
      PosesOfOxts({{0, before}, {1, after}}).at(1).translation;
  EXPECT_LT((east - Eigen::Vector3d(step, 0.0, 0.0)).norm(), 1e-4);
  const Eigen::Vector3d west =
      PosesOfOxts({{0, after}, {1, before}}).at(1).translation;
  EXPECT_LT((west + Eigen::Vector3d(step, 0.0, 0.0)).norm(), 1e-4);
}

TEST_F(KittiTest, TextMayHaveAnyLineEndsAndBlankLinesAtItsEnd) {
  for (const std::string end : {"\n", "\r\n", "\r", " \n"}) {
    const std::string line = "1 0 0 0 0 1 0 0 0 0 1 -1e-400";
    const std::string path =
        Write("p.txt", "\xef\xbb\xbf" + line + end + line + end + end);
    std::string error;
    const auto poses = ReadKittiPoses(path, &error);
    ASSERT_TRUE(poses) << error;
    EXPECT_EQ(poses->size(), 2u);
    EXPECT_EQ((*poses)[1].translation.norm(), 0.0);
    const auto tr = ReadKittiCalibration(
        Write("c.txt", "\xef\xbb\xbfTr: 1 0 0 0 0 1 0 0 0 0 1 5" + end + end),
        &error);
    ASSERT_TRUE(tr) << error;
    EXPECT_EQ(tr->translation.z(), 5.0);
    std::string reading =
        "\xef\xbb\xbf"
        "49 8 100 0 0 1";
    for (int i = 6; i < 30; ++i) reading += " 0";
    Put("oxts/data/0000000003.txt", reading + end + end);
    Put("oxts/data/._0000000003.txt", "macOS");
    const auto readings = ReadOxts(PathOf("oxts"), &error);
    ASSERT_TRUE(readings) << error;
    EXPECT_EQ(readings->at(3).attitude.yaw, 1.0);
  }
}

TEST_F(KittiTest, ABlankLineAmongPosesIsRefused) {
  std::string error;
  EXPECT_FALSE(ReadKittiPoses(
      Write("p.txt", std::string(kIdentity) + "\n" + kIdentity), &error));
  ExpectLine(error, "p.txt: line 2", "is blank, must have 12 numbers");
}

TEST_F(KittiTest, ScansMayBeOfAnyBinaryFormat) {
  PutScan("drive/velodyne/000000.bin");
  for (const char* name : {"000001.npy", "000002.bin.gz", "000003.PLY"}) {
    Put(std::string("drive/velodyne/") + name, "x");
  }
  Put("drive/velodyne/times.txt", "0.0");
  std::string error;
  const auto scans = ListScans(PathOf("drive"), &error);
  ASSERT_TRUE(scans) << error;
  EXPECT_EQ(scans->size(), 4u);
  EXPECT_EQ(scans->at(2), PathOf("drive/velodyne/000002.bin.gz"));
  EXPECT_FALSE(ListScans(PathOf("drive/velodyne/times.txt"), &error));
  EXPECT_EQ(error,
            PathOf("drive/velodyne/times.txt") +
                ": is a file, must be a folder of scans");
  Put("drive/velodyne/000002.npy", "x");
  EXPECT_FALSE(ListScans(PathOf("drive"), &error));
  EXPECT_THAT(error, HasSubstr("there is another scan of frame 2"));
}

TEST_F(KittiTest, ADriveStartsAtItsFirstScan) {
  for (const char* name : {"004391.bin", "004392.bin", "004393.bin"}) {
    PutScan(std::string("drive/velodyne/") + name);
  }
  Put("drive/velodyne/._004391.bin", "macOS");
  Put("drive/velodyne/.hidden.ply", "x");
  std::string error;
  const auto scans = ListScans(PathOf("drive"), &error);
  ASSERT_TRUE(scans) << error;
  EXPECT_EQ(scans->size(), 3u);
  SequenceOptions options;
  EXPECT_THAT(*FramesOf(*scans, options, &error),
              ElementsAre(4391, 4392, 4393));
  options.interval = 2;
  EXPECT_THAT(*FramesOf(*scans, options, &error), ElementsAre(4391, 4393));
  options.first_frame = 4390;  // As it is asked for.
  EXPECT_THAT(*FramesOf(*scans, options, &error), ElementsAre(4390, 4392));

  // Poses from frame 0 on do not make lost scans of what comes before.
  SequenceData data;
  data.scans = {{0, PathOf("none.bin")}, {4391, scans->at(4391)}};
  EXPECT_EQ(FirstScan(data), 4391);
  data.scans.erase(4391);
  EXPECT_EQ(FirstScan(data), 0);
}

TEST_F(KittiRawTest, BadInputIsNamed) {
  std::string error;
  EXPECT_FALSE(ReadKittiRaw(PathOf("none"), &error));
  ExpectLine(error, PathOf("none/velodyne_points/data"), "No such file");
  PutScan("d/velodyne_points/data/0000000000.bin");
  EXPECT_FALSE(ReadKittiRaw(PathOf("d/"), &error));
  ExpectLine(error, PathOf("calib_imu_to_velo.txt"), "No such file");
  Put("d/calib_imu_to_velo.txt", "R: 1 0 0 0 1 0 0 0 1\nT: 1 2 nan\n");
  EXPECT_FALSE(ReadKittiRaw(PathOf("d"), &error));
  ExpectLine(
      error, "calib_imu_to_velo.txt: line 2", "number 3 is not a finite");
  Put("d/calib_imu_to_velo.txt", "R: 1 0 0 0 1 0 0 0 1\nT: 1 2 3\n");
  EXPECT_FALSE(ReadKittiRaw(PathOf("d"), &error));
  ExpectLine(error, PathOf("d/oxts/data"), "No such file");
}

TEST_F(KittiTest, AnySequenceIsReadByTheLayoutOfItsFolder) {
  Put("all/kitti/sequences/00/calib.txt", kCalibration);
  Put("all/kitti/poses/00.txt", kIdentity);
  PutScan("all/kitti/sequences/00/velodyne/000000.bin");
  PutScan("all/raw/velodyne_points/data/0000000000.bin");
  Put("all/calib_imu_to_velo.txt", "R: 1 0 0 0 1 0 0 0 1\nT: 1 2 3\n");
  Put("all/raw/" + OxtsName(0), Oxts(InsReading()));
  Put("all/hd_b1/sensors/records_lidar.txt", "1, lidar0, a.pcd\n");
  Put("all/hd_b1/sensors/trajectories.txt", "1, lidar0, 1,0,0,0, 0,0,0\n");
  std::string error;
  for (const auto& [folder, sequence, name] :
       {std::tuple("all/kitti", "00", "00"),
        std::tuple("all/kitti/sequences/00", "", "00"),
        std::tuple("all", "raw", "raw"),
        std::tuple("all/raw", "", "raw"),
        std::tuple("all", "hd_b1", "hd_b1"),
        std::tuple("all/hd_b1", "", "hd_b1")}) {
    const auto data = ReadAnySequence({PathOf(folder), sequence}, &error);
    ASSERT_TRUE(data) << error;
    EXPECT_EQ(data->name, name);
    EXPECT_EQ(data->world_from_sensor.size(), 1u) << folder;
  }
  EXPECT_FALSE(ReadAnySequence({PathOf("none"), ""}, &error));
  ExpectLine(error, PathOf("none"), "is not a folder");
}

// The official poses as INS with SemanticKITTI's as true poses, and their
// drift.
TEST_F(KittiOdometryTest, RealSequencesHaveAPlausibleDrift) {
  const std::string real = std::string(QUATRO_DATA) + "/kitti_poses/";
  if (!fs::exists(real + "semantickitti/06.txt")) {
    GTEST_SKIP() << "there is no kitti_poses/semantickitti/06.txt in "
                 << QUATRO_DATA;
  }
  for (const auto& [name, num_frames] :
       {std::pair("06", 1101), std::pair("07", 1101), std::pair("09", 1591)}) {
    fs::create_directories(PathOf(name));
    KittiOdometryOptions options = In(name);
    options.calibration = real + "calib/" + name + ".txt";
    options.poses = real + "semantickitti/" + name + ".txt";
    options.ins_poses = real + "kitti/" + name + ".txt";
    options.poses_only = true;
    const SequenceData truth = ReadOdometry(options);
    options.poses = options.ins_poses;
    const SequenceData official = ReadOdometry(options);
    ASSERT_EQ(truth.world_from_sensor.size(),
              static_cast<std::size_t>(num_frames));
    std::vector<Rigid3> true_poses, official_poses;
    for (const auto& [frame, pose] : truth.world_from_sensor) {
      true_poses.push_back(pose);
      official_poses.push_back(official.world_from_sensor.at(frame));
      // The INS has the rotations of that trajectory.
      EXPECT_LT(AngleBetween(WorldFromBody(truth.ins.at(frame)),
                             official_poses.back().rotation),
                1e-6);
    }
    std::string error;
    const auto drift =
        ComputeKittiDrift(true_poses, official_poses, {}, &error);
    ASSERT_TRUE(drift) << error;
    RecordProperty(std::string("t_rel_percent_") + name,
                   std::to_string(drift->translation_percent));
    RecordProperty(std::string("r_rel_") + name,
                   std::to_string(drift->rotation_deg_per_100m));
    EXPECT_GT(drift->translation_percent, 0.05) << name;
    EXPECT_LT(drift->translation_percent, 1.5) << name;
    EXPECT_GT(drift->rotation_deg_per_100m, 0.01) << name;
    EXPECT_LT(drift->rotation_deg_per_100m, 0.6) << name;
  }
}

}  // namespace
}  // namespace quatro::kitti_datasets_test
