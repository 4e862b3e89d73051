// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Runs quatro_solve as a program.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "experiments/programs/json_report.h"
#include "experiments/programs/matches_csv.h"
#include "experiments/programs/picture.h"
#include "features/base/random.h"
#include "features/base/rigid3.h"
#include "features/base/types.h"
#include "tests/support/matchers.h"
#include "tests/support/random_problems.h"
#include "tests/support/run_program.h"

namespace quatro::solve_program_test {
namespace {

using nlohmann::json;
using ::testing::AnyOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

constexpr double kNoiseBound = 0.3;  // [m], of preset kitti.

struct Problem {
  MatchedPoints matches;
  Rigid3 target_from_source;
};

// A quarter of the matches are inliers with 3 sigma = noise_bound / 2; the rest
// have random targets.
Problem MakeProblem(Eigen::Index num_matches, std::uint64_t seed) {
  Problem problem;
  problem.target_from_source = {RotationZ(2.1), {8.0, -5.0, 0.4}};
  Points& source = problem.matches.source;
  Points& target = problem.matches.target;
  source = RandomPoints(num_matches, 20.0, seed);
  target = problem.target_from_source.Apply(source) +
           RandomPoints(num_matches, kNoiseBound / 6.0, seed + 1);
  const Eigen::Index num_wrong = num_matches - num_matches / 4;
  target.rightCols(num_wrong) = RandomPoints(num_wrong, 20.0, seed + 2);
  return problem;
}

Rigid3 PoseOf(const json& report) {
  Eigen::Matrix4d matrix;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      matrix(row, column) = report.at("target_from_source")
                                .at(static_cast<std::size_t>(row))
                                .at(static_cast<std::size_t>(column))
                                .get<double>();
    }
  }
  return {matrix.topLeftCorner<3, 3>(), matrix.topRightCorner<3, 1>()};
}

class SolveProgramTest : public ProgramTest {
 protected:
  std::string WriteMatches(const std::string& name,
                           const MatchedPoints& matches) const {
    return Write(name, FormatMatches(matches.source, matches.target));
  }

  static ProgramRun Solve(const std::string& path,
                          std::vector<std::string> flags = {}) {
    flags.push_back("--correspondences=" + path);
    return RunProgram("quatro_solve", flags);
  }

  // Runs the program and checks that its exit code agrees with its status.
  static json ReportOf(const ProgramRun& run) {
    const json report = json::parse(run.out, nullptr, false);
    EXPECT_TRUE(report.is_object()) << run.out << run.err;
    if (!report.is_object()) return json::object();
    EXPECT_EQ(run.exit_code, report["status"] == "registered" ? 0 : 1);
    EXPECT_EQ(
        report["target_from_source"].is_null(),
        report["status"] == "insufficient" || report["status"] == "degenerate");
    return report;
  }

  json Report(const MatchedPoints& matches) const {
    return ReportOf(Solve(WriteMatches("a.csv", matches)));
  }

  void ExpectRefused(const std::string& text, const std::string& why) const {
    const std::string path = Write("a.csv", text);
    ExpectBadInput(
        "quatro_solve", {"--correspondences=" + path}, path + ": ", why);
  }

  // An invalid flag, with everything else valid.
  void ExpectRefusedFlag(const std::string& flag,
                         const std::string& what,
                         const std::string& why) const {
    const std::string path = WriteMatches("a.csv", MakeProblem(20, 1).matches);
    ExpectBadInput(
        "quatro_solve", {"--correspondences=" + path, flag}, what, why);
  }
};

// Bad input

TEST_F(SolveProgramTest, NoFile) {
  ExpectBadInput("quatro_solve", {}, "--correspondences", "is empty");
}

TEST_F(SolveProgramTest, MissingFile) {
  const std::string path = PathOf("none.csv");
  ExpectBadInput("quatro_solve",
                 {"--correspondences=" + path},
                 path,
                 "No such file or directory");
}

TEST_F(SolveProgramTest, ANameWithALineBreakIsToldInOneLine) {
  ExpectBadInput("quatro_solve",
                 {"--correspondences=" + PathOf("a\nb\x1b[2J.csv")},
                 "a?b?[2J.csv",
                 "No such file or directory");
}

