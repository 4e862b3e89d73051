// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/simulator/simulator.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "experiments/simulator/lidar.h"
#include "experiments/simulator/scene.h"
#include "features/base/degree.h"
#include "features/base/rigid3.h"
#include "features/io/cloud_io.h"
#include "features/kd_tree.h"
#include "features/voxel_grid.h"
#include "tests/support/matchers.h"
#include "tests/support/run_program.h"

namespace quatro::simulator_test {
namespace {

namespace fs = std::filesystem;

using ::testing::HasSubstr;

SimulatedPair MakePair(const SimulatePairOptions& options) {
  std::string error;
  const auto pair = SimulatePair(options, &error);
  EXPECT_TRUE(pair.has_value()) << error;
  return pair.value_or(SimulatedPair());
}

// Median distance of source points near the center of both scans to the closest
// target point [m].
double MedianGap(const SimulatedPair& pair, const Rigid3& target_from_source) {
  const KdTree target(pair.target.points);
  const Eigen::Vector3d middle = pair.true_target_from_source.translation / 2.0;
  std::vector<double> gaps;
  for (Eigen::Index i = 0; i < pair.source.points.cols(); i += 50) {
    const Eigen::Vector3d point =
        target_from_source * Eigen::Vector3d(pair.source.points.col(i));
    if ((point - middle).norm() > 10.0) continue;
    gaps.push_back(std::sqrt(target.Nearest(point, 1)[0].squared_distance));
  }
  EXPECT_GT(gaps.size(), 500u);
  std::nth_element(gaps.begin(), gaps.begin() + gaps.size() / 2, gaps.end());
  return gaps[gaps.size() / 2];
}

TEST(SimulatePairTest, ScansAreAsLargeAsThoseOfKitti) {
  for (const uint64_t seed : {1, 2}) {
    SimulatePairOptions options;
    options.seed = seed;
    const SimulatedPair pair = MakePair(options);
    for (const PointCloud* cloud : {&pair.source, &pair.target}) {
      std::string error;
      const auto voxels = SampleVoxels(cloud->points, 0.3, &error);
      ASSERT_TRUE(voxels.has_value()) << error;
      EXPECT_GE(voxels->cols(), 10000) << "seed " << seed;
      EXPECT_LE(voxels->cols(), 22000) << "seed " << seed;
      EXPECT_GE(cloud->points.cols(), 100000) << "seed " << seed;
      EXPECT_LE(cloud->points.cols(), 127000) << "seed " << seed;
      ASSERT_EQ(cloud->intensity.size(), cloud->points.cols());
      EXPECT_GE(cloud->intensity.minCoeff(), 0.0f);
      EXPECT_LE(cloud->intensity.maxCoeff(), 1.0f);
    }
  }
}

TEST(SimulatePairTest, TrueMotionBringsTheScansTogether) {
  SimulatePairOptions options;
  options.distance = 8.0;
  options.yaw = 2.0;
  options.slope = 5.0 * kDegree;
  const SimulatedPair pair = MakePair(options);
  const Rigid3 shift = {Eigen::Matrix3d::Identity(),
                        Eigen::Vector3d(0.0, 0.0, 0.5)};
  EXPECT_LT(MedianGap(pair, pair.true_target_from_source), 0.15);
  EXPECT_GT(MedianGap(pair, shift * pair.true_target_from_source), 0.25);
}

TEST(SimulatePairTest, MotionIsWhatTheOptionsSay) {
  SimulatePairOptions options;
  options.distance = 12.0;
  options.yaw = M_PI;
  options.slope = 8.0 * kDegree;
  options.tilt_sigma = 0.0;
  const Rigid3 motion = MakePair(options).true_target_from_source;
  EXPECT_NEAR(motion.translation.norm(),
              options.distance / std::cos(options.slope),
              0.2);
  // The turn of the street along the path is added.
  EXPECT_THAT(Yaw(motion.rotation), IsAngleNear(M_PI, 8.0 * kDegree));
  // The car rotates about the normal of the ground, so a uniform slope is not
  // visible from it.
  EXPECT_LT(std::acos(motion.rotation(2, 2)), 3.0 * kDegree);
  options.tilt_sigma = 8.0 * kDegree;
  const Rigid3 tilted = MakePair(options).true_target_from_source;
  EXPECT_GT(std::acos(tilted.rotation(2, 2)), 4.0 * kDegree);
}

TEST(SimulatePairTest, SeedDecidesEverythingAndThreadsNothing) {
  SimulatePairOptions options;
  options.num_threads = 1;
  const SimulatedPair one = MakePair(options);
  options.num_threads = 2;
  const SimulatedPair two = MakePair(options);
  EXPECT_EQ(one.source.points, two.source.points);
  EXPECT_EQ(one.source.intensity, two.source.intensity);
  EXPECT_EQ(one.target.points, two.target.points);
  EXPECT_EQ(one.true_target_from_source.ToMatrix(),
            two.true_target_from_source.ToMatrix());
  options.seed = 2;
  EXPECT_NE(MakePair(options).source.points.cols(), one.source.points.cols());
}

TEST(SimulatePairTest, InvalidOptionsAreNamed) {
  SimulatePairOptions options;
  std::string error;
  options.distance = -1.0;
  EXPECT_FALSE(SimulatePair(options, &error).has_value());
  EXPECT_THAT(error, HasSubstr("distance = -1, must be"));
  options = {};
  options.yaw = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(options.IsValid(&error));
  EXPECT_THAT(error, HasSubstr("yaw = nan"));
  options = {};
  options.slope = 1.0;
  EXPECT_FALSE(options.IsValid(&error));
  EXPECT_THAT(error, HasSubstr("slope = 1, must be"));
  options = {};
  options.lidar.range_sigma = -0.02;
  EXPECT_FALSE(options.IsValid(&error));
  EXPECT_THAT(error, HasSubstr("range_sigma = -0.02, must be"));
  options = {};
  options.num_threads = -1;
  EXPECT_FALSE(options.IsValid(&error));
  EXPECT_THAT(error, HasSubstr("num_threads = -1, must be"));
}

TEST(LidarTest, BeamTableIsThatOfTheHdl64E) {
  const std::vector<double> elevations = Hdl64Elevations();
  ASSERT_EQ(elevations.size(), 64u);
  EXPECT_NEAR(elevations[0], 2.0 * kDegree, 1e-12);
  EXPECT_NEAR(elevations[31], -(8.0 + 1.0 / 3.0) * kDegree, 1e-12);
  EXPECT_NEAR(elevations[32], -(8.0 + 5.0 / 6.0) * kDegree, 1e-12);
  EXPECT_NEAR(elevations[63], -(24.0 + 1.0 / 3.0) * kDegree, 1e-12);
}

// A wall across the x axis, seen from the origin.
class WallTest : public ::testing::Test {
 protected:
  static PointCloud ScanWall(double distance, const LidarOptions& options) {
    Scene scene;
    scene.AddQuad({distance, -5.0, -9.0},
                  {distance, 5.0, -9.0},
                  {distance, 5.0, 9.0},
                  {distance, -5.0, 9.0},
                  0.8f);
    std::string error;
    const auto lidar_scene = LidarScene::Create(scene, &error);
    EXPECT_NE(lidar_scene, nullptr) << error;
    return lidar_scene->Scan(Rigid3(), options, ScanId(), 1);
  }
};

TEST_F(WallTest, RangesAreNoisyAlongTheRay) {
  constexpr double kDistance = 10.0;  // [m]
  const PointCloud cloud = ScanWall(kDistance, LidarOptions());
  const Eigen::Index n = cloud.points.cols();
  ASSERT_GT(n, 5000);
  const Eigen::ArrayXd ranges = cloud.points.colwise().norm();
  const Eigen::ArrayXd noise =
      ranges - kDistance * ranges / cloud.points.row(0).transpose().array();
  const double mean = noise.mean();
  const double sigma = std::sqrt((noise - mean).square().mean());
  EXPECT_NEAR(mean, 0.0, 0.001);
  EXPECT_NEAR(sigma, 0.02, 0.001);
}

TEST_F(WallTest, RangeLimitsHold) {
  EXPECT_EQ(ScanWall(130.0, LidarOptions()).points.cols(), 0);
  const PointCloud close = ScanWall(0.3, LidarOptions());
  EXPECT_GT(close.points.colwise().norm().minCoeff(), 0.8);
  LidarOptions options;
  options.dropout_rate = 1.0;
  EXPECT_EQ(ScanWall(10.0, options).points.cols(), 0);
}

class SimulateSequenceTest : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::remove_all(folder_);
    options_.num_frames = 2;
    options_.frame_spacing = 10.0;
    options_.slope = 4.0 * kDegree;
  }
  void TearDown() override { fs::remove_all(folder_); }

