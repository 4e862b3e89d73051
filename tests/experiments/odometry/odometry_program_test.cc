// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "experiments/datasets/kitti_poses.h"
#include "tests/support/run_program.h"

namespace quatro::odometry_program_test {
namespace {

using ::testing::HasSubstr;

class OdometryProgramTest : public ProgramTest {
 protected:
  // Six scans, one meter apart.
  std::string SimulateDrive() const {
    const ProgramRun run = RunProgram(
        "quatro_simulate", {"--output=" + PathOf("drive"), "--num_frames=6"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return PathOf("drive");
  }
  void Remove(const std::string& name) const {
    EXPECT_TRUE(std::filesystem::remove(PathOf(name)));
  }
};

TEST_F(OdometryProgramTest, WritesPosesOfCam0NearTheTrueOnes) {
  const std::string drive = SimulateDrive();
  const ProgramRun run = RunProgram("quatro_odometry",
                                    {"--input=" + drive,
                                     "--method=suma",
                                     "--output=" + PathOf("out.txt"),
                                     "--table=" + PathOf("table.csv"),
                                     "--outside=theirs=" + drive + "/poses.txt",
                                     "--quoted"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("6 of 6 scans, 0 s left"));
  EXPECT_THAT(run.out, HasSubstr("6 scans, 0 lost (0 unreadable)"));
  EXPECT_THAT(run.out, HasSubstr("no segment of 100 m"));
  EXPECT_THAT(run.out, HasSubstr("StickyPillars"));
  std::string error;
  const auto poses = ReadKittiPoses(PathOf("out.txt"), &error);
  ASSERT_TRUE(poses) << error;
  const auto truth = ReadKittiPoses(drive + "/poses.txt", &error);
  ASSERT_EQ(poses->size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_LT(((*poses)[i].translation - (*truth)[i].translation).norm(), 0.1)
        << i;
  }
  EXPECT_GT((*poses)[5].translation.z(), 4.5);
  const std::string table = Read("table.csv");
  EXPECT_THAT(table, HasSubstr("suma,measured,-,-,0,"));
  EXPECT_THAT(table, HasSubstr("theirs,file,-,-,-,-"));
  EXPECT_THAT(table, HasSubstr("A-LOAM,quoted,0.70,0.27"));
}

TEST_F(OdometryProgramTest, AMissingAndABadFileAreToldAndCounted) {
  const std::string drive = SimulateDrive();
  Remove("drive/velodyne/000002.bin");
  Write("drive/velodyne/000004.bin", "twelve bytes");
  const ProgramRun run = RunProgram(
      "quatro_odometry",
      {"--input=" + drive, "--method=suma", "--output=" + PathOf("out.txt")});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("6 scans, 2 lost (2 unreadable)"));
  EXPECT_THAT(run.err,
              HasSubstr("frame 2 lost: there is no file of frame 2\n"));
  EXPECT_THAT(run.err, HasSubstr("frame 4 lost: "));
  EXPECT_THAT(run.err, HasSubstr("000004.bin: is text"));
  std::string error;
  const auto poses = ReadKittiPoses(PathOf("out.txt"), &error);
  const auto truth = ReadKittiPoses(drive + "/poses.txt", &error);
  ASSERT_TRUE(poses && truth);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_LT(((*poses)[i].translation - (*truth)[i].translation).norm(), 0.15)
        << i;
  }
}

TEST_F(OdometryProgramTest, IntervalAndFramesPickTheScans) {
  const std::string drive = SimulateDrive();
  const ProgramRun run = RunProgram("quatro_odometry",
                                    {"--input=" + drive,
                                     "--method=aloam",
                                     "--interval=2",
                                     "--first_frame=1",
                                     "--last_frame=4",
                                     "--output=" + PathOf("out.txt")});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("2 scans, 0 lost"));
  EXPECT_THAT(run.out, HasSubstr("path 2.0 m"));
  std::string error;
  const auto poses = ReadKittiPoses(PathOf("out.txt"), &error);
  ASSERT_TRUE(poses) << error;
  ASSERT_EQ(poses->size(), 2u);
  EXPECT_NEAR((*poses)[1].translation.norm(), 2.0, 0.1);
}

TEST_F(OdometryProgramTest, MostlyLostIsNotVouchedFor) {
  for (const char* name : {"0.bin", "1.bin", "2.bin"}) {
    Write(name, std::string(160, '\xc1'));
  }
  const ProgramRun run =
      RunProgram("quatro_odometry", {"--input=" + PathOf(""), "--method=suma"});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.out, HasSubstr("3 scans, 3 lost (0 unreadable)"));
  EXPECT_THAT(run.err, HasSubstr("frame 1 lost: the scan has 10 points"));
}

TEST_F(OdometryProgramTest, EndsWithTheLastFileAndRefusesAStrayOne) {
  for (const char* name : {"0.bin", "1.bin", "2.bin"}) {
    Write(name, std::string(160, '\1'));
  }
  const std::string input = "--input=" + PathOf("");
  const ProgramRun run =
      RunProgram("quatro_odometry", {input, "--last_frame=2147483647"});
  EXPECT_THAT(run.out, HasSubstr("3 scans, "));
  Write("999999999.bin", std::string(160, '\0'));
  for (const char* last : {"--last_frame=-1", "--last_frame=888888888"}) {
    ExpectBadInput("quatro_odometry",
                   {input, last},
                   "999999999.bin: more than 10000 frames before it",
                   "last_frame");
  }
  const ProgramRun without =
      RunProgram("quatro_odometry", {input, "--last_frame=3"});
  EXPECT_THAT(without.out, HasSubstr("4 scans, "));
  EXPECT_THAT(without.err, HasSubstr("there is no file of frame 3"));
}

// Table II from quatro_experiment.
TEST_F(OdometryProgramTest, ATableGoesOnAsWhatItWas) {
  const ProgramRun simulated = RunProgram(
      "quatro_simulate",
      {"--output=" + PathOf("drive"), "--num_frames=12", "--frame_spacing=10"});
  ASSERT_EQ(simulated.exit_code, 0) << simulated.err;
  const auto flags = [this](const std::string& more) {
    return std::vector<std::string>{"--protocol=odometry",
                                    "--data=" + PathOf("drive"),
                                    "--intervals=1",
                                    "--methods=quatro",
                                    "--output=" + PathOf("run"),
                                    more};
  };
  const ProgramRun run = RunProgram("quatro_experiment", flags("--threads=2"));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("quatro  "));
  EXPECT_THAT(Read("run/table_two.csv"), HasSubstr("\nquatro,measured,"));
  EXPECT_THAT(Read("run/table_two.tex"), HasSubstr("toprule"));
  EXPECT_THAT(Read("run/manifest.json"), HasSubstr("\"preset\": \"kitti\""));
  // The table has the time of the run.
  const std::string description = Read("run/odometry/drive_quatro_1.json");
  EXPECT_FALSE(description.empty());

