// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/simulator/pair_sets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "experiments/simulator/lidar.h"
#include "experiments/simulator/pair_files.h"
#include "features/base/degree.h"
#include "features/base/file.h"
#include "features/kd_tree.h"

namespace quatro::pair_sets_test {
namespace {

namespace fs = std::filesystem;

using ::testing::HasSubstr;

PairSetOptions SetOf(WorldKind world, bool no_overlap = false) {
  PairSetOptions options;
  options.world = world;
  options.num_pairs = 2;
  options.no_overlap = no_overlap;
  if (world == WorldKind::kHill) options.min_distance = 8.0;
  if (world == WorldKind::kRoom) options.max_distance = 2.0;
  return options;
}

SetPair Simulate(const PairSetOptions& options, int index) {
  std::string error;
  const auto pair = SimulateSetPair(options, index, &error);
  EXPECT_TRUE(pair.has_value()) << error;
  return pair.value_or(SetPair());
}

// Share of the source's points, moved by `pose`, within 0.1 m of a target
// point.
double ShareThatFits(const SetPair& pair, const Rigid3& pose) {
  const KdTree target(pair.target.points);
  int num_points = 0, num_close = 0;
  for (Eigen::Index i = 0; i < pair.source.points.cols(); i += 31) {
    const Eigen::Vector3d point =
        pose * Eigen::Vector3d(pair.source.points.col(i));
    ++num_points;
    num_close += target.Nearest(point, 1)[0].squared_distance < 0.01;
  }
  return static_cast<double>(num_close) / num_points;
}

TEST(SimulateSetPairTest, TruePoseFitsAndOthersDoNot) {
  for (const std::string& name : WorldNames()) {
    PairSetOptions options = SetOf(*WorldByName(name));
    const bool is_small = options.world == WorldKind::kRoom;
    options.min_distance = is_small ? 0.5 : 5.0;
    options.max_distance = is_small ? 1.0 : 10.0;
    options.sensor = "hdl64e";  // Dense enough for 0.1 m.
    const SetPair pair = Simulate(options, 0);
    ASSERT_TRUE(pair.true_target_from_source.has_value());
    const Rigid3& truth = *pair.true_target_from_source;
    const Rigid3 off = {Eigen::Matrix3d::Identity(), {0.3, 0.3, 0.3}};
    const double share = ShareThatFits(pair, truth);
    EXPECT_GT(share, 0.4) << name;
    EXPECT_LT(ShareThatFits(pair, off * truth), 0.5 * share) << name;
  }
}

// Otherwise most pairs would not overlap.
TEST(SimulateSetPairTest, TheYawOfANarrowViewIsAtMostHalfOfIt) {
  double largest = 0.0;
  for (const int index : {0, 1, 2, 3, 4, 5}) {
    const SetPair pair = Simulate(SetOf(WorldKind::kRoom), index);
    EXPECT_EQ(pair.sensor, "depth_camera");
    const double yaw = std::abs(Yaw(pair.true_target_from_source->rotation));
    EXPECT_LT(yaw, 30.0 * kDegree);
    largest = std::max(largest, yaw);
  }
  EXPECT_GT(largest, 10.0 * kDegree);
  PairSetOptions hall = SetOf(WorldKind::kHall);
  hall.max_distance = 2.0;
  hall.sensor = "livox";
  for (const int index : {0, 1, 2, 3}) {
    const SetPair pair = Simulate(hall, index);
    EXPECT_LT(std::abs(Yaw(pair.true_target_from_source->rotation)),
              36.0 * kDegree);
  }
}

TEST(SimulateSetPairTest, TwinFitsAsWell) {
  PairSetOptions options = SetOf(WorldKind::kSymmetric);
  options.min_distance = 4.0;
  options.max_distance = 6.0;
  options.sensor = "hdl64e";
  for (const int index : {0, 1, 2, 3}) {
    const SetPair pair = Simulate(options, index);
    ASSERT_TRUE(pair.twin_target_from_source.has_value());
    const Rigid3& twin = *pair.twin_target_from_source;
    EXPECT_GT(
        (twin.ToMatrix() - pair.true_target_from_source->ToMatrix()).norm(),
        1.0);
    EXPECT_GT(ShareThatFits(pair, twin),
              0.7 * ShareThatFits(pair, *pair.true_target_from_source))
        << pair.variant;
  }
}

TEST(SimulateSetPairTest, InsSeesTheTiltOfTheTruth) {
  PairSetOptions options = SetOf(WorldKind::kHill);
  options.ins_sigma = 0.0;
  const SetPair pair = Simulate(options, 0);
  const Eigen::Matrix3d target_from_source =
      WorldFromBody(pair.target_ins).transpose() *
      WorldFromBody(pair.source_ins);
  EXPECT_LT(
      AngleBetween(target_from_source, pair.true_target_from_source->rotation),
      1e-9);
  options.ins_sigma = 0.02;
  double sum = 0.0;
  constexpr int kNumPairs = 4;
  for (int i = 0; i < kNumPairs; ++i) {
    options.ins_sigma = 0.0;
    const SetPair exact = Simulate(options, i);
    options.ins_sigma = 0.02;
    const SetPair noisy = Simulate(options, i);
    EXPECT_EQ(exact.source.points, noisy.source.points);
    for (const auto& [a, b] : {std::pair(exact.source_ins, noisy.source_ins),
                               std::pair(exact.target_ins, noisy.target_ins)}) {
      sum += std::pow(a.roll - b.roll, 2) + std::pow(a.pitch - b.pitch, 2) +
             std::pow(a.yaw - b.yaw, 2);
    }
  }
  EXPECT_NEAR(std::sqrt(sum / (6 * kNumPairs)), 0.02, 0.008);
}

TEST(SimulateSetPairTest, PairsWithoutOverlapAreOfDifferentPlaces) {
  std::vector<std::string> apart;
  for (const std::string& name : WorldNames()) {
    for (const int index : {0, 1, 2}) {
      const SetPair pair = Simulate(SetOf(*WorldByName(name), true), index);
      EXPECT_FALSE(pair.true_target_from_source.has_value());
      EXPECT_FALSE(pair.twin_target_from_source.has_value());
      EXPECT_GT(pair.source.points.cols(), 10000) << name;
      apart.push_back(pair.apart);
      if (pair.apart == "far_apart") {
        // Beyond each other's range, plus one more range.
        EXPECT_GT((pair.world_from_source.translation -
                   pair.world_from_target.translation)
                      .norm(),
                  2.0 * LidarOptions().max_range)
            << name;
        EXPECT_EQ(pair.seed, pair.target_seed);
      } else if (pair.apart == "other_seed") {
        EXPECT_NE(pair.seed, pair.target_seed);
      } else {
        EXPECT_EQ(pair.apart, "other_floor");
      }
    }
  }
  EXPECT_THAT(apart, ::testing::Contains("other_seed"));
  EXPECT_THAT(apart, ::testing::Contains("far_apart"));
}

TEST(SimulateSetPairTest, EachPairAndEachScanHasItsOwnNoise) {
  PairSetOptions options = SetOf(WorldKind::kHall);
  options.min_distance = options.max_distance = 0.0;
  options.max_yaw = 0.0;
  options.tilt_sigma = 0.0;
  const SetPair pair = Simulate(options, 0);
  ASSERT_EQ(pair.world_from_source.ToMatrix(),
            pair.world_from_target.ToMatrix());
  EXPECT_NE(pair.source.points.cols(), pair.target.points.cols());
  EXPECT_NE(Simulate(options, 1).seed, pair.seed);
}

class WritePairSetsTest : public ::testing::Test {
 protected:
  void SetUp() override { TearDown(); }
  void TearDown() override {
    fs::remove_all(folder_);
    fs::remove_all(other_);
  }

