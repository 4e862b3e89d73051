// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Runs quatro_pose_graph and quatro_fit_line as programs.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <string>

#include "experiments/pose_graphs/g2o.h"
#include "experiments/pose_graphs/pose_graph_protocol.h"
#include "tests/support/run_program.h"

namespace quatro::pose_graph_program_test {
namespace {

using ::testing::HasSubstr;

class PoseGraphProgramTest : public ProgramTest {};

TEST_F(PoseGraphProgramTest, GeneratedWorldIsFoundAndWritten) {
  const ProgramRun run = RunProgram("quatro_pose_graph",
                                    {"--poses=150",
                                     "--loops=60",
                                     "--inlier_probability=0.999999",
                                     "--output=" + PathOf("answer.g2o"),
                                     "--world_output=" + PathOf("world.g2o")});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out,
              HasSubstr("30 outlier loops, 0 of them accepted; 0 inlier"));

  // Solving the world from a file gives the same answer.
  const ProgramRun again = RunProgram("quatro_pose_graph",
                                      {"--input=" + PathOf("world.g2o"),
                                       "--inlier_probability=0.999999",
                                       "--output=" + PathOf("again.g2o")});
  EXPECT_EQ(again.exit_code, 0) << again.err;
  std::string error;
  const auto world = ReadG2o(PathOf("world.g2o"), &error);
  const auto a = ReadG2o(PathOf("answer.g2o"), &error);
  const auto b = ReadG2o(PathOf("again.g2o"), &error);
  ASSERT_TRUE(world && a && b) << error;
  EXPECT_LT(
      LargestDifference(a->world_from_pose, b->world_from_pose).translation,
      1e-7);
  EXPECT_GT(
      LargestDifference(a->world_from_pose, world->world_from_pose).translation,
      0.01);
}

TEST_F(PoseGraphProgramTest, ChainsTheOdometryOfAFile) {
  // Incorrect initial poses; each odometry edge has a length of one meter.
  const std::string path = Write("graph.g2o",
                                 "VERTEX_SE2 0 0 0 0\n"
                                 "VERTEX_SE2 1 500 3 2\n"
                                 "VERTEX_SE2 2 -500 9 1\n"
                                 "EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\n"
                                 "EDGE_SE2 1 2 1 0 0 1 0 0 1 0 1\n"
                                 "EDGE_SE2 0 2 40 0 0 1 0 0 1 0 1\n");
  const ProgramRun run = RunProgram("quatro_pose_graph",
                                    {"--input=" + path,
                                     "--chain_odometry",
                                     "--output=" + PathOf("answer.g2o")});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  std::string error;
  const auto answer = ReadG2o(PathOf("answer.g2o"), &error);
  ASSERT_TRUE(answer.has_value()) << error;
  EXPECT_NEAR(answer->world_from_pose[2].translation.x(), 2.0, 1e-6);
  EXPECT_NEAR(answer->world_from_pose[2].translation.y(), 0.0, 1e-6);
}

TEST_F(PoseGraphProgramTest, GraphInPartsIsNoAnswer) {
  const std::string poses =
      "VERTEX_SE2 5 0 0 0\nVERTEX_SE2 6 1 0 0\n"
      "VERTEX_SE2 7 2 0 0\nVERTEX_SE2 8 3 0 0\n"
      "EDGE_SE2 5 6 1 0 0 1 0 0 1 0 1\n"
      "EDGE_SE2 7 8 1 0 0 1 0 0 1 0 1\n";
  const std::string far = "EDGE_SE2 5 8 90 0 0 1 0 0 1 0 1\n";
  const std::string near = "EDGE_SE2 5 8 3 0 0 1 0 0 1 0 1\n";
  const auto run = [&](const std::string& more, const std::string& flag) {
    return RunProgram("quatro_pose_graph",
                      {"--input=" + Write("graph.g2o", poses + more),
                       "--output=" + PathOf("answer.g2o"),
                       flag});
  };
  for (const char* flag : {"--nochain_odometry", "--chain_odometry"}) {
    const ProgramRun parts = run("", flag);
    EXPECT_EQ(parts.exit_code, 1) << parts.err;
    EXPECT_THAT(parts.out, HasSubstr("has 2 components"));
    EXPECT_THAT(parts.out, HasSubstr("joins pose 7 to pose 5"));
    EXPECT_FALSE(std::filesystem::exists(PathOf("answer.g2o")));
  }
  // GNC rejects both of two loops that contradict each other.
  const ProgramRun rejected = run(near + far, "--loss=gnc");
  EXPECT_EQ(rejected.exit_code, 1) << rejected.out;
  EXPECT_THAT(rejected.out, HasSubstr("has 2 components"));
  EXPECT_EQ(run(near + far, "--loss=none").exit_code, 0);
  // Tukey's loss is flat at the initial poses.
  const ProgramRun flat = run(far, "--loss=tukey");
  EXPECT_EQ(flat.exit_code, 1) << flat.out;
  EXPECT_THAT(flat.out, HasSubstr("has 2 components"));
  // It also rejects the edge between fixed poses, but these do not move.
  for (const std::string& more : {near, far, "FIX 5\nFIX 8\n" + far}) {
    EXPECT_EQ(run(more, "--loss=gnc").exit_code, 0) << more;
  }
}

TEST_F(PoseGraphProgramTest, SecondRunGivesTheSameBytes) {
  for (const char* name : {"a.g2o", "b.g2o"}) {
    RunProgram("quatro_pose_graph",
               {"--world=sphere",
                "--poses=100",
                "--loops=40",
                "--output=" + PathOf(name)});
  }
  EXPECT_EQ(Read("a.g2o"), Read("b.g2o"));
}

TEST_F(PoseGraphProgramTest, FullReportHasTheTrace) {
  const ProgramRun run = RunProgram(
      "quatro_pose_graph", {"--poses=100", "--loops=20", "--full_report"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("sum of weights"));
}

TEST_F(PoseGraphProgramTest, ProtocolWritesATableOfEveryLossAndShare) {
  const ProgramRun run = RunProgram("quatro_pose_graph",
                                    {"--protocol=wrong_loops",
                                     "--poses=100",
                                     "--loops=20",
                                     "--seeds=1",
                                     "--output=" + PathOf("table.csv")});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const std::string csv = Read("table.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 2 * 9 * 5);
  EXPECT_THAT(csv, HasSubstr("manhattan,0.02,0.3,0.1,gnc,1,"));
  EXPECT_THAT(csv, HasSubstr("sphere,0.02,0.3,0.9,none,1,"));
}

TEST_F(PoseGraphProgramTest, BadFlagsAreRefused) {
  const auto expect_refused = [&](const std::string& flag,
                                  const std::string& what) {
    ExpectBadInput("quatro_pose_graph", {flag}, "--", what);
  };
  expect_refused("--loss=l1", "--loss=l1, must be gnc");
  expect_refused("--world=flat", "--world=flat");
  expect_refused("--poses=3", "--poses=3");
  expect_refused("--loops=100000", "pairs of poses");
  expect_refused("--wrong_share=2", "--wrong_share=2");
  expect_refused("--inlier_probability=1", "--inlier_probability");
  expect_refused("--mu_step=1", "--mu_step=1");
  expect_refused("--mu_step=inf", "--mu_step=inf, must be > 1 and finite");
  expect_refused("--gnc_start=here", "--gnc_start=here");
  expect_refused("--loops=2000000000", "--loops=2000000000, must be 0 to");
  for (const char* value : {"0", "1e-300", "1e300", "inf", "nan"}) {
    for (const std::string name : {"sigma_m", "sigma_deg"}) {
      expect_refused("--" + name + "=" + value, "--" + name + "=");
    }
  }
  expect_refused("--protocol=none", "--protocol=none");
  for (const std::string flag : {"--input=", "--world_output="}) {
    ExpectBadInput("quatro_pose_graph",
                   {"--protocol=wrong_loops", flag + PathOf("x.g2o")},
                   "--protocol",
                   "--input");
  }
  for (const char* seeds : {"--seeds=0", "--seeds=2147483647"}) {
    ExpectBadInput("quatro_pose_graph",
                   {"--protocol=wrong_loops", seeds},
                   "--seeds",
                   "1 to 1000000");
  }
}

TEST_F(PoseGraphProgramTest, BadFilesAreRefused) {
  ExpectBadInput("quatro_pose_graph",
                 {"--input=" + PathOf("none.g2o")},
                 "none.g2o",
                 "No such file");
  const std::string path = Write("bad.g2o", "VERTEX_SE2 0 0\n");
  ExpectBadInput("quatro_pose_graph",
                 {"--input=" + path},
                 path + ": line 1",
                 "ends before number 2");
  ExpectBadInput("quatro_pose_graph",
                 {"--input=" + path, "--output=" + path},
                 path,
                 "also an input");
}

TEST_F(PoseGraphProgramTest, FullOutputIsToldAndLeavesFilesAlone) {
  ExpectFullOutputTold("quatro_pose_graph",
                       {"--poses=50",
                        "--loops=10",
                        "--output=" + Write("old.g2o", "old"),
                        "--world_output=" + PathOf("world.g2o")});
}

class FitLineProgramTest : public ProgramTest {};

TEST_F(FitLineProgramTest, FindsTheLineAmongSeventyPercentOutliers) {
  for (const char* seed : {"0", "1", "2", "3", "4"}) {
    const ProgramRun run =
        RunProgram("quatro_fit_line", {std::string("--seed=") + seed});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    double a = 0.0, b = 0.0, plain_a = 0.0, plain_b = 0.0;
    const char* gnc = std::strstr(run.out.c_str(), "GNC ");
    const char* plain = std::strstr(run.out.c_str(), "ceres::Solve ");
    ASSERT_TRUE(gnc != nullptr && plain != nullptr) << run.out;
    ASSERT_EQ(std::sscanf(gnc, "GNC y = %lf x + %lf", &a, &b), 2) << run.out;
    ASSERT_EQ(
        std::sscanf(plain, "ceres::Solve y = %lf x + %lf", &plain_a, &plain_b),
        2);
    EXPECT_NEAR(a, 0.5, 0.02);
    EXPECT_NEAR(b, 1.0, 0.1);
    EXPECT_GT(std::abs(plain_b - 1.0), 1.0);
  }
}

TEST_F(FitLineProgramTest, FullOutputIsTold) {
  ExpectFullOutputTold("quatro_fit_line", {});
  ExpectFullOutputTold("quatro_fit_line", {"--help"});
}

TEST_F(FitLineProgramTest, BadFlagsAreRefused) {
  ExpectBadInput("quatro_fit_line", {"--points=1"}, "--points", "2 to");
  ExpectBadInput("quatro_fit_line", {"--outliers=nan"}, "--outliers", "0 to 1");
}

}  // namespace
}  // namespace quatro::pose_graph_program_test
