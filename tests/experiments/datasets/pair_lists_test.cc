// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "experiments/datasets/csv_table.h"
#include "experiments/datasets/kitti_odometry.h"
#include "experiments/datasets/kitti_pair_list.h"
#include "experiments/datasets/pairs_csv.h"
#include "experiments/simulator/pair_files.h"
#include "features/base/degree.h"
#include "tests/support/run_program.h"

namespace quatro::pair_lists_test {
namespace {

namespace fs = std::filesystem;

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class PairListTest : public ProgramTest {
 protected:
  void Put(const std::string& name, const std::string& text) const {
    fs::create_directories(fs::path(PathOf(name)).parent_path());
    Write(name, text);
  }
  static void ExpectLine(const std::string& error,
                         const std::string& what,
                         const std::string& why) {
    EXPECT_THAT(error, HasSubstr(what));
    EXPECT_THAT(error, HasSubstr(why));
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  }
  void ExpectBadCsv(const std::string& text, const std::string& why) const {
    std::string error;
    EXPECT_FALSE(ReadPairsCsv(Write("pairs.csv", text), &error)) << text;
    ExpectLine(error, PathOf("pairs.csv") + ": ", why);
  }
  void ExpectBadList(const std::string& text, const std::string& why) const {
    KittiPairListOptions options;
    options.list = Write("list.txt", text);
    std::string error;
    EXPECT_FALSE(ReadKittiPairList(options, &error)) << text;
    ExpectLine(error, options.list + ": ", why);
  }
};

TEST_F(PairListTest, CsvWithTruthInsAndNegatives) {
  Put("scans/a.bin", "x");
  Put("pairs.csv",
      "target,source,set,qx,qy,qz,qw,tx,ty,tz,note,source_rpy_deg,"
      "target_rpy_deg,ins_std_deg\n"
      "scans/a.bin,scans/b.bin,one,0,0,0.70710678,0.70710678,1,2,3,\"a, b\","
      "\"1,2,90\",\"0,-3,0\",0.5\n"
      "scans/a.bin,scans/c.bin,two,,,,,,,,,,,\n"
      "scans/b.bin,scans/c.bin,two,,,,,,,,,,,\n");
  std::string error;
  const auto pairs = ReadPairsCsv(PathOf("pairs.csv"), &error);
  ASSERT_TRUE(pairs) << error;
  ASSERT_EQ(pairs->tasks.size(), 3u);
  const PairTask& one = pairs->tasks[0];
  EXPECT_EQ(one.name, "one/000001");
  EXPECT_EQ(one.set, "one");
  EXPECT_EQ(one.bin, "all");
  EXPECT_EQ(one.source, PathOf("scans/b.bin"));
  EXPECT_EQ(one.target, PathOf("scans/a.bin"));
  ASSERT_TRUE(one.true_target_from_source);
  EXPECT_EQ(one.true_target_from_source->translation, Eigen::Vector3d(1, 2, 3));
  EXPECT_NEAR(Yaw(one.true_target_from_source->rotation), M_PI / 2, 1e-9);
  ASSERT_TRUE(one.ins);
  EXPECT_NEAR(one.ins->source.roll, 1.0 * kDegree, 1e-12);
  EXPECT_NEAR(one.ins->source.yaw, M_PI / 2, 1e-12);
  EXPECT_NEAR(one.ins->target.pitch, -3.0 * kDegree, 1e-12);
  EXPECT_NEAR(one.ins->std, 0.5 * kDegree, 1e-12);
  EXPECT_FALSE(pairs->tasks[1].true_target_from_source);
  EXPECT_FALSE(pairs->tasks[1].ins);
  EXPECT_EQ(pairs->num_missing_scans, 2);
  EXPECT_THAT(pairs->notes,
              Contains("2 of 3 scans are missing, the first is " +
                       PathOf("scans/b.bin")));
  for (const PairTask& task : pairs->tasks) EXPECT_TRUE(task.is_truth_known);
}

TEST_F(PairListTest, CsvWithoutPosesHasNoTruth) {
  std::string error;
  Put("other.csv", "source,target\na.bin,b.bin\n");
  const auto unknown = ReadPairsCsv(PathOf("other.csv"), &error);
  ASSERT_TRUE(unknown) << error;
  EXPECT_EQ(unknown->tasks[0].name, "other/000001");
  EXPECT_FALSE(unknown->tasks[0].true_target_from_source);
  EXPECT_FALSE(unknown->tasks[0].is_truth_known);
  Put("apart.csv", "apart,source,target\nother_seed,a,b\n,a,b\n");
  const auto apart = ReadPairsCsv(PathOf("apart.csv"), &error);
  ASSERT_TRUE(apart) << error;
  EXPECT_TRUE(apart->tasks[0].is_truth_known);
  EXPECT_FALSE(apart->tasks[1].is_truth_known);
}

TEST_F(PairListTest, CsvMayBeOfAnyProgram) {
  Put("scans/a.bin", "x");
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    std::string error;
    Put("pairs.csv",
        "\xef\xbb\xbfsource, target " + end + "scans\\a.bin, b.bin" + end +
            " " + end);
    const auto pairs = ReadPairsCsv(PathOf("pairs.csv"), &error);
    ASSERT_TRUE(pairs) << error;
    ASSERT_EQ(pairs->tasks.size(), 1u);
    EXPECT_EQ(pairs->tasks[0].source, PathOf("scans/a.bin"));
    EXPECT_EQ(pairs->tasks[0].target, PathOf("b.bin"));
  }
  ExpectBadCsv("source;target\na;b\n",
               "line 1 has semicolons, must have commas between columns");
  ExpectBadCsv("from,to\na,b\n", "has no column source, but 'from,to'");
}

TEST_F(PairListTest, BadCsvIsNamed) {
  const std::string head = "source,target,tx,ty,tz,qx,qy,qz,qw\n";
  const std::string ins =
      "source,target,source_rpy_deg,target_rpy_deg,ins_std_deg\n";
  ExpectBadCsv("", "is empty, must start with the names");
  ExpectBadCsv("source,target\n", "holds no pair");
  ExpectBadCsv("source,other\na,b\n", "line 1 has no column target");
  ExpectBadCsv("source,target,source\n", "line 1 has a column twice");
  ExpectBadCsv("source,target,tx\na,b,1\n", "line 1 has tx and no ty");
  ExpectBadCsv("source,target,ins_std_deg\na,b,1\n",
               "line 1 has ins_std_deg and no source_rpy_deg");
  ExpectBadCsv(head + "a,b,0,0,0,0,0,0,1\na,b,0,0\n",
               "line 3 has 4 cells, must have 9");
  ExpectBadCsv(head + "a,b,0,nan,0,0,0,0,1\n",
               "line 2: ty is not a finite number");
  ExpectBadCsv(head + "a,b,0,0,0,0,0,0,1\na,b,0,-1e300,0,0,0,0,1\n",
               "line 3: ty is '-1e300' m, must be within +-1e9 m");
  ExpectBadCsv(head + "a,b,0,0,0,0,0,0,\n",
               "line 2: qw is not a finite number");
  ExpectBadCsv(head + "a,b,0,0,0,0,0,0,2\n",
               "line 2: qx,qy,qz,qw is not of length 1");
  ExpectBadCsv(head + ",b,0,0,0,0,0,0,1\n", "line 2: source is empty");
  ExpectBadCsv(head + "a,\"b,0,0,0,0,0,0,1\n",
               "line 2 has a quote that is not closed");
  ExpectBadCsv(ins + "a,b,\"1,2\",\"1,2,3\",0.5\n",
               "line 2: source_rpy_deg is not \"roll,pitch,yaw\"");
  ExpectBadCsv(ins + "a,b,\"1,2,3\",\"1,2,3\",-1\n",
               "line 2: ins_std_deg is not a number >= 0");
  std::string error;
  EXPECT_FALSE(ReadPairsCsv(PathOf("none.csv"), &error));
  ExpectLine(error, PathOf("none.csv"), "No such file");
}

TEST_F(PairListTest, WhatTheSimulatorWritesIsRead) {
  PairSetOptions with, without;
  with.world = without.world = WorldKind::kHall;
  with.num_pairs = without.num_pairs = 1;
  with.max_distance = without.max_distance = 10.0;
  without.no_overlap = true;
  std::string error;
  ASSERT_TRUE(WritePairSets({with, without}, PathOf("set"), 1, nullptr, &error))
      << error;
  const auto pairs = ReadPairsCsv(PathOf("set/pairs.csv"), &error);
  ASSERT_TRUE(pairs) << error;
  const auto truth = SimulateSetPair(with, 0, &error);
  ASSERT_TRUE(truth) << error;
  const PairTask& task = pairs->tasks.at(0);
  EXPECT_LT((task.true_target_from_source->ToMatrix() -
             truth->true_target_from_source->ToMatrix())
                .norm(),
            1e-5);
  ASSERT_TRUE(task.ins);
  EXPECT_NEAR(task.ins->source.pitch, truth->source_ins.pitch, 1e-5);
  EXPECT_NEAR(task.ins->target.yaw, truth->target_ins.yaw, 1e-5);
  EXPECT_NEAR(task.ins->std, with.ins_sigma, 1e-6);
  EXPECT_EQ(pairs->num_missing_scans, 0);
  const auto negative = ReadPairsCsv(PathOf("set/pairs_negative.csv"), &error);
  ASSERT_TRUE(negative) << error;
  EXPECT_FALSE(negative->tasks.at(0).true_target_from_source);
  EXPECT_TRUE(negative->tasks.at(0).is_truth_known);
  EXPECT_TRUE(negative->tasks.at(0).ins);
}

constexpr char kHeader[] = "seq i seq_db j mot1 mot2\n";
constexpr char kRow[] = "0 7 0 300 0 -1 0 5 1 0 0 6 0 0 1 7 0 0 0 1\n";

TEST_F(PairListTest, KittiListNamesItsScans) {
  Put("root/sequences/00/velodyne/000007.bin", "x");
  Put("root/sequences/00/calib.txt", "Tr: 1 0 0 0 0 1 0 0 0 0 1 0\n");
  std::string poses;
  for (int i = 0; i <= 300; ++i) poses += "1 0 0 0 0 1 0 0 0 0 1 0\n";
  Put("root/sequences/00/poses.txt", poses);
  Put("root/poses/00.txt", poses);
  Put("kitti_lc_10_20.txt",
      std::string(kHeader) + kRow +
          "8 15 8 58 1 0 0 25.961651 0 1 0 11.908589 0 0 1 -0.007392 "
          "0 0 0 1\n");
  KittiPairListOptions options;
  options.list = PathOf("kitti_lc_10_20.txt");
  options.folder = PathOf("root");
  std::string error;
  const auto pairs = ReadKittiPairList(options, &error);
  ASSERT_TRUE(pairs) << error;
  ASSERT_EQ(pairs->tasks.size(), 1u);
  const PairTask& task = pairs->tasks[0];
  EXPECT_EQ(task.name, "00/000007-000300");
  EXPECT_EQ(task.set, "00");
  EXPECT_EQ(task.bin, "10-20 m");
  EXPECT_EQ(task.source, PathOf("root/sequences/00/velodyne/000007.bin"));
  EXPECT_EQ(task.target, PathOf("root/sequences/00/velodyne/000300.bin"));
  EXPECT_LT(
      (task.true_target_from_source->translation - Eigen::Vector3d(5, 6, 7))
          .norm(),
      1e-12);
  EXPECT_NEAR(Yaw(task.true_target_from_source->rotation), M_PI / 2, 1e-12);
  EXPECT_TRUE(task.ins);
  EXPECT_EQ(pairs->num_missing_scans, 1);
  EXPECT_THAT(pairs->notes,
              Contains("08/000015-000058: is known to be wrong, left out"));
  options.keeps_known_wrong = true;
  options.has_ins = false;
  const auto all = ReadKittiPairList(options, &error);
  ASSERT_TRUE(all) << error;
  ASSERT_EQ(all->tasks.size(), 2u);
  EXPECT_FALSE(all->tasks[0].ins);
  EXPECT_EQ(all->num_missing_scans, 3);
  EXPECT_THAT(all->notes, Contains(HasSubstr("holds no sequence '08'")));
}

TEST_F(PairListTest, BadKittiListIsNamed) {
  ExpectBadList("", "holds no pair");
  ExpectBadList(kHeader, "holds no pair");
  ExpectBadList(std::string(kHeader) + "0 1 0 2 1 0\n",
                "line 2 has 6 numbers, must have 20");
  ExpectBadList(std::string(kHeader) + kRow +
                    "0 7 0 300 0 -1 0 nan 1 0 0 6 0 0 1 7 0 0 0 1\n",
                "line 3 number 8 is not a finite number");
  ExpectBadList("0 7.5 0 300 0 -1 0 5 1 0 0 6 0 0 1 7 0 0 0 1\n",
                "line 1 number 2 is not an index");
  ExpectBadList("0 7 1 300 0 -1 0 5 1 0 0 6 0 0 1 7 0 0 0 1\n",
                "line 1 is of two sequences");
  ExpectBadList("0 7 0 300 2 0 0 5 0 1 0 6 0 0 1 7 0 0 0 1\n",
                "line 1 is not a rotation");
  ExpectBadList("0 7 0 300 0 -1 0 5 1 0 0 6 0 0 1 7 0 0 0 2\n",
                "line 1 is not a rotation");
  std::string error;
  EXPECT_FALSE(ReadKittiPairList({}, &error));
  EXPECT_THAT(error, HasSubstr("list is empty"));
}

// The median difference of the lists' poses from SemanticKITTI's.
TEST_F(PairListTest, RealListsAgreeWithSemanticKitti) {
  const std::string real = std::string(QUATRO_DATA) + "/";
  if (!fs::exists(real + "kitti_pairs/kitti_10m.txt")) {
    GTEST_SKIP() << "there is no kitti_pairs/kitti_10m.txt in " << QUATRO_DATA;
  }
  std::map<std::string, SequenceData> sequences;
  std::string error;
  const auto sequence = [&](const std::string& name) -> const SequenceData& {
    if (!sequences.contains(name)) {
      fs::create_directories(PathOf(name));
      KittiOdometryOptions options;
      options.folder = PathOf(name);
      options.calibration = real + "kitti_poses/calib/" + name + ".txt";
      options.poses = real + "kitti_poses/semantickitti/" + name + ".txt";
      options.poses_only = true;
      const auto data = ReadKittiOdometry(options, &error);
      EXPECT_TRUE(data) << error;
      sequences[name] = data.value_or(SequenceData());
    }
    return sequences[name];
  };
  struct List {
    const char* name;
    std::size_t num_pairs;
    long num_off;  // Differs by over 1 m or 3 deg.
  };
  for (const List& list : {List{"kitti_lc_0_10", 914, 46},
                           List{"kitti_lc_10_20", 1151, 53},
                           List{"kitti_lc_20_30", 1260, 77},
                           List{"kitti_10m", 556, 1}}) {
    KittiPairListOptions options;
    options.list = real + "kitti_pairs/" + list.name + ".txt";
    options.keeps_known_wrong = true;
    const auto pairs = ReadKittiPairList(options, &error);
    ASSERT_TRUE(pairs) << error;
    ASSERT_EQ(pairs->tasks.size(), list.num_pairs);
    std::vector<double> differences;
    std::set<std::string> names;
    long num_off = 0;
    for (const PairTask& task : pairs->tasks) {
      EXPECT_TRUE(names.insert(task.name).second) << task.name;
      int source = 0, target = 0;
      ASSERT_EQ(std::sscanf(task.name.c_str() + 3, "%d-%d", &source, &target),
                2);
      const auto truth = MakePairTask(sequence(task.set), source, target);
      ASSERT_TRUE(truth) << task.name;
      const Rigid3& a = *task.true_target_from_source;
      const Rigid3& b = *truth->true_target_from_source;
      differences.push_back((a.translation - b.translation).norm());
      num_off += differences.back() > 1.0 ||
                 AngleBetween(a.rotation, b.rotation) > 3.0 * kDegree;
    }
    std::nth_element(differences.begin(),
                     differences.begin() + differences.size() / 2,
                     differences.end());
    const double median = differences[differences.size() / 2];
    RecordProperty(list.name, std::to_string(median));
    EXPECT_GT(median, 0.055) << list.name;
    EXPECT_LT(median, 0.135) << list.name;
    EXPECT_EQ(num_off, list.num_off) << list.name;
    if (std::string(list.name) == "kitti_10m") {
      options.keeps_known_wrong = false;
      EXPECT_EQ(ReadKittiPairList(options, &error)->tasks.size(), 555u);
    }
  }
}

TEST_F(PairListTest, RealPairsCsvIsRead) {
  const std::string path = std::string(QUATRO_DATA) + "/pairs.csv";
  if (!fs::exists(path)) {
    GTEST_SKIP() << "there is no pairs.csv in " << QUATRO_DATA;
  }
  std::string error;
  const auto pairs = ReadPairsCsv(path, &error);
  ASSERT_TRUE(pairs) << error;
  EXPECT_EQ(pairs->tasks.size(), 48u);
  const auto negative =
      ReadPairsCsv(std::string(QUATRO_DATA) + "/pairs_negative.csv", &error);
  ASSERT_TRUE(negative) << error;
  EXPECT_EQ(negative->tasks.size(), 1u);
  EXPECT_FALSE(negative->tasks[0].true_target_from_source);
}

}  // namespace
}  // namespace quatro::pair_lists_test