TEST_F(SolveProgramTest, Folder) {
  std::filesystem::create_directory(PathOf("a.csv"));
  ExpectBadInput("quatro_solve",
                 {"--correspondences=" + PathOf("a.csv")},
                 PathOf("a.csv"),
                 "is a directory");
}

TEST_F(SolveProgramTest, EmptyFile) { ExpectRefused("", "is empty"); }

TEST_F(SolveProgramTest, FiveColumns) {
  ExpectRefused("1,2,3,4,5\n", "line 1 has 5 columns, must have 6");
}

TEST_F(SolveProgramTest, SevenColumns) {
  ExpectRefused("1,2,3,4,5,6\n1,2,3,4,5,6,7\n",
                "line 2 has 7 columns, must have 6");
}

TEST_F(SolveProgramTest, Text) {
  ExpectRefused("1,2,3,4,5,six\n", "column tz: 'six' is not a number");
}

TEST_F(SolveProgramTest, Nan) {
  ExpectRefused("nan,2,3,4,5,6\n", "column sx: 'nan' is not finite");
}

TEST_F(SolveProgramTest, Infinity) {
  ExpectRefused("1,2,3,4,-inf,6\n", "column ty: '-inf' is not finite");
}

TEST_F(SolveProgramTest, UnknownFlag) {
  ExpectRefusedFlag("--colour=red", "colour", "unknown");
}

TEST_F(SolveProgramTest, TextForANumber) {
  ExpectRefusedFlag("--noise_bound=much", "noise_bound", "much");
}

TEST_F(SolveProgramTest, FractionForAWholeNumber) {
  ExpectRefusedFlag("--threads=1.5", "threads", "1.5");
}

TEST_F(SolveProgramTest, NegativeThreads) {
  ExpectRefusedFlag("--threads=-1", "--threads=-1", "must be >= 0");
}

TEST_F(SolveProgramTest, NegativeNoiseBound) {
  ExpectRefusedFlag("--noise_bound=-1", "--noise_bound=-1", "must be > 0");
}

TEST_F(SolveProgramTest, NanNoiseBound) {
  ExpectRefusedFlag("--noise_bound=nan", "--noise_bound=nan", "must be > 0");
}

TEST_F(SolveProgramTest, UnknownPreset) {
  ExpectRefusedFlag("--preset=moon",
                    "--preset=moon, must be one of kitti, paper, ",
                    "indoor\n");
}

TEST_F(SolveProgramTest, UnknownMethod) {
  ExpectRefusedFlag("--method=magic", "--method=magic", "must be");
}

TEST_F(SolveProgramTest, SwitchThatIsNeitherOnNorOff) {
  ExpectRefusedFlag("--polish=maybe", "--polish=maybe", "must be on or off");
}

TEST_F(SolveProgramTest, JsonOntoTheInput) {
  const std::string path = WriteMatches("a.csv", MakeProblem(20, 1).matches);
  ExpectBadInput("quatro_solve",
                 {"--correspondences=" + path, "--json=" + path},
                 path,
                 "is also an input");
}

TEST_F(SolveProgramTest, StrayArgument) {
  ExpectRefusedFlag("stray", "stray", "not a flag");
}

TEST_F(SolveProgramTest, MissingOutputFolder) {
  ExpectRefusedFlag("--json=" + PathOf("none/a.json"),
                    PathOf("none/a.json"),
                    "there is no folder");
}

TEST_F(SolveProgramTest, JsonOntoAFolder) {
  ExpectRefusedFlag("--json=" + PathOf(""), PathOf(""), "is a directory");
}

TEST_F(SolveProgramTest, ADeviceTakesTheJson) {
  const std::string path = WriteMatches("a.csv", MakeProblem(100, 10).matches);
  const ProgramRun run = Solve(path, {"--json=/dev/null"});
  EXPECT_LE(run.exit_code, 1) << run.err;
  EXPECT_EQ(run.out, "");
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  const ProgramRun full = Solve(path, {"--json=/dev/full"});
  EXPECT_EQ(full.exit_code, 2);
  EXPECT_THAT(full.err, HasSubstr("/dev/full: could not be written"));
}

