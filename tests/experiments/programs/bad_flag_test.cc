// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/programs/bad_flag.h"

#include <gflags/gflags.h>
#include <gtest/gtest.h>

#include <string>

DEFINE_double(test_voxel_size, 0.3, "");
DEFINE_bool(test_explain, false, "");
DEFINE_uint64(test_seed, 0, "");
DEFINE_int32(point_floats, 0, "");
DEFINE_string(method, "", "");
DEFINE_string(source_rpy_deg, "", "");

namespace quatro {
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

}  // namespace
}  // namespace quatro