  const ProgramRun more =
      RunProgram("quatro_experiment", flags("--methods=quatro,fgr"));
  ASSERT_EQ(more.exit_code, 0) << more.err;
  EXPECT_EQ(Read("run/odometry/drive_quatro_1.json"), description);
  EXPECT_THAT(Read("run/table_two.csv"), HasSubstr("\nfgr,measured,"));
  ExpectBadInput("quatro_experiment",
                 flags("--preset=paper"),
                 "belongs to another run",
                 "--preset was 'kitti', is 'paper'");
  ExpectBadInput("quatro_experiment",
                 flags("--max_frames=5"),
                 "belongs to another run",
                 "");

  const ProgramRun tilt = RunProgram("quatro_experiment",
                                     {"--protocol=tilt",
                                      "--data=" + PathOf("drive"),
                                      "--bins=0-30",
                                      "--min_frame_gap=1",
                                      "--min_path=5",
                                      "--output=" + PathOf("tilt")});
  ASSERT_EQ(tilt.exit_code, 0) << tilt.err;
  EXPECT_THAT(Read("tilt/manifest.json"), HasSubstr("\"protocol\": \"tilt\""));
  EXPECT_THAT(Read("tilt/tilts.csv"), HasSubstr("\ndrive,"));

  // The folder of another run, and one of other files.
  for (const char* folder : {"run", "drive"}) {
    ExpectBadInput("quatro_experiment",
                   {"--protocol=tilt",
                    "--data=" + PathOf("drive"),
                    "--output=" + PathOf(folder)},
                   PathOf(folder),
                   "a run of --protocol=tilt");
  }
  for (const char* folder : {"tilt", "drive"}) {
    ExpectBadInput("quatro_experiment",
                   flags("--output=" + PathOf(folder)),
                   PathOf(folder),
                   "a run of --protocol=odometry");
  }
}

TEST_F(OdometryProgramTest, BadFlagsAndFilesAreNamed) {
  const std::string program = "quatro_odometry";
  const std::string drive = "--input=" + SimulateDrive();
  ExpectBadInput(program, {}, "--input", "is empty");
  ExpectBadInput(
      program, {"--input=" + PathOf("none")}, "none", "No such file");
  ExpectBadInput(program, {drive, "--method=loam"}, "--method=loam", "suma");
  ExpectBadInput(program, {drive, "--interval=0"}, "--interval=0,", ">= 1");
  ExpectBadInput(program,
                 {drive, "--first_frame=9"},
                 "--first_frame=9",
                 "after the last one, ");
  Write("short.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n");
  ExpectBadInput(program,
                 {drive, "--truth=" + PathOf("short.txt")},
                 "short.txt",
                 "frame 1");
  ExpectBadInput(program, {drive, "--outside=x"}, "--outside", "NAME=POSES");
  ExpectBadInput(
      program, {drive, "--outside=x=" + PathOf("y")}, PathOf("y"), "No such");
  ExpectBadInput(program,
                 {drive, "--truth=" + Write("t.txt", "1 2\n")},
                 "t.txt: line 1",
                 "12");
  ExpectBadInput(program,
                 {drive, "--output=" + PathOf("drive/poses.txt")},
                 "poses.txt",
                 "also an input");
  for (const char* flag : {"--output=", "--table="}) {
    ExpectBadInput(program,
                   {drive, flag + PathOf("drive/velodyne/000002.bin")},
                   "000002.bin",
                   "also an input");
  }
  const std::string theirs = Write("theirs.txt", Read("drive/poses.txt"));
  ExpectBadInput(program,
                 {drive, "--outside=x=" + theirs, "--table=" + theirs},
                 "theirs.txt",
                 "also an input");
  ExpectFullOutputTold(program, {"--list_methods"});
  ExpectBadInput(program,
                 {drive, "--output=" + PathOf("none/x.txt")},
                 "none",
                 "no folder");
  std::filesystem::create_directories(PathOf("empty"));
  ExpectBadInput(program, {"--input=" + PathOf("empty")}, "empty", "holds no");
  std::filesystem::create_directories(PathOf("named"));
  Write("named/first.bin", "");
  ExpectBadInput(
      program, {"--input=" + PathOf("named")}, "first.bin", "number");
  Write("named/first.bin", "");
  std::filesystem::remove(PathOf("named/first.bin"));
  Write("named/1.bin", "");
  Write("named/01.bin", "");
  ExpectBadInput(program, {"--input=" + PathOf("named")}, "named", "frame 1");
}

}  // namespace
}  // namespace quatro::odometry_program_test
