// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/programs/bad_flag.h"

#include <gflags/gflags.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "experiments/base/flag_files.h"
#include "tests/support/run_program.h"

DEFINE_double(test_voxel_size, 0.3, "");
DEFINE_bool(test_explain, false, "");
DEFINE_uint64(test_seed, 0, "");
DEFINE_int32(point_floats, 0, "");
DEFINE_int32(pairs, 0, "");
DEFINE_int32(first_frame, 0, "");
DEFINE_string(method, "", "");
DEFINE_string(source_rpy_deg, "", "");
DEFINE_string(options, "", "");
DEFINE_string(input, "", "");

namespace quatro::bad_flag_test {
namespace {

TEST(BadFlag, TheNearestIsNamed) {
  EXPECT_EQ(TellBadFlag({"--test_voxelsize=0.1"}),
            "--test_voxelsize: unknown flag, did you mean --test_voxel_size; "
            "--help lists all");
  EXPECT_EQ(TellBadFlag({"--test_voxel=0.1"}),
            "--test_voxel: unknown flag, did you mean --test_voxel_size; "
            "--help lists all");
  EXPECT_EQ(TellBadFlag({"--the_method=quatro"}),
            "--the_method: unknown flag, did you mean --method; --help lists "
            "all");
  EXPECT_EQ(TellBadFlag({"-nothing_like_it"}),
            "--nothing_like_it: unknown flag; --help lists all");
}

TEST(BadFlag, FlagsOfAnotherProgramAndOptionsAreTold) {
  EXPECT_EQ(TellBadFlag({"--correspondences=a.csv"}),
            "has no flag --correspondences; it is one of quatro_solve's");
  EXPECT_EQ(TellBadFlag({"--refine=icp"}),
            "has no flag --refine; it is one of quatro_register's");
  // As quatro_solve, this has --options and no --source.
  EXPECT_EQ(TellBadFlag({"--pruning=none"}),
            "--pruning: is an option, not a flag; write --options=pruning=...; "
            "--list_options lists all");
  EXPECT_EQ(TellBadFlag({"--tuple_test=off"}),
            "has no flag --tuple_test; it is one of quatro_register's options, "
            "--options=tuple_test=...");
  // Options with a flag of a similar name.
  EXPECT_EQ(TellBadFlag({"--source_rpy=0,0,0"}),
            "--source_rpy: unknown flag, did you mean --source_rpy_deg; "
            "--help lists all");
}

TEST(BadFlag, NearestNamesMissAPartOrAFewLetters) {
  const std::vector<std::string> names = {
      "num_threads", "voxel_size", "max_yaw_deg", "method"};
  EXPECT_EQ(NearestName("threads", names), "num_threads");
  EXPECT_EQ(NearestName("max_yaw", names), "max_yaw_deg");
  EXPECT_EQ(NearestName("my_method", names), "method");
  EXPECT_EQ(NearestName("methods", names), "method");
  EXPECT_EQ(NearestName("voxelsize", names), "voxel_size");
  EXPECT_EQ(NearestName("confidence", names), "");
  EXPECT_EQ(NearestName("size", {"voxel_size"}), "");
}

TEST(NoFlag, AFileWithoutItsFlagAndALongDash) {
  EXPECT_EQ(TellNoFlag("no_such_file"),
            "no_such_file: not a flag, must be --name=value; --help lists all");
  EXPECT_EQ(TellNoFlag("/dev/null"),
            "/dev/null: not a flag, must be --name=value, for example "
            "--input=/dev/null; --help lists all");
  EXPECT_EQ(TellNoFlag("\u2014method=quatro"),
            "\u2014method=quatro: starts with a long dash, must start with --");
}

TEST(BadFlag, KnownOnesPass) {
  EXPECT_EQ(TellBadFlag({"--test_seed=1",
                         "-test_voxel_size",
                         "-0.5",
                         "--notest_explain",
                         "a.bin",
                         "-",
                         "--",
                         "--anything"}),
            std::nullopt);
}

TEST(BadFlag, ABoolTakesNoValueOfItsOwn) {
  EXPECT_NE(TellBadFlag({"--test_explain", "--test_explian"}), std::nullopt);
}

TEST(BadFlag, AValueOfAnotherTypeIsTold) {
  EXPECT_EQ(TellBadFlag({"--test_voxel_size=small"}),
            "--test_voxel_size=small, must be a number");
  EXPECT_EQ(TellBadFlag({"--test_voxel_size", ""}),
            "--test_voxel_size=, must be a number");
  EXPECT_EQ(TellBadFlag({"--test_explain=maybe"}),
            "--test_explain=maybe, must be true or false");
  EXPECT_EQ(TellBadFlag({"--test_seed=-1"}),
            "--test_seed=-1, must be a whole number from 0 to "
            "18446744073709551615");
}

TEST(BadFlag, UndefokIsLeftToGflags) {
  EXPECT_EQ(TellBadFlag({"--undefok=anything", "--anything=1"}), std::nullopt);
}

TEST(BadFlag, AFlagIsGivenOnce) {
  const std::string expected =
      "--test_seed: is given twice, must be given once";
  EXPECT_EQ(TellBadFlag({"--test_seed=1", "--test_seed=1"}), expected);
  EXPECT_EQ(TellBadFlag({"--test_seed", "1", "-test_seed=2"}), expected);
  EXPECT_EQ(TellBadFlag({"--test_explain", "--notest_explain"}),
            "--test_explain: is given twice, must be given once");
  EXPECT_EQ(TellBadFlag({"--test_seed", "1", "--", "--test_seed=2"}),
            std::nullopt);
}

TEST(SpellAsFlags, OptionsAtTheStartAndKnownOnesAnywhere) {
  EXPECT_EQ(SpellAsFlags("test_voxel_size = -1, must be > 0"),
            "--test_voxel_size=-1, must be > 0");
  EXPECT_EQ(SpellAsFlags("other = -1, must be > 0"), "other = -1, must be > 0");
  EXPECT_EQ(SpellAsFlags("a.bin: is it another layout (point_floats)? If so, "
                         "set point_floats=8 or point_floats=4"),
            "a.bin: is it another layout (--point_floats)? If so, set "
            "--point_floats=8 or --point_floats=4");
  EXPECT_EQ(SpellAsFlags("method fgr works on clouds; set source_rpy"),
            "--method=fgr works on clouds; set --source_rpy_deg");
  EXPECT_EQ(SpellAsFlags("--method=fgr: ins_mode needs my_ins_mode"),
            "--method=fgr: ins_mode needs my_ins_mode");  // No such flag here.
  for (const std::string same : {"my_point_floats.bin: is empty",
                                 "point_floats.bin: is empty",
                                 "--point_floats=2, must be 3"}) {
    EXPECT_EQ(SpellAsFlags(same), same);
  }
}

TEST(SpellAsFlags, SeveralOptionsAndNumbersOfThings) {
  EXPECT_EQ(SpellAsFlags("num_pairs = 0, must be in [1, 9]"),
            "--pairs=0, must be in [1, 9]");
  EXPECT_EQ(SpellAsFlags("pairs = 4, must be in [1, test_seed = 3]"),
            "--pairs=4, must be in [1, --test_seed=3]");
  EXPECT_EQ(SpellAsFlags("no frame is left: first_frame = 7 is after the last"),
            "no frame is left: --first_frame=7 is after the last");
  EXPECT_EQ(SpellAsFlags("--options: pairs = 4, must be in [5, 9]"),
            "--options: pairs = 4, must be in [5, 9]");
  EXPECT_EQ(SpellAsFlags("leave it out with first_frame"),
            "leave it out with --first_frame");
  EXPECT_EQ(SpellAsFlags("line 3: 'pairs = 4' is not a number"),
            "line 3: 'pairs = 4' is not a number");
}

using FlagFilesTest = ProgramTest;

TEST_F(FlagFilesTest, LinesTakeThePlaceOfTheFlag) {
  std::string error;
  const std::string inner = Write("inner", "\n# 1\n  --test_seed=2 \r\n");
  const std::string outer =
      Write("outer", "--test_explain\n--flagfile=" + inner + "\n");
  using Flags = std::vector<std::string>;
  EXPECT_EQ(ExpandFlagFiles({"--a=1", "--flagfile=" + outer, "-b"}, &error),
            (Flags{"--a=1", "--test_explain", "--test_seed=2", "-b"}))
      << error;
  EXPECT_EQ(ExpandFlagFiles({"-flagfile", inner + "," + inner}, &error),
            (Flags{"--test_seed=2", "--test_seed=2"}))
      << error;
  EXPECT_EQ(ExpandFlagFiles({"--", "--flagfile=none"}, &error),
            (Flags{"--", "--flagfile=none"}));
}

TEST_F(FlagFilesTest, WhatCannotBeReadIsTold) {
  const auto problem = [](const std::string& flag) {
    std::string error;
    EXPECT_FALSE(ExpandFlagFiles({flag}, &error)) << flag;
    return error;
  };
  const std::string self = PathOf("self");
  Write("self", "--flagfile=" + self + "\n--flagfile=" + self + "\n");
  EXPECT_EQ(problem("--flagfile=" + self),
            "--flagfile: " + self +
                ": more than 100 files to read; a file must not include "
                "itself");
  EXPECT_EQ(problem("--flagfile=/dev/zero"),
            "--flagfile: /dev/zero: is not a regular file");
  const std::string text = Write("text", "\ntest_seed=1\n");
  EXPECT_EQ(problem("--flagfile=" + text),
            "--flagfile: " + text +
                ": line 2: 'test_seed=1' is not a flag, must be --name=value");
  EXPECT_EQ(problem("--flagfile"), "--flagfile is empty, must name a file");
  for (const char* name : {"--fromenv", "--tryfromenv"}) {
    EXPECT_EQ(problem(name + std::string("=test_seed")),
              std::string(name) +
                  " is not supported; write the flags on the command line or "
                  "in a file, --flagfile");
  }
}

}  // namespace
}  // namespace quatro::bad_flag_test
