// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Runs quatro_benchmark as a program. The times themselves are not tested.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "features/io/cloud_io.h"
#include "features/io/point_cloud.h"
#include "tests/support/random_problems.h"
#include "tests/support/run_program.h"

namespace quatro::benchmark_program_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;

class BenchmarkProgramTest : public ProgramTest {
 protected:
  // The benchmarks that match, as written to a file.
  json Run(const std::string& filter, std::vector<std::string> flags) {
    flags.push_back("--benchmark_filter=" + filter);
    flags.push_back("--benchmark_min_time=0.01");
    flags.push_back("--benchmark_out=" + PathOf("run.json"));
    const ProgramRun run = RunProgram("quatro_benchmark", flags);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return json::parse(Read("run.json"));
  }

  // A small scan of a wall and a floor.
  std::string WriteScan(const std::string& name) {
    PointCloud cloud;
    cloud.points.resize(3, 800);
    for (Eigen::Index i = 0; i < 800; ++i) {
      const double u = 0.25 * static_cast<double>(i % 20);
      const double v = 0.25 * static_cast<double>(i % 400 / 20);
      cloud.points.col(i) = i < 400 ? Eigen::Vector3d(u - 2.0, v - 2.0, -1.0)
                                    : Eigen::Vector3d(3.0, u - 2.0, v - 1.0);
    }
    std::string error;
    EXPECT_TRUE(WriteCloud(cloud, PathOf(name), &error)) << error;
    return PathOf(name);
  }
};

TEST_F(BenchmarkProgramTest, MeasuresGraphAgainstItsLimit) {
  const json run =
      Run("^(graph|quatro_95|arc_consensus_99)/.*N:500/", {"--sizes=500"});
  std::set<std::string> names;
  for (const json& entry : run.at("benchmarks")) {
    names.insert(entry.at("name").get<std::string>());
    EXPECT_GT(entry.at("real_time").get<double>(), 0.0);
    EXPECT_EQ(entry.at("time_unit"), "ms");
    if (entry.contains("bitset_bytes")) {
      EXPECT_NEAR(
          entry.at("bitset_bytes").get<double>(), 500.0 * 500.0 / 8.0, 2000.0);
    }
  }
  const std::string end = "/N:500/process_time/real_time";
  EXPECT_THAT(names,
              IsSupersetOf({"graph/quatro" + end,
                            "graph/limit" + end,
                            "quatro_95/quatro" + end}));
  EXPECT_EQ(run.at("context").at("threads"), "1");
  EXPECT_EQ(run.at("context").at("pair"), "simulated");
}

TEST_F(BenchmarkProgramTest, TakesPairFromFiles) {
  const std::string path = WriteScan("a.bin");
  const json run = Run("^(voxels|neighborhoods|fpfh)/(quatro|limit|nanoflann)",
                       {"--source=" + path, "--target=" + path});
  ASSERT_EQ(run.at("benchmarks").size(), 5u);
  EXPECT_EQ(run.at("benchmarks").at(0).at("points"), 1600.0);
  EXPECT_EQ(run.at("context").at("pair"), path + " -> " + path);
}

TEST_F(BenchmarkProgramTest, SimulatesPairThatHasPose) {
  const json run = Run("^(gicp|verdict|register)/quatro(/|$)", {});
  ASSERT_EQ(run.at("benchmarks").size(), 4u);
  for (const json& entry : run.at("benchmarks")) {
    EXPECT_FALSE(entry.contains("error_occurred")) << entry;
    EXPECT_EQ(entry.value("registered", 1.0), 1.0) << entry;
  }
}

TEST_F(BenchmarkProgramTest, SaysWhichStagesNeedPose) {
  const std::string path = WriteScan("a.bin");
  const std::string line = PathOf("line.ply");
  PointCloud cloud;
  cloud.points = Eigen::Matrix3Xd::Zero(3, 100);
  cloud.points.row(0).setLinSpaced(-9.0, 9.0);
  std::string error;
  ASSERT_TRUE(WriteCloud(cloud, line, &error)) << error;
  const json run = Run("^(gicp|solve)/quatro(/|$)",
                       {"--source=" + path, "--target=" + line});
  ASSERT_EQ(run.at("benchmarks").size(), 2u);
  EXPECT_FALSE(run.at("benchmarks").at(0).contains("error_occurred"));
  EXPECT_EQ(run.at("benchmarks").at(1).at("error_message"),
            "the pair has no pose");
}

TEST_F(BenchmarkProgramTest, RefusesBadInput) {
  const std::string path = WriteScan("a.bin");
  const std::string none = Write("none.bin", "");
  const auto expect = [&](const std::vector<std::string>& flags,
                          const std::string& what,
                          const std::string& why) {
    ExpectBadInput("quatro_benchmark", flags, what, why);
  };
  expect({"--sizes=10,x"}, "--sizes=10,x", "whole numbers");
  expect({"--sizes=2"}, "--sizes=2", "from 3");
  expect({"--sizes=1e9"}, "--sizes=1e9", "to 10000000");
  expect({"--preset=boat"}, "--preset=boat", "kitti");
  expect({"--threads=-1"}, "--threads=-1", ">= 0");
  expect({"--source=" + path}, "--target is empty", "name both");
  expect({"--source=" + path, "--target=" + PathOf("b.bin")}, "b.bin", "");
  expect({"--source=" + path, "--target=" + none}, "none.bin", "empty");
  expect({"--frame=1"}, "frame", "");
  expect({"--benchmark_frame=1"}, "--benchmark_frame=1", "not a flag");
  expect({"--benchmark_min_time=x"}, "--benchmark_min_time=x", "a number");
  for (const char* count : {"-1", "0", "1.5", "x", "1e9"}) {
    const std::string flag = std::string("--benchmark_repetitions=") + count;
    expect({"--benchmark_repetitions=1", flag}, flag, "1 to 100000");
  }
  expect({"--benchmark_out_format=x"}, "--benchmark_out_format=x", "json");
  expect({"--benchmark_filter=sky"}, "match", "sky");
  expect({"--benchmark_filter=(sky"}, "regular expression", "");
  expect({"--benchmark_out=" + PathOf("no/run.json")}, "run.json", "");
}

TEST_F(BenchmarkProgramTest, TellsItsFlags) {
  const ProgramRun run = RunProgram("quatro_benchmark", {"--help"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.out, HasSubstr("-sizes"));
  EXPECT_THAT(run.out, HasSubstr("_filter=REGEX"));
}

}  // namespace
}  // namespace quatro::benchmark_program_test