  bool Simulate() {
    return SimulateSequence(options_, folder_.string(), nullptr, &error_);
  }

  // The 12 numbers at the stream's position.
  static Rigid3 ReadRigid3(std::istream& stream) {
    Rigid3 transform;
    for (Eigen::Index row = 0; row < 3; ++row) {
      for (Eigen::Index column = 0; column < 3; ++column) {
        stream >> transform.rotation(row, column);
      }
      stream >> transform.translation[row];
    }
    EXPECT_TRUE(stream.good());
    return transform;
  }

  const fs::path folder_ =
      fs::path(::testing::TempDir()) /
      (std::string("quatro_simulator_") +
       ::testing::UnitTest::GetInstance()->current_test_info()->name());
  SimulateSequenceOptions options_;
  std::string error_;
};

// A pair equals a sequence of two frames: each has the true pose of the other.
TEST_F(SimulateSequenceTest, FilesGiveBackTheTrueMotion) {
  ASSERT_TRUE(Simulate()) << error_;
  SimulatePairOptions pair_options;
  pair_options.distance = options_.frame_spacing;
  pair_options.slope = options_.slope;
  const SimulatedPair pair = MakePair(pair_options);

  std::ifstream calib(folder_ / "calib.txt"), poses(folder_ / "poses.txt");
  std::string name;
  while (calib >> name && name != "Tr:") {
    calib.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }
  const Rigid3 cam0_from_sensor = ReadRigid3(calib);
  const Rigid3 first = ReadRigid3(poses), second = ReadRigid3(poses);
  const Rigid3 target_from_source =
      Inverse(cam0_from_sensor) * Inverse(first) * second * cam0_from_sensor;
  EXPECT_LT(
      (target_from_source.ToMatrix() - pair.true_target_from_source.ToMatrix())
          .norm(),
      1e-9);
  EXPECT_LT((first.ToMatrix() - Eigen::Matrix4d::Identity()).norm(), 1e-12);
  // Forward is z of a camera.
  EXPECT_GT(second.translation.z(), 9.0);

  const auto source =
      ReadCloud((folder_ / "velodyne" / "000001.bin").string(), &error_);
  ASSERT_TRUE(source.has_value()) << error_;
  ASSERT_EQ(source->points.cols(), pair.source.points.cols());
  EXPECT_LT((source->points - pair.source.points).cwiseAbs().maxCoeff(), 1e-5);

  std::ifstream times(folder_ / "times.txt");
  double start = -1.0, next = -1.0;
  times >> start >> next;
  EXPECT_EQ(start, 0.0);
  EXPECT_NEAR(next, 0.1, 1e-9);
}