// Names of the flags that a program defines, except those of quatro_solve.
std::vector<std::string> FlagsThatSolveLacks(const std::string& program) {
  const auto flags_of = [](const std::string& name) {
    std::istringstream lines(RunProgram(name, {"--help"}).out);
    std::set<std::string> flags;
    for (std::string line; std::getline(lines, line);) {
      if (!line.starts_with("    -")) continue;
      flags.insert(line.substr(5, line.find(' ', 5) - 5));
    }
    return flags;
  };
  const std::set<std::string> all = flags_of(program);
  const std::set<std::string> own = flags_of("quatro_solve");
  std::vector<std::string> missing;
  std::ranges::set_difference(all, own, std::back_inserter(missing));
  return missing;
}

TEST_F(SolveProgramTest, EachFlagOfRegisterAloneIsToldAsSuch) {
  const std::vector<std::string> flags = FlagsThatSolveLacks("quatro_register");
  EXPECT_GE(flags.size(), 10u);
  for (const std::string& flag : flags) {
    ExpectRefusedFlag("--" + flag + "=1",
                      "quatro_solve: has no flag --" + flag + ";",
                      "it is one of quatro_register's\n");
  }
}

TEST_F(SolveProgramTest, OptionsAreNoFlags) {
  ExpectRefusedFlag("--pruning=none", "--pruning", "--options=pruning=...");
  ExpectRefusedFlag("--tuple_test=off", "has no flag", "quatro_register's");
}

TEST_F(SolveProgramTest, OptionsThatAreMisspelledOrGivenTwice) {
  ExpectRefusedFlag("--options=gnc_mu_steps=2",
                    "no option gnc_mu_steps",
                    "did you mean gnc_mu_step; --list_options lists all");
  ExpectRefusedFlag(
      "--options=mystery=2", "no option mystery;", "--list_options lists all");
  ExpectRefusedFlag("--options=noise_bound=0.3,seed=1",
                    "noise_bound = 0.3,seed=1",
                    "options are separated by semicolons");
  const std::string path = WriteMatches("a.csv", MakeProblem(20, 1).matches);
  ExpectBadInput("quatro_solve",
                 {"--correspondences=" + path,
                  "--recover=on",
                  "--options=recover_translation=off"},
                 "recover_translation",
                 "is given twice");
}

TEST_F(SolveProgramTest, OptionsMayHaveBlanks) {
  const std::string path = WriteMatches("a.csv", MakeProblem(100, 10).matches);
  const json report =
      ReportOf(Solve(path, {"--options= pruning = none ; gnc_mu_step=1.5; "}));
  EXPECT_EQ(report["parameters"]["pruning"], "none");
  EXPECT_EQ(report["parameters"]["gnc_mu_step"], 1.5);
}

TEST_F(SolveProgramTest, ListsOptionsAndTheirFlagsApart) {
  const std::string list = RunProgram("quatro_solve", {"--list_options"}).out;
  const std::size_t flags = list.find("\nFlags that set one of these options");
  ASSERT_NE(flags, std::string::npos) << list;
  EXPECT_THAT(list, StartsWith("Options, for --options="));
  const std::string options = list.substr(0, flags);
  for (const char* name : {"\n  pruning ", "\n  num_threads ", "\n  seed "}) {
    EXPECT_THAT(options, HasSubstr(name));
  }
  EXPECT_THAT(options, Not(HasSubstr("\n  --")));
  for (const char* name :
       {"\n  --seed ", "\n  --threads (num_threads) ", "\n  --recover "}) {
    EXPECT_THAT(list.substr(flags), HasSubstr(name));
  }
  EXPECT_THAT(list.substr(flags), Not(HasSubstr("pruning")));
}

TEST_F(SolveProgramTest, ListsTheMethodsThatItTakes) {
  const std::string list = RunProgram("quatro_solve", {"--list_methods"}).out;
  EXPECT_THAT(list, HasSubstr("teaser "));
  for (const char* other : {"aloam", "suma", "gicp", "quatro_c2f"}) {
    EXPECT_THAT(list, Not(HasSubstr(other)));
  }
}

TEST_F(SolveProgramTest, CloudsAreNoMatches) {
  const std::string path = Write("a.pcd", "# .PCD v0.7\n");
  ExpectBadInput("quatro_solve",
                 {"--correspondences=" + path},
                 path + ": is a cloud by its ending",
                 "quatro_register registers clouds");
}

TEST_F(SolveProgramTest, MatchesGiveNoVertical) {
  ExpectRefusedFlag(
      "--gravity=scans", "--gravity=scans has no effect", "two clouds");
  ExpectRefusedFlag(
      "--options=gravity=scans", "--gravity=scans has no effect", "two clouds");
}

