// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/metrics/kitti_metrics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "experiments/datasets/kitti_poses.h"
#include "features/base/degree.h"
#include "tests/support/random_problems.h"

namespace quatro::kitti_metrics_test {
namespace {

// One meter per frame along x.
std::vector<Rigid3> Line(int num_poses, double metres_per_frame) {
  std::vector<Rigid3> poses(static_cast<std::size_t>(num_poses));
  for (std::size_t i = 0; i < poses.size(); ++i) {
    poses[i].translation.x() = metres_per_frame * static_cast<double>(i);
  }
  return poses;
}

// Turns and climbs, about 1 m per frame.
std::vector<Rigid3> Drive(int num_poses, std::uint64_t seed) {
  std::vector<Rigid3> poses(1);
  Random random(seed);
  for (int i = 1; i < num_poses; ++i) {
    const Eigen::Vector3d turn(0.01 * RandomNormal(random),
                               0.01 * RandomNormal(random),
                               0.03 * RandomNormal(random));
    poses.push_back(
        poses.back() *
        Rigid3{Eigen::AngleAxisd(turn.norm(), turn.normalized())
                   .toRotationMatrix(),
               Eigen::Vector3d(1.0 + 0.2 * random.Uniform(), 0.0, 0.0)});
  }
  return poses;
}

KittiDrift Drift(const std::vector<Rigid3>& truth,
                 const std::vector<Rigid3>& estimate) {
  std::string error;
  const auto drift = ComputeKittiDrift(truth, estimate, {}, &error);
  EXPECT_TRUE(drift.has_value()) << error;
  return drift.value_or(KittiDrift{});
}

// By hand: on 151 poses one meter apart, more than 100 m are passed at the
// 101st frame after the first, so segments start at 0, 10, 20, 30 and 40 and
// are 101 m long. An estimate that is 2 % too long has an error of 2.02 m over
// "100 m".
TEST(KittiDrift, OfALineTwoPercentTooLongIsByHand) {
  const KittiDrift drift = Drift(Line(151, 1.0), Line(151, 1.02));
  ASSERT_EQ(drift.segments.size(), 5u);
  EXPECT_EQ(drift.segments[1].first, 10u);
  EXPECT_EQ(drift.segments[1].last, 111u);
  EXPECT_NEAR(drift.translation_percent, 2.02, 1e-9);
  EXPECT_NEAR(drift.rotation_deg_per_100m, 0.0, 1e-9);
  EXPECT_NEAR(drift.path_length, 150.0, 1e-9);
  EXPECT_NEAR(drift.end_translation_error, 3.0, 1e-9);
}

// An estimate with correct positions whose heading drifts by 0.01 deg per
// frame: the error is 1.01 deg over 101 frames, and the place 101 m ahead
// appears 2 * 101 sin(f 0.01 deg / 2) from its true position, where f = 0, 10,
// ... 40 is the start of the segment.
TEST(KittiDrift, OfAHeadingThatTurnsIsByHand) {
  const auto truth = Line(151, 1.0);
  auto estimate = truth;
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    estimate[i].rotation = RotationZ(0.01 * kDegree * static_cast<double>(i));
  }
  const KittiDrift drift = Drift(truth, estimate);
  EXPECT_NEAR(drift.rotation_deg_per_100m, 1.01, 1e-9);
  ASSERT_EQ(drift.segments.size(), 5u);
  for (const KittiSegment& segment : drift.segments) {
    // E = (Q_f^-1 Q_l)^-1 (P_f^-1 P_l) with Q_f^-1 Q_l = (R_z(101 a),
    // R_z(-f a) (101, 0, 0)): the translation's norm is that of
    // (101, 0, 0) - R_z(-f a) (101, 0, 0).
    const double a = 0.01 * kDegree * static_cast<double>(segment.first);
    EXPECT_NEAR(segment.translation_error,
                2.0 * 101.0 * std::sin(0.5 * a) / 100.0,
                1e-9);
  }
}

TEST(KittiDrift, MeansAreOverAllLengthsThatFit) {
  // 321 m: 100 m from 0 ... 210, 200 m from 0 ... 110, 300 m from 0 and 10.
  const KittiDrift drift = Drift(Line(321, 1.0), Line(321, 1.01));
  std::map<double, int> count;
  for (const KittiSegment& segment : drift.segments) ++count[segment.length];
  EXPECT_THAT(count,
              ::testing::ElementsAre(::testing::Pair(100.0, 22),
                                     ::testing::Pair(200.0, 12),
                                     ::testing::Pair(300.0, 2)));
  EXPECT_NEAR(drift.translation_percent,
              (22 * 1.01 + 12 * 0.01 * 201 / 2 + 2 * 0.01 * 301 / 3) / 36,
              1e-9);
}

TEST(KittiDrift, DoesNotDependOnTheFrameOfTheWorld) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const auto truth = Drive(300, seed);
    const auto estimate = Drive(300, seed + 100);
    const KittiDrift drift = Drift(truth, estimate);
    const Rigid3 move{RandomRotation(seed), 50.0 * RandomDirection(seed)};
    auto moved = estimate;
    for (Rigid3& pose : moved) pose = move * pose;
    const KittiDrift same = Drift(truth, moved);
    EXPECT_GT(drift.translation_percent, 1.0);
    EXPECT_NEAR(same.translation_percent, drift.translation_percent, 1e-8);
    EXPECT_NEAR(same.rotation_deg_per_100m, drift.rotation_deg_per_100m, 1e-8);
  }
}