  bool Write(const fs::path& folder, int num_threads) {
    num_made_ = 0;
    return WritePairSets(
        sets_,
        folder.string(),
        num_threads,
        [&](int, int) { ++num_made_; },
        &error_);
  }

  static std::string Bytes(const fs::path& file) {
    std::string error;
    return ReadWholeFile(file.string(), &error).value_or(error);
  }

  static fs::path Folder(const std::string& name) {
    return fs::path(::testing::TempDir()) /
           ("quatro_pair_sets_" + name + "_" +
            ::testing::UnitTest::GetInstance()->current_test_info()->name());
  }

  const fs::path folder_ = Folder("a"), other_ = Folder("b");
  std::vector<PairSetOptions> sets_ = {SetOf(WorldKind::kHall),
                                       SetOf(WorldKind::kHall, true)};
  std::string error_;
  int num_made_ = 0;
};

TEST_F(WritePairSetsTest, ThreadsAndInterruptionsChangeNoByte) {
  ASSERT_TRUE(Write(folder_, 1)) << error_;
  EXPECT_EQ(num_made_, 4);
  sets_[0].num_pairs = 1;
  ASSERT_TRUE(Write(other_, 2)) << error_;
  EXPECT_EQ(num_made_, 3);
  fs::remove(other_ / "rows" / "hall_apart_000001.csv");
  sets_[0].num_pairs = 2;
  ASSERT_TRUE(Write(other_, 2)) << error_;
  EXPECT_EQ(num_made_, 2);
  for (const char* file : {"pairs.csv",
                           "pairs_negative.csv",
                           "hall/000001_source.bin",
                           "hall/000001_target.bin",
                           "hall_apart/000001_source.bin"}) {
    EXPECT_GT(Bytes(folder_ / file).size(), 100u) << file;
    EXPECT_TRUE(Bytes(folder_ / file) == Bytes(other_ / file)) << file;
  }
  ASSERT_TRUE(Write(other_, 2)) << error_;
  EXPECT_EQ(num_made_, 0);
}

TEST_F(WritePairSetsTest, ListsHaveALineAPairAndACellAColumn) {
  ASSERT_TRUE(Write(folder_, 2)) << error_;
  for (const char* file : {"pairs.csv", "pairs_negative.csv"}) {
    std::istringstream lines(Bytes(folder_ / file));
    std::vector<long> num_commas;
    for (std::string line; std::getline(lines, line);) {
      bool quoted = false;
      num_commas.push_back(std::count_if(line.begin(), line.end(), [&](char c) {
        if (c == '"') quoted = !quoted;
        return c == ',' && !quoted;
      }));
    }
    ASSERT_EQ(num_commas.size(), 3u);
    EXPECT_EQ(num_commas[1], num_commas[0]) << file;
    EXPECT_EQ(num_commas[2], num_commas[0]) << file;
  }
  EXPECT_THAT(Bytes(folder_ / "pairs.csv"), HasSubstr("tx,ty,tz,qx,qy,qz,qw"));
  EXPECT_THAT(Bytes(folder_ / "pairs_negative.csv"),
              ::testing::Not(HasSubstr(",qw,")));
}

TEST_F(WritePairSetsTest, OtherOptionsAndOtherFoldersAreRefused) {
  sets_.pop_back();
  sets_[0].num_pairs = 1;
  ASSERT_TRUE(Write(folder_, 1)) << error_;
  sets_[0].seed = 2;
  EXPECT_FALSE(Write(folder_, 1));
  EXPECT_THAT(error_, HasSubstr("contains pairs with other options"));
  fs::create_directories(other_);
  std::ofstream(other_ / "thesis.tex") << "text";
  EXPECT_FALSE(Write(other_, 1));
  EXPECT_THAT(error_, HasSubstr("not a folder of pairs"));
  sets_.push_back(sets_[0]);
  EXPECT_FALSE(Write(folder_, 1));
  EXPECT_THAT(error_, HasSubstr("two sets have the name hall"));
}

TEST(PairSetOptionsTest, InvalidOptionsAreNamed) {
  std::string error;
  PairSetOptions options;
  options.min_distance = 31.0;
  EXPECT_FALSE(options.IsValid(&error));
  EXPECT_THAT(error, HasSubstr("min_distance = 31, must be in [0, max_"));
  options = {};
  options.world = WorldKind::kRoom;
  EXPECT_FALSE(options.IsValid(&error));
  EXPECT_EQ(error, "max_distance = 30 in a room, must be <= 3");
  options = {};
  options.sensor = "radar";
  EXPECT_FALSE(options.IsValid(&error));
  EXPECT_THAT(error, HasSubstr("sensor = 'radar', must be one of hdl64e"));
  options = {};
  options.num_pairs = 0;
  EXPECT_FALSE(options.IsValid(&error));
  EXPECT_THAT(error, HasSubstr("num_pairs = 0, must be"));
  options = {};
  options.max_tilt = 1.0;
  EXPECT_FALSE(options.IsValid(&error));
  EXPECT_THAT(error, HasSubstr("tilt = 1, must be"));
}

TEST(CalibrationSetsTest, HalfHaveNoOverlap) {
  int with = 0, without = 0;
  for (const PairSetOptions& set : CalibrationSets(1, 1.0)) {
    std::string error;
    EXPECT_TRUE(set.IsValid(&error)) << error;
    (set.no_overlap ? without : with) += set.num_pairs;
  }
  EXPECT_EQ(with, 750);
  EXPECT_EQ(without, 750);
}

}  // namespace
}  // namespace quatro::pair_sets_test