TEST_F(SolveProgramTest, PictureIntoAMissingFolder) {
  ExpectRefusedFlag("--picture=" + PathOf("none/a.png"),
                    PathOf("none/a.png"),
                    "there is no folder");
}

TEST_F(SolveProgramTest, FullOutputIsToldAndLeavesFilesAlone) {
  const std::string path = WriteMatches("a.csv", MakeProblem(20, 1).matches);
  ExpectFullOutputTold("quatro_solve", {"--correspondences=" + path});
  ExpectFullOutputTold("quatro_solve", {"--list_methods"});
  ExpectFullOutputTold("quatro_solve",
                       {"--correspondences=" + path,
                        "--json=" + Write("old.json", "old"),
                        "--explain"});
}

// Too little data

TEST_F(SolveProgramTest, NoMatchesAreInsufficient) {
  const json report = Report({Points(3, 0), Points(3, 0)});
  EXPECT_EQ(report["status"], "insufficient");
  EXPECT_EQ(report["counts"]["matches"], 0);
}

TEST_F(SolveProgramTest, OneMatchIsInsufficient) {
  EXPECT_EQ(Report({Points::Ones(3, 1), Points::Zero(3, 1)})["status"],
            "insufficient");
}

TEST_F(SolveProgramTest, CopiesOfOneMatchAreInsufficient) {
  EXPECT_EQ(Report({Points::Ones(3, 50), Points::Zero(3, 50)})["status"],
            "insufficient");
}

TEST_F(SolveProgramTest, MatchesAboveOneAnotherAreDegenerate) {
  Points source = Points::Ones(3, 30);
  source.row(2).setLinSpaced(0.0, 29.0);
  EXPECT_EQ(Report({source, source})["status"], "degenerate");
}

TEST_F(SolveProgramTest, TwoMatchesHoldAYaw) {
  const Rigid3 motion = {RotationZ(2.0), {1.0, 2.0, 3.0}};
  Points source(3, 2);
  source << 0, 10, 0, 0, 0, 1;
  const json report = Report({source, motion.Apply(source)});
  EXPECT_THAT(report["status"], AnyOf("registered", "ambiguous"));
  EXPECT_THAT(report["yaw_deg"].get<double>() * M_PI / 180.0,
              IsAngleNear(2.0, 1e-12));
}

TEST_F(SolveProgramTest, WrongMatchesAloneAreNotRegistered) {
  const json report =
      Report({RandomPoints(300, 20.0, 5), RandomPoints(300, 20.0, 6)});
  EXPECT_NE(report["status"], "registered");
}

// Good problems

TEST_F(SolveProgramTest, RegistersAmongThreeQuartersOfWrongMatches) {
  const Problem problem = MakeProblem(400, 7);
  const json report = Report(problem.matches);
  EXPECT_EQ(report["status"], "registered") << report["reason"];
  const Rigid3 pose = PoseOf(report);
  EXPECT_LT(AngleBetween(pose.rotation, problem.target_from_source.rotation),
            0.3 * M_PI / 180.0);
  EXPECT_LT((pose.translation - problem.target_from_source.translation).norm(),
            0.1);
  EXPECT_GE(report["counts"]["translation_inliers"].get<int>(), 90);
}

TEST_F(SolveProgramTest, PolishOffKeepsAllButTheHeadingAtZero) {
  const std::string path = WriteMatches("a.csv", MakeProblem(200, 3).matches);
  const json off = ReportOf(Solve(path, {"--polish=off"}));
  EXPECT_TRUE(off["unpolished_target_from_source"].is_null());
  EXPECT_EQ(PoseOf(off).rotation(2, 2), 1.0);
  const json on = ReportOf(Solve(path, {"--polish=on"}));
  EXPECT_FALSE(on["unpolished_target_from_source"].is_null());
  EXPECT_NE(PoseOf(on).rotation(2, 2), 1.0);
}

