// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/odometry/odometry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "experiments/datasets/sequence.h"
#include "experiments/metrics/kitti_metrics.h"
#include "experiments/odometry/aloam/aloam.h"
#include "experiments/odometry/frame_to_frame.h"
#include "experiments/odometry/odometry_methods.h"
#include "experiments/odometry/suma/suma.h"
#include "experiments/simulator/lidar.h"
#include "experiments/simulator/road.h"
#include "experiments/simulator/street.h"
#include "features/base/degree.h"
#include "features/io/cloud_io.h"
#include "robust/registration/presets.h"
#include "tests/support/random_problems.h"

namespace quatro::odometry_test {
namespace {

using ::testing::HasSubstr;

struct Drive {
  std::vector<PointCloud> scans;
  std::vector<Rigid3> world_from_scan;  // The first scan is the world.
};

// Along a simulated street starting at `start`, `step` [m] per scan, with every
// second column of the sensor.
Drive MakeDrive(int num_scans, double start = 90.0, double step = 0.8) {
  RoadOptions options;
  options.seed = 3;
  const Road road(options);
  std::string error;
  const auto scene = LidarScene::Create(MakeStreet(road), &error);
  EXPECT_TRUE(scene) << error;
  LidarOptions lidar;
  lidar.num_columns = 1041;
  Drive drive;
  for (int i = 0; i < num_scans; ++i) {
    const Rigid3 pose = road.WorldFromSensor(start + step * i, 0.0, 0.0);
    drive.scans.push_back(
        scene->Scan(pose, lidar, {5, static_cast<uint64_t>(i)}, 1));
    drive.world_from_scan.push_back(pose);
  }
  const Rigid3 first_from_world = Inverse(drive.world_from_scan[0]);
  for (Rigid3& pose : drive.world_from_scan) pose = first_from_world * pose;
  return drive;
}

const Drive& TheDrive() {
  static const Drive drive = MakeDrive(14);
  return drive;
}

std::unique_ptr<Odometry> Make(const std::string& name, int num_threads = 1) {
  RegistrationOptions options = *MakePreset("kitti");
  options.num_threads = num_threads;
  std::string error;
  auto odometry = MakeOdometry(name, options, &error);
  EXPECT_TRUE(odometry) << error;
  return odometry;
}

std::vector<OdometryStep> Follow(Odometry* odometry,
                                 const std::vector<PointCloud>& scans) {
  std::vector<OdometryStep> steps;
  for (const PointCloud& scan : scans) steps.push_back(odometry->AddScan(scan));
  return steps;
}

double TranslationError(const Rigid3& a, const Rigid3& b) {
  return (a.translation - b.translation).norm();
}

class OdometryMethodTest : public ::testing::TestWithParam<const char*> {};

// The error is within 1 % of the path plus 5 cm of noise, and half a degree,
// along the whole path. Point to point converges slowly, because the rings of
// two scans attract each other.
TEST_P(OdometryMethodTest, FollowsASimulatedStreet) {
  const Drive& drive = TheDrive();
  const bool creeps = GetParam() == std::string("icp");
  const double max_drift = creeps ? 0.08 : 0.01;
  const double max_angle = (creeps ? 1.0 : 0.5) * kDegree;
  const auto odometry = Make(GetParam());
  const auto steps = Follow(odometry.get(), drive.scans);
  EXPECT_EQ(steps[0].status, OdometryStatus::kFirst);
  for (std::size_t i = 1; i < steps.size(); ++i) {
    EXPECT_EQ(steps[i].status, OdometryStatus::kTracked) << steps[i].message;
    const double path = 0.8 * static_cast<double>(i);
    EXPECT_LT(
        TranslationError(steps[i].world_from_scan, drive.world_from_scan[i]),
        0.05 + max_drift * path)
        << "scan " << i;
    EXPECT_LT(AngleBetween(steps[i].world_from_scan.rotation,
                           drive.world_from_scan[i].rotation),
              max_angle)
        << "scan " << i;
  }
}

TEST_P(OdometryMethodTest, ThreadsDoNotMatterBitForBit) {
  const std::vector<PointCloud> scans(TheDrive().scans.begin(),
                                      TheDrive().scans.begin() + 4);
  const auto one = Follow(Make(GetParam(), 1).get(), scans);
  const auto three = Follow(Make(GetParam(), 3).get(), scans);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    EXPECT_EQ(one[i].world_from_scan.ToMatrix(),
              three[i].world_from_scan.ToMatrix());
  }
}

TEST_P(OdometryMethodTest, TheSameScanAgainIsTheSamePlace) {
  const PointCloud& scan = TheDrive().scans[0];
  const auto steps = Follow(Make(GetParam()).get(), {scan, scan, scan});
  for (const OdometryStep& step : steps) {
    EXPECT_LT(step.world_from_scan.translation.norm(), 0.02) << step.message;
    EXPECT_LT(AngleBetween(step.world_from_scan.rotation,
                           Eigen::Matrix3d::Identity()),
              0.1 * kDegree);
  }
}

// Unusable scans.
std::vector<PointCloud> BadScans() {
  std::vector<PointCloud> bad(5);
  bad[1].points = Points::Ones(3, 1);
  bad[2].points = Points::Constant(3, 5000, 4.0);  // All one point.
  bad[3].points = TheDrive().scans[0].points;
  bad[3].points(1, 77) = std::numeric_limits<double>::quiet_NaN();
  bad[4].points = TheDrive().scans[0].points.array() + 1e7;
  return bad;
}

TEST_P(OdometryMethodTest, ABadScanIsLostAndTheNextIsNot) {
  const Drive& drive = TheDrive();
  const double max_error = GetParam() == std::string("icp") ? 0.3 : 0.15;
  for (std::size_t b = 0; b < BadScans().size(); ++b) {
    SCOPED_TRACE(b);
    const auto odometry = Make(GetParam());
    Follow(odometry.get(), {drive.scans[0], drive.scans[1], drive.scans[2]});
    const OdometryStep bad = odometry->AddScan(BadScans()[b]);
    EXPECT_EQ(bad.status, OdometryStatus::kLost);
    EXPECT_NE(bad.message, "");
    // The pose continues at constant velocity.
    EXPECT_LT(TranslationError(bad.world_from_scan, drive.world_from_scan[3]),
              max_error);
    const OdometryStep next = odometry->AddScan(drive.scans[4]);
    EXPECT_EQ(next.status, OdometryStatus::kTracked) << next.message;
    EXPECT_LT(TranslationError(next.world_from_scan, drive.world_from_scan[4]),
              max_error);
  }
}

TEST_P(OdometryMethodTest, BadScansAtTheStartAreNotTheWorld) {
  const Drive& drive = TheDrive();
  const auto odometry = Make(GetParam());
  for (const PointCloud& bad : {BadScans()[0], BadScans()[1], BadScans()[3]}) {
    EXPECT_EQ(odometry->AddScan(bad).status, OdometryStatus::kLost);
  }
  const OdometryStep first = odometry->AddScan(drive.scans[0]);
  EXPECT_EQ(first.status, OdometryStatus::kFirst) << first.message;
  EXPECT_EQ(first.world_from_scan.translation.norm(), 0.0);
  EXPECT_EQ(odometry->AddScan(drive.scans[1]).status, OdometryStatus::kTracked);
}

// Real scans of KITTI 00, 0.5 to 2 m apart.
TEST_P(OdometryMethodTest, FollowsKitti00) {
  const std::string folder = std::string(QUATRO_DATA) + "/kitti_00/";
  std::vector<PointCloud> scans;
  for (const char* name : {"000000.bin", "000001.bin", "000002.bin"}) {
    if (!std::filesystem::exists(folder + name)) {
      GTEST_SKIP() << "there is no kitti_00/" << name << " in " << QUATRO_DATA;
    }
    std::string error;
    const auto cloud = ReadCloud(folder + name, &error);
    ASSERT_TRUE(cloud) << error;
    scans.push_back(*cloud);
  }
  const auto steps = Follow(Make(GetParam()).get(), scans);
  // From pairs.csv: 000001 and 000002 in 000000.
  const Eigen::Vector3d truth[] = {{0.672784, 0.000508, 0.019690},
                                   {1.374692, 0.003031, 0.027451}};
  for (std::size_t i = 1; i < 3; ++i) {
    EXPECT_EQ(steps[i].status, OdometryStatus::kTracked) << steps[i].message;
    EXPECT_LT((steps[i].world_from_scan.translation - truth[i - 1]).norm(), 0.1)
        << steps[i].world_from_scan.translation.transpose();
  }
}

INSTANTIATE_TEST_SUITE_P(All,
                         OdometryMethodTest,
                         ::testing::Values("aloam", "suma"),
                         [](const auto& test) {
                           return std::string(test.param);
                         });

INSTANTIATE_TEST_SUITE_P(
    FrameToFrame,
    OdometryMethodTest,
    ::testing::Values("icp", "gicp", "vgicp", "quatro_c2f", "fgr", "ransac10k"),
    [](const auto& test) { return std::string(test.param); });

TEST(Aloam, AScanWithoutRingsIsLost) {
  const auto odometry = Make("aloam");
  PointCloud cloud;
  cloud.points = RandomStreet(20000, 0.02, 1);
  const OdometryStep step = odometry->AddScan(cloud);
  EXPECT_EQ(step.status, OdometryStatus::kLost);
  EXPECT_THAT(step.message, HasSubstr("rings"));
}

// Without a matching map there is only the previous scan, which drifts more.
TEST(Aloam, TheMapHoldsTheDrift) {
  const Drive& drive = TheDrive();
  double error[2] = {};
  for (const bool has_map : {false, true}) {
    AloamOptions options;
    if (!has_map) options.max_map_distance = 1e-6;
    Aloam odometry(options);
    for (std::size_t i = 0; i < drive.scans.size(); ++i) {
      const OdometryStep step = odometry.AddScan(drive.scans[i]);
      EXPECT_NE(step.status, OdometryStatus::kLost) << step.message;
      error[has_map] +=
          TranslationError(step.world_from_scan, drive.world_from_scan[i]);
    }
  }
  EXPECT_LT(error[1], 0.7 * error[0]);
}

// Before there is a velocity, a second scan that is meters ahead is found only
// because of the start rounds of a method.
template <typename Method, typename Options>
double ErrorOfASecondScan(double ahead, const Options& options) {
  const Drive drive = MakeDrive(2, 40.0, ahead);
  Method odometry(options);
  const auto steps = Follow(&odometry, drive.scans);
  EXPECT_EQ(steps[1].status, OdometryStatus::kTracked) << steps[1].message;
  return TranslationError(steps[1].world_from_scan, drive.world_from_scan[1]);
}

TEST(Aloam, TheSecondScanMayBeMetresAhead) {
  AloamOptions options;
  EXPECT_LT(ErrorOfASecondScan<Aloam>(3.2, options), 0.05);
  options.start_rounds = options.num_rounds;
  EXPECT_GT(ErrorOfASecondScan<Aloam>(3.2, options), 1.0);
}

TEST(Suma, TheSecondScanMayBeMetresAhead) {
  SumaOptions options;
  EXPECT_LT(ErrorOfASecondScan<Suma>(5.6, options), 0.05);
  options.start_distance = options.icp.max_distance;
  EXPECT_GT(ErrorOfASecondScan<Suma>(5.6, options), 1.0);
}

// Steps of one meter with a turn, with exact answers.
FrameAligner ExactAligner(const Rigid3& last_from_next) {
  return [last_from_next](const PointCloud&, const PointCloud&, const Rigid3&) {
    return FrameAlignment{last_from_next, "exact"};
  };
}

PointCloud SomeCloud() {
  PointCloud cloud;
  cloud.points = RandomPoints(200, 5.0, 1);
  return cloud;
}

// Without renormalization, rotations diverge from the path within about forty
// scans, because each guess doubles the error.
TEST(FrameToFrameTest, ALongRingClosesAndStaysARotation) {
  const int n = 720;
  const Rigid3 step{RotationZ(2.0 * M_PI / n), Eigen::Vector3d(1.0, 0.0, 0.0)};
  FrameToFrame odometry(ExactAligner(step));
  OdometryStep last;
  for (int i = 0; i <= n; ++i) last = odometry.AddScan(SomeCloud());
  EXPECT_LT(last.world_from_scan.translation.norm(), 1e-8);
  const Eigen::Matrix3d& rotation = last.world_from_scan.rotation;
  EXPECT_LT(
      (rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).norm(),
      1e-12);
}

// The same if the answer is derived from the guess, as in local methods.
TEST(FrameToFrameTest, ALongRingOfGuessesClosesAndStaysARotation) {
  const int n = 720;
  const Rigid3 step{RandomRotation(1) * RotationZ(2.0 * M_PI / n) *
                        RandomRotation(1).transpose(),
                    Eigen::Vector3d(0.0, 0.0, 0.0)};
  int num_calls = 0;
  FrameToFrame odometry(
      [&](const PointCloud&, const PointCloud&, const Rigid3& guess) {
        return FrameAlignment{num_calls++ == 0 ? step : guess, "guessed"};
      });
  OdometryStep last;
  for (int i = 0; i <= n; ++i) last = odometry.AddScan(SomeCloud());
  const Eigen::Matrix3d& rotation = last.world_from_scan.rotation;
  EXPECT_LT((rotation - Eigen::Matrix3d::Identity()).norm(), 1e-8);
  EXPECT_LT(
      (rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).norm(),
      1e-12);
}

TEST(FrameToFrameTest, APoseThatIsNotFiniteIsLost) {
  Rigid3 bad;
  bad.translation.x() = std::numeric_limits<double>::quiet_NaN();
  const Rigid3 good{RotationZ(0.1), Eigen::Vector3d(1.0, 2.0, 3.0)};
  int num_calls = 0;
  FrameToFrame odometry(
      [&](const PointCloud&, const PointCloud&, const Rigid3&) {
        return FrameAlignment{num_calls++ == 0 ? bad : good, "told"};
      });
  odometry.AddScan(SomeCloud());
  const OdometryStep step = odometry.AddScan(SomeCloud());
  EXPECT_EQ(step.status, OdometryStatus::kLost);
  EXPECT_EQ(step.message, "the pose is not finite");
  EXPECT_TRUE(step.world_from_scan.ToMatrix().allFinite());
  EXPECT_LT(
      TranslationError(odometry.AddScan(SomeCloud()).world_from_scan, good),
      1e-12);
}

TEST(FrameToFrameTest, TheGuessIsConstantVelocityAndLostScansGoOnByIt) {
  const Rigid3 step{RotationZ(0.1), Eigen::Vector3d(2.0, 0.5, 0.1)};
  std::vector<Rigid3> guesses;
  FrameToFrame odometry([&](const PointCloud&,
                            const PointCloud&,
                            const Rigid3& guess) -> FrameAlignment {
    guesses.push_back(guess);
    if (guesses.size() == 3) return {std::nullopt, "fails on purpose"};
    // The fourth call is two steps from the last tracked scan.
    return {guesses.size() == 4 ? step * step : step, "exact"};
  });
  std::vector<OdometryStep> steps =
      Follow(&odometry, std::vector<PointCloud>(5, SomeCloud()));
  EXPECT_LT((guesses[0].ToMatrix() - Eigen::Matrix4d::Identity()).norm(),
            1e-12);
  EXPECT_LT((guesses[1].ToMatrix() - step.ToMatrix()).norm(), 1e-12);
  EXPECT_EQ(steps[3].status, OdometryStatus::kLost);
  EXPECT_EQ(steps[3].message, "fails on purpose");
  Rigid3 expected;
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_LT(
        (steps[i].world_from_scan.ToMatrix() - expected.ToMatrix()).norm(),
        1e-12)
        << i;
    expected = expected * step;
  }
  EXPECT_LT((guesses[3].ToMatrix() - (step * step).ToMatrix()).norm(), 1e-12);
}