TEST_F(SimulateSequenceTest, ReportsProgressPerFrame) {
  std::vector<int> done;
  ASSERT_TRUE(SimulateSequence(
      options_,
      folder_.string(),
      [&](int num_done, int num_frames) {
        done.push_back(num_done);
        EXPECT_EQ(num_frames, 2);
        EXPECT_FALSE(fs::exists(folder_)) << "seen before it was complete";
      },
      &error_))
      << error_;
  EXPECT_THAT(done, ::testing::ElementsAre(1, 2));
}

TEST_F(SimulateSequenceTest, LeavesAFolderThatIsInUseAlone) {
  fs::create_directories(folder_);
  std::ofstream(folder_ / "thesis.tex") << "text";
  EXPECT_FALSE(Simulate());
  EXPECT_THAT(error_, HasSubstr("folder is not empty"));
  options_.overwrite = true;
  EXPECT_FALSE(Simulate());
  EXPECT_THAT(error_, HasSubstr("'thesis.tex'"));
  EXPECT_TRUE(fs::exists(folder_ / "thesis.tex"));
  EXPECT_FALSE(fs::exists(folder_ / "poses.txt"));
}

TEST_F(SimulateSequenceTest, ReplacesASequenceOnlyIfAsked) {
  fs::create_directories(folder_);
  ASSERT_TRUE(Simulate()) << error_;  // An empty folder is allowed.
  EXPECT_FALSE(Simulate());
  options_.overwrite = true;
  options_.num_frames = 1;
  ASSERT_TRUE(Simulate()) << error_;
  EXPECT_TRUE(fs::exists(folder_ / "velodyne" / "000000.bin"));
  EXPECT_FALSE(fs::exists(folder_ / "velodyne" / "000001.bin"));
}