TEST_F(SolveProgramTest, VersionIsOneLine) {
  const ProgramRun run = RunProgram("quatro_solve", {"--version"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.out, "quatro_solve " + Version() + "\n");
}

TEST_F(SolveProgramTest, CrosscheckReportsHowFarCeresIs) {
  const std::string path = WriteMatches("a.csv", MakeProblem(200, 4).matches);
  const json report = ReportOf(Solve(path, {"--crosscheck"}))["crosscheck"];
  EXPECT_GT(report["subproblems"], 0);
  EXPECT_LT(report["max_rotation_difference_rad"], 1e-8);
  EXPECT_LT(report["max_translation_difference_m"], 1e-8);
}

TEST_F(SolveProgramTest, RegistersFarFromTheOrigin) {
  Problem problem = MakeProblem(400, 8);
  const Eigen::Vector3d offset(1e7, -1e7, 1e3);
  problem.matches.source.colwise() += offset;
  problem.matches.target.colwise() += offset;
  const json report = Report(problem.matches);
  EXPECT_EQ(report["status"], "registered") << report["reason"];
  // Measured at the points: at the origin, an error of 1e-3 rad would be 10 km.
  const Rigid3 pose = PoseOf(report);
  const Points moved = pose.Apply(problem.matches.source.leftCols(100));
  EXPECT_LT((moved - problem.matches.target.leftCols(100))
                .colwise()
                .norm()
                .maxCoeff(),
            kNoiseBound * std::sqrt(3.0));
}

TEST_F(SolveProgramTest, ReportHasAllFields) {
  const std::string path = WriteMatches("a.csv", MakeProblem(400, 9).matches);
  const json report = ReportOf(Solve(path, {"--method=quatro"}));
  for (const char* name : {"status", "reason", "method", "version"}) {
    EXPECT_TRUE(report[name].is_string()) << name;
  }
  ASSERT_EQ(report["target_from_source"].size(), 4u);
  for (const json& row : report["target_from_source"]) {
    ASSERT_EQ(row.size(), 4u);
    for (const json& number : row) EXPECT_TRUE(number.is_number_float());
  }
  EXPECT_EQ(report["target_from_source"][3], json({0.0, 0.0, 0.0, 1.0}));
  EXPECT_TRUE(report["yaw_deg"].is_number_float());
  for (const char* name :
       {"matches", "consistent", "rotation_inliers", "translation_inliers"}) {
    EXPECT_TRUE(report["counts"][name].is_number_integer()) << name;
  }
  ASSERT_TRUE(report.contains("covariance"));
  if (!report["covariance"].is_null()) {
    ASSERT_EQ(report["covariance"].size(), 6u);
    for (const json& row : report["covariance"]) EXPECT_EQ(row.size(), 6u);
  }
  ASSERT_TRUE(report.contains("certificate"));
  if (!report["certificate"].is_null()) {
    for (const char* name : {"gnc_cost", "optimal_cost", "gap"}) {
      EXPECT_TRUE(report["certificate"][name].is_number()) << name;
    }
  }
  double sum = 0.0;
  for (const auto& [stage, time] : report["timings_ms"].items()) {
    ASSERT_TRUE(time.is_number()) << stage;
    EXPECT_GE(time.get<double>(), 0.0) << stage;
    if (stage != "total") sum += time.get<double>();
  }
  EXPECT_GE(report["timings_ms"]["total"].get<double>(), sum - 0.01);
  EXPECT_EQ(report["method"], "quatro");
  EXPECT_EQ(report["parameters"]["noise_bound"], kNoiseBound);
}

TEST_F(SolveProgramTest, JsonGoesToAFileInstead) {
  const std::string path = WriteMatches("a.csv", MakeProblem(100, 10).matches);
  const ProgramRun to_stdout = Solve(path);
  const ProgramRun to_file = Solve(path, {"--json=" + PathOf("a.json")});
  EXPECT_EQ(to_file.exit_code, to_stdout.exit_code);
  EXPECT_EQ(to_file.out, "");
  EXPECT_EQ(WithoutTimings(Read("a.json")), WithoutTimings(to_stdout.out));
  EXPECT_EQ(Contents().size(), 2u);
}

TEST_F(SolveProgramTest, ADashIsStandardInputAndOutput) {
  const std::string path = WriteMatches("a.csv", MakeProblem(100, 10).matches);
  const ProgramRun run = RunProgram("quatro_solve",
                                    {"--correspondences=-", "--json=-"},
                                    /*out_path=*/nullptr,
                                    path.c_str());
  json report = ReportOf(run);
  EXPECT_EQ(report["parameters"]["correspondences"], "-");
  report["parameters"]["correspondences"] = path;
  json from_file = ReportOf(Solve(path));
  report.erase("timings_ms");
  from_file.erase("timings_ms");
  EXPECT_EQ(report, from_file);
  EXPECT_EQ(Contents().size(), 1u);
}

TEST_F(SolveProgramTest, StandardInputIsNamedInErrors) {
  const std::string path = Write("a.csv", "1,2,3\n");
  const ProgramRun run = RunProgram(
      "quatro_solve", {"--correspondences=-"}, nullptr, path.c_str());
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err, HasSubstr("standard input: line 1 has 3 columns"));
}