TEST(FrameToFrameTest, AMethodFromCloudsIsGivenBothScansAndTheGuess) {
  const PointCloud source = SomeCloud();
  PointCloud target = SomeCloud();
  target.points *= 2.0;
  const Rigid3 guess{RotationZ(0.1), {1.0, 2.0, 3.0}};
  RegistrationOptions options;
  options.seed = 7;
  const FrameAligner aligner = MakeFrameAligner(
      [&](const PointCloud& given_source,
          const PointCloud& given_target,
          const MatchedClouds* matched,
          const RegistrationOptions& given) {
        EXPECT_EQ(matched, nullptr);
        EXPECT_EQ(given_source.points, source.points);
        EXPECT_EQ(given_target.points, target.points);
        EXPECT_EQ(given.seed, 7u);
        RegistrationSummary summary;
        summary.verdict.reason = "as told";
        summary.solution.target_from_source = given.bounds.guess;
        return summary;
      },
      options);
  const FrameAlignment alignment = aligner(source, target, guess);
  ASSERT_TRUE(alignment.target_from_source);
  EXPECT_EQ(alignment.target_from_source->ToMatrix(), guess.ToMatrix());
  EXPECT_THAT(alignment.message, HasSubstr("as told"));
}

// The last step, 5.6 m, is too far from the identity.
TEST(FrameToFrameTest, GicpFollowsFromConstantVelocity) {
  const Drive& drive = TheDrive();
  const auto odometry = Make("gicp");
  const auto steps =
      Follow(odometry.get(),
             {drive.scans[0], drive.scans[2], drive.scans[6], drive.scans[13]});
  EXPECT_EQ(steps[3].status, OdometryStatus::kTracked) << steps[3].message;
  EXPECT_LT(
      TranslationError(steps[3].world_from_scan, drive.world_from_scan[13]),
      0.2);
}