TEST_F(SimulateSequenceTest, OtherFilesBesideTheScansAreNotRemoved) {
  ASSERT_TRUE(Simulate()) << error_;
  options_.overwrite = true;
  for (const char* name : {"velodyne/0.bin",
                           "velodyne/000000.bin.bak",
                           "oxts/data/notes.txt",
                           "oxts/timestamps.txt",
                           "sensors/map.pcd"}) {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name) << "text";
    EXPECT_FALSE(Simulate()) << name;
    EXPECT_THAT(error_, HasSubstr("holds '" + std::string(name) + "'"));
    EXPECT_TRUE(fs::remove(folder_ / name)) << name;
  }
  EXPECT_TRUE(Simulate()) << error_;
}

TEST_F(SimulateSequenceTest, FailsInOneLineWhereNothingCanBeWritten) {
  std::ofstream(folder_.string()) << "a file";
  EXPECT_FALSE(Simulate());
  EXPECT_THAT(error_, HasSubstr("exists and is not a folder"));
  EXPECT_FALSE(
      SimulateSequence(options_, folder_.string() + "/x", nullptr, &error_));
  EXPECT_THAT(error_, HasSubstr(folder_.string()));
  EXPECT_FALSE(SimulateSequence(options_, "", nullptr, &error_));
  EXPECT_THAT(error_, HasSubstr("output_dir"));
}

TEST_F(SimulateSequenceTest, InvalidOptionsAreNamed) {
  options_.num_frames = 0;
  EXPECT_FALSE(Simulate());
  EXPECT_THAT(error_, HasSubstr("num_frames = 0, must be"));
  options_ = {};
  options_.frame_spacing = 0.0;
  EXPECT_FALSE(Simulate());
  EXPECT_THAT(error_, HasSubstr("frame_spacing = 0, must be"));
  EXPECT_FALSE(fs::exists(folder_));
}

class SimulateProgramTest : public ProgramTest {};

TEST_F(SimulateProgramTest, StoppedItLeavesNothing) {
  const std::string output = PathOf("new/drive");
  const auto expect_nothing = [&](const std::string& flags,
                                  const std::string& signal) {
    const std::string command =
        QUATRO_BIN_DIR "/quatro_simulate --output=" + output + " " + flags +
        " 2>" + PathOf("err.txt") + " & pid=$!; while kill -0 $pid && ! [ -d " +
        output + ".partial.$pid ]; do sleep 0.02; done; kill -" + signal +
        " $pid; wait $pid";
    const int status = std::system(command.c_str());
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 3) << flags;
    EXPECT_THAT(Read("err.txt"),
                HasSubstr("interrupted; the partial sequence was removed"));
    fs::remove(PathOf("err.txt"));
    EXPECT_THAT(Contents(), ::testing::IsEmpty());
  };
  expect_nothing("--num_frames=200 --frame_spacing=0.1", "INT");
  expect_nothing("--protocol=drive --drive=hd_b1 --num_frames=0", "TERM");
}