TEST_F(SolveProgramTest, TwoOutputsOnStandardOutputAreRefused) {
  ExpectRefusedFlag("--picture=-", "--json and --picture", "name a file");
}

TEST_F(SolveProgramTest, BoundsAroundThePoseKeepIt) {
  const Problem problem = MakeProblem(200, 3);
  const std::string path = WriteMatches("a.csv", problem.matches);
  const json report = ReportOf(Solve(
      path, {"--guess=7,-4,0,110", "--max_translation=3", "--max_yaw_deg=20"}));
  EXPECT_LT((PoseOf(report).ToMatrix() - problem.target_from_source.ToMatrix())
                .norm(),
            0.2);
  EXPECT_EQ(report["parameters"]["guess"][0][3], 7.0);
  EXPECT_EQ(report["parameters"]["max_translation"], 3.0);
  EXPECT_EQ(report["parameters"]["max_yaw_deg"], 20.0);
}

TEST_F(SolveProgramTest, BoundsFarFromThePoseLeaveNoAnswer) {
  const std::string path = WriteMatches("a.csv", MakeProblem(200, 3).matches);
  const json report =
      ReportOf(Solve(path, {"--max_translation=2", "--max_yaw_deg=20"}));
  EXPECT_EQ(report["status"], "insufficient");
  EXPECT_THAT(
      report["reason"].get<std::string>(),
      AnyOf(HasSubstr("the bounds leave"), HasSubstr("outside of the bounds")));
}

TEST_F(SolveProgramTest, AGuessWithoutBoundsIsRefused) {
  ExpectRefusedFlag("--guess=1,2,3,4", "--guess", "--max_translation");
}

TEST_F(SolveProgramTest, FlagsComeFromAFileToo) {
  const std::string path = WriteMatches("a.csv", MakeProblem(100, 11).matches);
  const std::string flags =
      Write("flags", "--correspondences=" + path + "\n--noise_bound=0.25\n");
  const ProgramRun run = RunProgram("quatro_solve", {"--flagfile=" + flags});
  EXPECT_EQ(ReportOf(run)["parameters"]["noise_bound"], 0.25);
  EXPECT_EQ(WithoutTimings(run.out),
            WithoutTimings(Solve(path, {"--noise_bound=0.25"}).out));
}

TEST_F(SolveProgramTest, FlagsInAFileAreChecked) {
  const std::string path = WriteMatches("a.csv", MakeProblem(20, 1).matches);
  ExpectBadInput("quatro_solve",
                 {"--correspondences=" + path,
                  "--flagfile=" + Write("flags", "--noise_bond=0.25\n")},
                 "--noise_bond",
                 "did you mean --noise_bound");
  ExpectBadInput("quatro_solve",
                 {"--correspondences=" + path,
                  "--noise_bound=0.2",
                  "--flagfile=" + Write("flags", "--noise_bound=0.25\n")},
                 "--noise_bound",
                 "is given twice");
}

