// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/simulator/drives.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "experiments/simulator/city.h"
#include "experiments/simulator/kitti_layout.h"
#include "experiments/simulator/lidar.h"
#include "features/base/degree.h"
#include "features/base/file.h"
#include "features/kd_tree.h"

namespace quatro::drives_test {
namespace {

namespace fs = std::filesystem;

using ::testing::HasSubstr;

DriveOptions Named(const std::string& name) {
  DriveOptions options;
  options.name = name;
  return options;
}

double HeadingBetween(const Rigid3& a, const Rigid3& b) {
  return Yaw(a.rotation.transpose() * b.rotation);
}

// Counts how often a place is revisited, at least 20 frames later, in the same
// and in the opposite direction.
struct Revisits {
  int same = 0, opposite = 0;
};

Revisits CountRevisits(const std::vector<Rigid3>& poses) {
  Revisits revisits;
  for (size_t i = 0; i < poses.size(); ++i) {
    for (size_t j = i + 20; j < poses.size(); ++j) {
      if ((poses[i].translation - poses[j].translation).norm() > 4.0) continue;
      const double turn = std::abs(HeadingBetween(poses[i], poses[j]));
      revisits.same += turn < 20.0 * kDegree;
      revisits.opposite += turn > 160.0 * kDegree;
    }
  }
  return revisits;
}

std::vector<Rigid3> PosesOf(const std::string& name, double spacing) {
  DriveOptions options = Named(name);
  options.frame_spacing = spacing;
  options.num_moving_cars = 0;
  return MakeDrive(options).world_from_sensor;
}

TEST(MakeDriveTest, LoopsAreThoseThatTheNamesPromise) {
  const Revisits both = CountRevisits(PosesOf("05", 2.0));
  EXPECT_GT(both.same, 20);
  EXPECT_GT(both.opposite, 20);
  const Revisits same = CountRevisits(PosesOf("06", 2.0));
  EXPECT_GT(same.same, 20);
  EXPECT_EQ(same.opposite, 0);
  const Revisits opposite = CountRevisits(PosesOf("08", 2.0));
  EXPECT_EQ(opposite.same, 0);
  EXPECT_GT(opposite.opposite, 20);
  const Revisits building = CountRevisits(PosesOf("hd_b1", 1.0));
  EXPECT_GT(building.same, 10);
  EXPECT_GT(building.opposite, 10);
}

TEST(MakeDriveTest, StepsAreEvenAndTheCarLooksAhead) {
  const std::vector<Rigid3> poses = PosesOf("07", 1.5);
  ASSERT_GT(poses.size(), 200u);
  for (size_t i = 1; i + 1 < poses.size(); ++i) {
    const Eigen::Vector3d step =
        poses[i].rotation.transpose() *
        (poses[i + 1].translation - poses[i].translation);
    EXPECT_NEAR(step.norm(), 1.5, 0.15) << i;
    EXPECT_GT(step.x(), 0.9 * step.norm()) << i;
  }
}

TEST(PlanDriveTest, KeepsToTheRight) {
  CityOptions options;
  options.bend = 0.0;
  const City city(options);
  const Eigen::Vector2d corner = city.Plan({1, 0}), end = city.Plan({1, 1});
  const auto way = PlanDrive(city, {{0, 0}, {1, 0}, {1, 1}}, 1.0);
  int num_east = 0, num_north = 0;
  for (const Eigen::Vector2d& uv : way) {
    if (uv.x() < corner.x() - 15.0) {
      ++num_east;
      EXPECT_NEAR(uv.y(), corner.y() - 1.3, 1e-9);
    } else if (uv.y() > corner.y() + 15.0) {
      ++num_north;
      EXPECT_NEAR(uv.x(), corner.x() + 1.3, 1e-9);
    }
  }
  EXPECT_GT(num_east, 40);
  EXPECT_GT(num_north, 40);
  EXPECT_NEAR(way.back().y(), end.y(), 1.1);
}

TEST(MakeDriveTest, HillsAreInTheTiltOfTheCar) {
  DriveOptions options = Named("02");
  options.frame_spacing = 5.0;
  options.num_moving_cars = 0;
  options.tilt_sigma = 0.0;
  double steepest = 0.0;
  for (const Rigid3& pose : MakeDrive(options).world_from_sensor) {
    steepest = std::max(steepest, std::acos(pose.rotation(2, 2)));
  }
  EXPECT_GT(steepest, 5.0 * kDegree);
  EXPECT_LT(steepest, 15.0 * kDegree);
}

// Median distance [m] of the source's points, moved onto the target, to the
// planes through the target's three closest points, if these are close and not
// collinear.
double PlaneResidual(const PointCloud& source,
                     const PointCloud& target,
                     const Rigid3& target_from_source) {
  const KdTree tree(target.points);
  std::vector<double> residuals;
  for (Eigen::Index i = 0; i < source.points.cols(); i += 23) {
    const Eigen::Vector3d point =
        target_from_source * Eigen::Vector3d(source.points.col(i));
    if (point.norm() > 15.0) continue;
    const auto near = tree.Nearest(point, 12);
    if (near.back().squared_distance > 0.09) continue;
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const auto& n : near) mean += target.points.col(n.index);
    mean /= static_cast<double>(near.size());
    Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
    for (const auto& n : near) {
      const Eigen::Vector3d d = target.points.col(n.index) - mean;
      scatter += d * d.transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(scatter);
    if (eigen.eigenvalues()[1] < 20.0 * eigen.eigenvalues()[0]) continue;
    residuals.push_back(
        std::abs(eigen.eigenvectors().col(0).dot(point - mean)));
  }
  EXPECT_GT(residuals.size(), 300u);
  std::nth_element(residuals.begin(),
                   residuals.begin() + residuals.size() / 2,
                   residuals.end());
  return residuals[residuals.size() / 2];
}

TEST(MakeDriveTest, TruePosesLeaveNothingButTheNoise) {
  DriveOptions options = Named("07");
  options.num_frames = 12;
  options.num_moving_cars = 0;
  const Drive drive = MakeDrive(options);
  std::string error;
  const auto scene = LidarScene::Create(drive.scene, &error);
  ASSERT_NE(scene, nullptr) << error;
  const Rigid3 &first = drive.world_from_sensor[2],
               &second = drive.world_from_sensor[7];
  const PointCloud target = scene->Scan(first, LidarOptions(), {1, 2}, 2);
  const PointCloud source = scene->Scan(second, LidarOptions(), {1, 7}, 2);
  const Rigid3 truth = Inverse(first) * second;
  EXPECT_LT(PlaneResidual(source, target, truth), 0.025);
  const Rigid3 off = {Eigen::Matrix3d::Identity(), {0.1, 0.1, 0.1}};
  EXPECT_GT(PlaneResidual(source, target, off * truth), 0.05);
}

TEST(MakeDriveTest, OtherCarsMove) {
  DriveOptions options = Named("07");
  options.num_frames = 5;
  options.num_moving_cars = 6;
  const Drive drive = MakeDrive(options);
  const Scene start = drive.moving(0), later = drive.moving(4);
  ASSERT_GT(start.vertices.size(), 500u);
  ASSERT_EQ(start.vertices.size(), later.vertices.size());
  // 4 to 12 m/s for 0.4 s, unless the street ends.
  int num_moved = 0;
  for (size_t i = 0; i < start.vertices.size(); ++i) {
    const float moved = (start.vertices[i] - later.vertices[i]).norm();
    num_moved += moved > 1.5f && moved < 5.0f;
  }
  EXPECT_GT(num_moved, static_cast<int>(start.vertices.size() / 2));
  options.num_moving_cars = 0;
  EXPECT_TRUE(MakeDrive(options).moving(0).triangles.empty());
}

TEST(MeasureDriveTest, ErrorsAreABiasAndNoise) {
  DriveOptions options = Named("06");
  options.num_moving_cars = 0;
  const Drive drive = MakeDrive(options);
  options.ins_bias_sigma = options.ins_sigma = 0.0;
  const std::vector<InsReading> exact = MeasureDrive(drive, options);
  options.ins_bias_sigma = 0.02;
  options.ins_sigma = 0.001;
  const std::vector<InsReading> noisy = MeasureDrive(drive, options);
  double sum = 0.0, sum_of_squares = 0.0;
  for (size_t i = 0; i < exact.size(); ++i) {
    EXPECT_LT(AngleBetween(WorldFromBody(exact[i].attitude),
                           drive.world_from_sensor[i].rotation),
              1e-9);
    const double error = noisy[i].attitude.roll - exact[i].attitude.roll;
    sum += error;
    sum_of_squares += error * error;
  }
  const auto n = static_cast<double>(exact.size());
  const double bias = sum / n;
  EXPECT_GT(std::abs(bias), 0.001);
  EXPECT_LT(std::abs(bias), 0.08);
  EXPECT_NEAR(std::sqrt(sum_of_squares / n - bias * bias), 0.001, 0.0002);
}

TEST(MeasureDriveTest, EachDriveHasAnInsOfItsOwn) {
  std::vector<double> biases;
  for (const std::string& name : DriveNames()) {
    DriveOptions options = Named(name);
    options.num_frames = 2;
    options.num_moving_cars = 0;
    options.ins_sigma = 0.0;
    const Drive drive = MakeDrive(options);
    const double roll = MeasureDrive(drive, options)[0].attitude.roll;
    options.ins_bias_sigma = 0.0;
    biases.push_back(roll - MeasureDrive(drive, options)[0].attitude.roll);
  }
  std::sort(biases.begin(), biases.end());
  for (size_t i = 1; i < biases.size(); ++i) {
    EXPECT_GT(biases[i] - biases[i - 1], 1e-9);
  }
}

TEST(MakeDriveTest, OneFrameLooksAheadAsTheFirstOfManyDoes) {
  for (const char* name : {"07", "hd_b1"}) {
    DriveOptions options = Named(name);
    options.num_moving_cars = 0;
    options.num_frames = 2;
    const Rigid3 first = MakeDrive(options).world_from_sensor.front();
    options.num_frames = 1;
    const std::vector<Rigid3> one = MakeDrive(options).world_from_sensor;
    ASSERT_EQ(one.size(), 1u);
    EXPECT_TRUE(one[0].ToMatrix().isApprox(first.ToMatrix(), 1e-12));
  }
}

TEST(FormatOxtsTest, ThirtyNumbersInTheOrderOfKitti) {
  InsReading reading;
  reading.attitude = {0.01, -0.02, 1.5};
  reading.position = {100.0, 200.0, 3.0};
  reading.velocity = {1.0, 9.0, 0.5};
  std::istringstream stream(FormatOxts(reading));
  std::vector<double> values;
  for (double value; stream >> value;) values.push_back(value);
  ASSERT_EQ(values.size(), 30u);
  EXPECT_EQ(values[2], 3.0);
  EXPECT_EQ(values[3], 0.01);
  EXPECT_EQ(values[4], -0.02);
  EXPECT_EQ(values[5], 1.5);
  EXPECT_EQ(values[6], 9.0);
  EXPECT_EQ(values[7], 1.0);
  EXPECT_NEAR(std::hypot(values[8], values[9]), std::hypot(1.0, 9.0), 1e-6);
  EXPECT_GT(values[8], 8.9);  // Nearly along the heading.
  EXPECT_NEAR(std::hypot(values[11], values[12], values[13]), 9.81, 1e-6);
  EXPECT_NEAR(values[16], 9.81, 1e-9);
  // Inverts the projection of KITTI's development kit.
  const auto project = [](double latitude, double longitude) {
    const double scale = std::cos(49.0 * kDegree), earth = 6378137.0;
    return Eigen::Vector2d(
        scale * longitude * kDegree * earth,
        scale * earth * std::log(std::tan((90.0 + latitude) * kDegree / 2.0)));
  };
  const Eigen::Vector2d moved =
      project(values[0], values[1]) - project(49.0, 8.4);
  EXPECT_NEAR(moved.x(), 100.0, 0.01);
  EXPECT_NEAR(moved.y(), 200.0, 0.01);
}

TEST(SweepTest, PointsStayInTheFrameOfTheirMoment) {
  Scene scene;  // A wall ahead.
  scene.AddQuad({10, -9, -9}, {10, 9, -9}, {10, 9, 9}, {10, -9, 9}, 0.8f);
  std::string error;
  const auto wall = LidarScene::Create(scene, &error);
  ASSERT_NE(wall, nullptr) << error;
  LidarOptions options;
  options.range_sigma = 0.0;
  Sweep sweep;
  sweep.velocity.x() = 2.0;
  const PointCloud cloud = wall->Scan(Rigid3(), options, ScanId(), 1, sweep);
  ASSERT_GT(cloud.points.cols(), 1000);
  for (Eigen::Index i = 0; i < cloud.points.cols(); ++i) {
    // The revolution starts ahead and goes to the right.
    const double azimuth = std::atan2(cloud.points(1, i), cloud.points(0, i));
    const double fraction =
        azimuth <= 0.0 ? -azimuth / (2.0 * M_PI) : 1.0 - azimuth / (2.0 * M_PI);
    EXPECT_NEAR(cloud.points(0, i), 10.0 - (fraction - 0.5) * 2.0, 1e-3);
  }
  sweep = {};
  sweep.turn.z() = 0.2;
  const PointCloud turned = wall->Scan(Rigid3(), options, ScanId(), 1, sweep);
  for (Eigen::Index i = 0; i < turned.points.cols(); i += 97) {
    const Eigen::Vector3d point = turned.points.col(i);
    const double azimuth = std::atan2(point.y(), point.x());
    const double fraction =
        azimuth <= 0.0 ? -azimuth / (2.0 * M_PI) : 1.0 - azimuth / (2.0 * M_PI);
    EXPECT_NEAR((RotationZ((fraction - 0.5) * 0.2) * point).x(), 10.0, 1e-3);
  }
}

TEST(LidarSceneTest, OthersHideWhatIsBehindThem) {
  Scene far, near;
  far.AddQuad({20, -9, -9}, {20, 9, -9}, {20, 9, 9}, {20, -9, 9}, 0.8f);
  near.AddQuad({8, 0, -9}, {8, 9, -9}, {8, 9, 9}, {8, 0, 9}, 0.1f);
  std::string error;
  const auto wall = LidarScene::Create(far, &error);
  const auto others = LidarScene::Create(near, &error);
  LidarOptions options;
  options.range_sigma = 0.0;
  const PointCloud cloud =
      wall->Scan(Rigid3(), options, ScanId(), 1, Sweep(), others.get());
  int num_near = 0, num_far = 0;
  for (Eigen::Index i = 0; i < cloud.points.cols(); ++i) {
    const bool is_left = cloud.points(1, i) > 0.0;
    EXPECT_NEAR(cloud.points(0, i), is_left ? 8.0 : 20.0, 1e-3);
    EXPECT_EQ(cloud.intensity[i] < 0.2f, is_left);
    (is_left ? num_near : num_far) += 1;
  }
  EXPECT_GT(num_near, 500);
  EXPECT_GT(num_far, 500);
}

class SimulateDriveTest : public ::testing::Test {
 protected:
  void SetUp() override { fs::remove_all(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  std::string Bytes(const std::string& name) const {
    std::string error;
    return ReadWholeFile((folder_ / name).string(), &error).value_or("");
  }

  const fs::path folder_ =
      fs::path(::testing::TempDir()) /
      (std::string("quatro_drives_") +
       ::testing::UnitTest::GetInstance()->current_test_info()->name());
  std::string error_;
};

TEST_F(SimulateDriveTest, ThreadsChangeNoByte) {
  DriveOptions options = Named("07");
  options.num_frames = 2;
  options.has_sweep_motion = true;
  ASSERT_TRUE(SimulateDrive(options, folder_.string(), nullptr, &error_))
      << error_;
  const std::string scan = Bytes("velodyne/000001.bin");
  const std::string ins = Bytes("oxts/data/0000000001.txt");
  EXPECT_GT(scan.size(), 1000000u);
  EXPECT_GT(ins.size(), 100u);
  EXPECT_EQ(std::count(ins.begin(), ins.end(), '\n'), 1);
  EXPECT_GT(Bytes("poses.txt").size(), 300u);
  EXPECT_THAT(Bytes("calib.txt"), HasSubstr("Tr: "));
  EXPECT_THAT(Bytes("times.txt"), HasSubstr("1.000000e-01"));
  options.num_threads = 2;
  options.overwrite = true;
  ASSERT_TRUE(SimulateDrive(options, folder_.string(), nullptr, &error_))
      << error_;
  EXPECT_TRUE(scan == Bytes("velodyne/000001.bin"));
  EXPECT_EQ(ins, Bytes("oxts/data/0000000001.txt"));
}

TEST_F(SimulateDriveTest, InvalidOptionsAreNamed) {
  DriveOptions options = Named("moon");
  EXPECT_FALSE(SimulateDrive(options, folder_.string(), nullptr, &error_));
  EXPECT_THAT(error_, HasSubstr("name = 'moon', must be one of 00 02"));
  options = Named("00");
  options.frame_spacing = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(options.IsValid(&error_));
  EXPECT_THAT(error_, HasSubstr("frame_spacing = nan, must be"));
  for (const std::string& name : DriveNames()) {
    EXPECT_TRUE(Named(name).IsValid(&error_)) << error_;
  }
  EXPECT_FALSE(fs::exists(folder_));
}

TEST(CityOptionsTest, InvalidOptionsAreNamed) {
  std::string error;
  CityOptions options;
  options.block = 10.0;
  EXPECT_FALSE(options.IsValid(&error));
  EXPECT_THAT(error, HasSubstr("block = 10, must be in [70, 300]"));
  options = {};
  options.max_grade = 1.0;
  EXPECT_FALSE(options.IsValid(&error));
  EXPECT_THAT(error, HasSubstr("max_grade = 1, must be"));
}

}  // namespace
}  // namespace quatro::drives_test