TEST_F(SimulateProgramTest, RefusesFlagsThatItWouldNotUse) {
  const auto expect = [&](const std::string& protocol,
                          const std::string& flag,
                          const std::string& protocols) {
    ExpectBadInput("quatro_simulate",
                   {"--output=" + PathOf("a"), "--protocol=" + protocol, flag},
                   flag.substr(0, flag.find('=')) +
                       " cannot be used with --protocol=" + protocol,
                   "only with: " + protocols + "\n");
  };
  expect("sequence", "--sensor=foo", "drive, pairs");
  expect("sequence", "--world=foo", "pairs");
  expect("sequence", "--drive=99", "drive");
  expect("sequence", "--layout=naver", "drive");
  expect("drive", "--slope_deg=3", "sequence");
  expect("pairs", "--scale=2", "calibration");
  expect("calibration", "--num_frames=100", "sequence, drive");
  ExpectBadInput("quatro_simulate",
                 {"--output=" + PathOf("a"), "--protocol="},
                 "--protocol=, must be one of",
                 "sequence, drive, pairs, calibration");
}

TEST_F(SimulateProgramTest, RangesAreToldByTheFlag) {
  const auto expect = [&](const std::string& protocol,
                          const std::string& flag,
                          const std::string& range) {
    ExpectBadInput("quatro_simulate",
                   {"--output=" + PathOf("a"), "--protocol=" + protocol, flag},
                   "quatro_simulate: " + flag + ", must be ",
                   range);
  };
  expect("sequence", "--slope_deg=21", "in [-20, 20]");
  expect("sequence", "--slope_deg=nan", "in [-20, 20]");
  expect("sequence", "--tilt_sigma_deg=-1", "in [0, 11]");
  expect("drive", "--drive=99", "one of 00");
  expect("drive", "--moving_cars=-1", "in [0, 1000]");
  expect("drive", "--ins_noise_deg=-1", "in [0, 11]");
  expect("drive", "--ins_bias_deg=12", "in [0, 11]");
  expect("pairs", "--pairs=0", "in [1, 1000000]");
  expect("pairs", "--min_distance=40", "in [0, --max_distance=30]");
  expect("pairs", "--max_yaw_deg=181", "in [0, 180]");
  expect("pairs", "--min_tilt_deg=16", "in [0, 15], at most --max_tilt_deg");
  expect("pairs", "--max_tilt_deg=18", "in [0, 17]");
  expect("pairs", "--features=1001", "<= 1000");
  expect("pairs", "--ins_std_deg=-1", "in [0, 11]");
  ExpectBadInput("quatro_simulate",
                 {"--output=" + PathOf("a"), "--frame_spacing=100"},
                 "--num_frames=100 with --frame_spacing=100 is a drive of",
                 "must be <= 5000 m");
}

// The largest angles of the flags are within the ranges of the options.
TEST_F(SimulateProgramTest, LargestAnglesAreTaken) {
  const ProgramRun run = RunProgram("quatro_simulate",
                                    {"--output=" + PathOf("a"),
                                     "--slope_deg=20",
                                     "--tilt_sigma_deg=11",
                                     "--num_frames=1"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const ProgramRun pairs = RunProgram("quatro_simulate",
                                      {"--output=" + PathOf("b"),
                                       "--protocol=pairs",
                                       "--world=hill",
                                       "--sensor=vlp16",
                                       "--pairs=1",
                                       "--min_tilt_deg=17",
                                       "--max_tilt_deg=17",
                                       "--max_yaw_deg=180",
                                       "--ins_std_deg=11"});
  EXPECT_EQ(pairs.exit_code, 0) << pairs.err;
}

TEST_F(SimulateProgramTest, ANameThatIsTooLongLeavesNoFolder) {
  const std::string output =
      "--output=" + PathOf("new/" + std::string(300, 'x'));
  for (const char* protocol : {"sequence", "drive", "pairs"}) {
    ExpectBadInput("quatro_simulate",
                   {output, std::string("--protocol=") + protocol},
                   "xxx",
                   "name too long");
  }
}

}  // namespace
}  // namespace quatro::simulator_test