// The answer of the shell command, with QUATRO_SOLVE in place of the program.
int ExitCodeInShell(std::string command) {
  const std::string name = "QUATRO_SOLVE";
  command.replace(command.find(name),
                  name.size(),
                  std::string(QUATRO_BIN_DIR) + "/quatro_solve");
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST_F(SolveProgramTest, AFileSizeLimitIsAnErrorAndLeavesNothing) {
  const std::string path = WriteMatches("a.csv", MakeProblem(100, 10).matches);
  const auto before = Contents();
  EXPECT_EQ(
      ExitCodeInShell("ulimit -f 0; QUATRO_SOLVE --correspondences='" + path +
                      "' --json='" + PathOf("a.json") + "' 2>/dev/null"),
      2);
  EXPECT_EQ(Contents(), before);
}

TEST_F(SolveProgramTest, ClosedStandardOutputIsAnError) {
  const std::string path = WriteMatches("a.csv", MakeProblem(100, 10).matches);
  EXPECT_EQ(ExitCodeInShell("QUATRO_SOLVE --correspondences='" + path +
                            "' <&- >&- 2>&-"),
            2);
}

TEST_F(SolveProgramTest, ANameThatIsNotUtf8) {
  const std::string path =
      WriteMatches("a\xff.csv", MakeProblem(100, 10).matches);
  const json report = ReportOf(Solve(path));
  EXPECT_THAT(report["parameters"]["correspondences"].get<std::string>(),
              EndsWith("a\uFFFD.csv"));
}

TEST_F(SolveProgramTest, JsonOntoTheGuess) {
  const std::string path = WriteMatches("a.csv", MakeProblem(20, 1).matches);
  const std::string guess = Write("guess.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n");
  ExpectBadInput("quatro_solve",
                 {"--correspondences=" + path,
                  "--guess=" + guess,
                  "--max_yaw_deg=20",
                  "--json=" + guess},
                 guess,
                 "is also an input");
}

TEST_F(SolveProgramTest, HelpNamesTheFlags) {
  const ProgramRun run = RunProgram("quatro_solve", {"--helpshort"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.err, "");
  for (const char* flag : {"-correspondences", "-noise_bound", "-json"}) {
    EXPECT_THAT(run.out, HasSubstr(flag));
  }
}

TEST_F(SolveProgramTest, ThreadsChangeNothing) {
  const std::string path = WriteMatches("a.csv", MakeProblem(2000, 12).matches);
  const ProgramRun one = Solve(path, {"--threads=1"});
  EXPECT_EQ(one.exit_code, 0) << one.err;
  for (const char* threads : {"--threads=2", "--threads=3"}) {
    EXPECT_EQ(WithoutTimings(Solve(path, {threads}).out),
              WithoutTimings(one.out));
  }
}

TEST_F(SolveProgramTest, OrderOfMatchesChangesNothing) {
  const MatchedPoints matches = MakeProblem(400, 13).matches;
  const std::vector<Eigen::Index> order = RandomPermutation(400, 14);
  const MatchedPoints permuted = {matches.source(Eigen::all, order),
                                  matches.target(Eigen::all, order)};
  EXPECT_EQ(Report(permuted)["target_from_source"].dump(),
            Report(matches)["target_from_source"].dump());
}

TEST_F(SolveProgramTest, SwappedClouds) {
  const MatchedPoints matches = MakeProblem(400, 15).matches;
  const Rigid3 forth = PoseOf(Report(matches));
  const Rigid3 back = PoseOf(Report({matches.target, matches.source}));
  const Rigid3 round_trip = back * forth;
  EXPECT_LT(round_trip.translation.norm(), kNoiseBound);
  EXPECT_LT(AngleBetween(round_trip.rotation, Eigen::Matrix3d::Identity()),
            0.5 * M_PI / 180.0);
}

TEST_F(SolveProgramTest, PictureIsAPng) {
  std::string error;
  if (!CanDrawPictures(&error)) GTEST_SKIP() << "needs matplotlib: " << error;
  const std::string path = WriteMatches("a.csv", MakeProblem(100, 16).matches);
  const ProgramRun run = Solve(path, {"--picture=" + PathOf("a.png")});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(Read("a.png"), StartsWith(kPngSignature));
  EXPECT_EQ(WithoutTimings(run.out), WithoutTimings(Solve(path).out));
  EXPECT_EQ(Contents().size(), 2u);
}

TEST_F(SolveProgramTest, PictureOfNoAnswerIsAPng) {
  std::string error;
  if (!CanDrawPictures(&error)) GTEST_SKIP() << "needs matplotlib: " << error;
  const std::string path =
      WriteMatches("a.csv", {Points::Ones(3, 1), Points::Zero(3, 1)});
  const ProgramRun run = Solve(path, {"--picture=" + PathOf("a.png")});
  EXPECT_EQ(run.exit_code, 1) << run.err;
  EXPECT_THAT(Read("a.png"), StartsWith(kPngSignature));
}

}  // namespace
}  // namespace quatro::solve_program_test