TEST(KittiDrift, OfTheTruthIsNone) {
  const auto truth = Drive(300, 7);
  const KittiDrift drift = Drift(truth, truth);
  EXPECT_GT(drift.segments.size(), 10u);
  EXPECT_NEAR(drift.translation_percent, 0.0, 1e-9);
  EXPECT_NEAR(drift.rotation_deg_per_100m, 0.0, 1e-9);
}

TEST(KittiDrift, OfAShortPathHasNoMeanButAnEnd) {
  const KittiDrift drift = Drift(Line(50, 1.0), Line(50, 1.1));
  EXPECT_TRUE(drift.segments.empty());
  EXPECT_TRUE(std::isnan(drift.translation_percent));
  EXPECT_TRUE(std::isnan(drift.rotation_deg_per_100m));
  EXPECT_NEAR(drift.end_translation_error, 4.9, 1e-9);
}

TEST(KittiDrift, BadInputIsNamed) {
  std::string error;
  EXPECT_FALSE(ComputeKittiDrift(Line(3, 1), Line(2, 1), {}, &error));
  EXPECT_THAT(error, ::testing::HasSubstr("3 true poses and 2 estimated"));
  EXPECT_FALSE(ComputeKittiDrift({}, {}, {}, &error));
  KittiDriftOptions options;
  options.step = 0;
  EXPECT_FALSE(ComputeKittiDrift(Line(3, 1), Line(3, 1), options, &error));
  EXPECT_THAT(error, ::testing::HasSubstr("step = 0"));
  options = {};
  options.lengths = {100.0, -1.0};
  EXPECT_FALSE(ComputeKittiDrift(Line(3, 1), Line(3, 1), options, &error));
  EXPECT_THAT(error, ::testing::HasSubstr("lengths"));
}

// The official poses (GPS and INS) compared with SemanticKITTI's (loop-closed
// lidar SLAM). Both are of one drive, so their difference is small but not
// zero.
TEST(KittiDrift, OfTheOfficialPosesOfKitti00IsSmall) {
  const std::string folder = std::string(QUATRO_DATA) + "/kitti_poses/";
  if (!std::filesystem::exists(folder + "kitti/00.txt")) {
    GTEST_SKIP() << "there is no kitti_poses/kitti/00.txt in " << QUATRO_DATA;
  }
  std::string error;
  const auto truth = ReadKittiPoses(folder + "semantickitti/00.txt", &error);
  ASSERT_TRUE(truth) << error;
  const auto official = ReadKittiPoses(folder + "kitti/00.txt", &error);
  ASSERT_TRUE(official) << error;
  ASSERT_EQ(truth->size(), 4541u);
  const KittiDrift drift = Drift(*truth, *official);
  RecordProperty("t_rel_percent", std::to_string(drift.translation_percent));
  RecordProperty("r_rel", std::to_string(drift.rotation_deg_per_100m));
  EXPECT_NEAR(drift.path_length, 3712.34, 0.01);
  // Values from an independent implementation in another language.
  EXPECT_EQ(drift.segments.size(), 3281u);
  EXPECT_NEAR(drift.translation_percent, 0.6527, 1e-3);
  EXPECT_NEAR(drift.rotation_deg_per_100m, 0.2308, 1e-3);
}

}  // namespace
}  // namespace quatro::kitti_metrics_test