// Any estimator of the other registry, here on scans 8 m apart.
TEST(FrameToFrameTest, QuatroFollowsLongSteps) {
  const Drive& drive = TheDrive();
  const auto odometry = Make("quatro", 2);
  const auto steps = Follow(odometry.get(), {drive.scans[0], drive.scans[10]});
  EXPECT_EQ(steps[1].status, OdometryStatus::kTracked) << steps[1].message;
  EXPECT_THAT(steps[1].message, HasSubstr("registered"));
  EXPECT_LT(
      TranslationError(steps[1].world_from_scan, drive.world_from_scan[10]),
      0.3);
}

TEST(MakeOdometryTest, KnowsItsNamesAndRefusesOthers) {
  const auto names = OdometryNames();
  EXPECT_THAT(names,
              ::testing::IsSupersetOf({"aloam",
                                       "suma",
                                       "quatro",
                                       "icp",
                                       "gicp",
                                       "vgicp",
                                       "quatro_c2f",
                                       "fgr",
                                       "ransac10k"}));
  EXPECT_THAT(names, ::testing::Not(::testing::Contains("quatro_ins")));
  for (const std::string& name : names) {
    EXPECT_TRUE(Make(name)) << name;
    EXPECT_THAT(DescribeOdometries(), HasSubstr(name));
  }
  std::string error;
  EXPECT_FALSE(MakeOdometry("loam", *MakePreset("kitti"), &error));
  EXPECT_THAT(error, HasSubstr("--method=loam, must be one of aloam suma"));
  RegistrationOptions bad;
  bad.num_threads = -1;
  EXPECT_FALSE(MakeOdometry("suma", bad, &error));
  EXPECT_THAT(error, HasSubstr("num_threads"));
}

TEST(OdometryOptions, ErrorsNameTheField) {
  std::string error;
  AloamOptions aloam;
  aloam.num_rounds = 0;
  EXPECT_FALSE(aloam.IsValid(&error));
  EXPECT_THAT(error, HasSubstr("num_rounds = 0"));
  aloam = {};
  aloam.features.num_sectors = 0;
  EXPECT_FALSE(aloam.IsValid(&error));
  EXPECT_THAT(error, HasSubstr("num_sectors = 0"));
  aloam = {};
  aloam.edge_voxel = 0.0;
  EXPECT_FALSE(aloam.IsValid(&error));
  EXPECT_THAT(error, HasSubstr("edge_voxel = 0"));
  SumaOptions suma;
  suma.width = 1;
  EXPECT_FALSE(suma.IsValid(&error));
  EXPECT_THAT(error, HasSubstr("width, height = 1"));
  suma = {};
  suma.map.stable = 0.4;
  EXPECT_FALSE(suma.IsValid(&error));
  EXPECT_THAT(error, HasSubstr("stable = 0.4"));
  suma = {};
  suma.start_rounds = 0;
  EXPECT_FALSE(suma.IsValid(&error));
  EXPECT_THAT(error, HasSubstr("start_rounds = 0"));
  suma = {};
  suma.start_distance = 1.0;
  EXPECT_FALSE(suma.IsValid(&error));
  EXPECT_THAT(error, HasSubstr("start_distance = 1"));
  suma = {};
  suma.min_range = -1.0;
  EXPECT_FALSE(suma.IsValid(&error));
  EXPECT_THAT(error, HasSubstr("min_range = -1"));
}

}  // namespace
}  // namespace quatro::odometry_test
