// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// quatro_experiment on scans, run as a program.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "experiments/metrics/pair_result.h"
#include "experiments/report/report_template.h"
#include "features/base/random.h"
#include "features/io/cloud_io.h"
#include "tests/support/room_scans.h"
#include "tests/support/run_program.h"

namespace quatro::experiment_program_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr int kNumPairs = 12;
constexpr int kNumViews = 5;

class ExperimentProgramTest : public ProgramTest {
 protected:
  void SetUp() override {
    std::string error;
    ASSERT_TRUE(WriteCloud(RoomSource(), PathOf("source.bin"), &error));
    ASSERT_TRUE(WriteCloud(RoomTarget(), PathOf("target.bin"), &error));
    std::ostringstream list;
    list << "set,source,target,tx,ty,tz,qx,qy,qz,qw\n";
    for (int i = 0; i < kNumPairs; ++i) {
      list << (i % 2 == 0 ? "even" : "odd")
           << ",source.bin,target.bin,0.8,-0.5,0.1,0,0,"
           << "0.19866933079506122,0.98006657784124163\n";
    }
    Write("pairs.csv", list.str());
  }

  std::vector<std::string> Flags(const std::string& output) const {
    return {"--protocol=pairs",
            "--pairs=" + PathOf("pairs.csv"),
            "--preset=indoor",
            "--methods=quatro,ransac1k",
            "--threads=1",
            "--report_views=" + std::to_string(kNumViews),
            "--output=" + PathOf(output)};
  }

  std::vector<std::string> Flags(const std::string& output,
                                 const std::string& more) const {
    std::vector<std::string> flags = Flags(output);
    flags.push_back(more);
    return flags;
  }

  // All tables except the timing tables.
  std::map<std::string, std::string> TablesOf(const std::string& output) const {
    std::map<std::string, std::string> tables;
    for (const auto& [name, text] : Contents()) {
      if (name.starts_with(output + "/tables/") &&
          name.find("timing") == std::string::npos) {
        tables[name.substr(output.size())] = text;
      }
    }
    EXPECT_GE(tables.size(), 4u) << output;
    return tables;
  }

  // The views, and the page without the manifest and times.
  std::map<std::string, std::string> ReportOf(const std::string& output) const {
    std::map<std::string, std::string> report;
    for (const auto& [name, text] : Contents()) {
      if (name.starts_with(output + "/views/") && !text.empty()) {
        report[name.substr(output.size())] = text;
      }
    }
    EXPECT_EQ(report.size(), static_cast<std::size_t>(kNumViews)) << output;
    std::string error;
    if (!ReadReportTemplate(&error)) return report;
    const std::string page = Read(output + "/report.html");
    const std::string mark = "id=\"data\">";
    const std::size_t begin = page.find(mark) + mark.size();
    const std::size_t end = page.find("</script>", begin);
    auto data = nlohmann::json::parse(page.substr(begin, end - begin));
    for (auto& row : data["pairs"]["rows"]) {
      for (int i = 0; i < 2; ++i) row.erase(row.size() - 1);
    }
    report["rows"] = data["pairs"]["rows"].dump();
    report["views"] = data["views"].dump();
    return report;
  }

  // Starts the program and kills it after this time; returns whether it had
  // finished.
  bool RunAndKill(const std::vector<std::string>& args, double seconds) const {
    const pid_t child = fork();
    if (child == 0) {
      std::vector<std::string> command = {std::string(QUATRO_BIN_DIR) +
                                          "/quatro_experiment"};
      command.insert(command.end(), args.begin(), args.end());
      std::vector<char*> argv;
      for (std::string& arg : command) argv.push_back(arg.data());
      argv.push_back(nullptr);
      std::freopen("/dev/null", "w", stdout);
      std::freopen("/dev/null", "w", stderr);
      execv(argv[0], argv.data());
      _exit(127);
    }
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
    kill(child, SIGKILL);
    int status = 0;
    EXPECT_EQ(waitpid(child, &status, 0), child);
    return WIFEXITED(status);
  }
};

TEST_F(ExperimentProgramTest, LeavesResultsTablesAndAManifest) {
  const ProgramRun run = RunProgram("quatro_experiment", Flags("run"));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("ransac1k"));
  std::string error;
  const auto results = ReadResultCsv(PathOf("run/results.csv"), &error);
  ASSERT_TRUE(results) << error;
  ASSERT_EQ(results->size(), 2u * kNumPairs);
  for (const PairResult& result : *results) {
    ASSERT_TRUE(result.error) << result.pair;
    EXPECT_LT(result.error->translation, 0.3) << result.pair;
    EXPECT_LT(result.error->rotation, 0.05) << result.pair;
  }
  const auto manifest = nlohmann::json::parse(Read("run/manifest.json"));
  EXPECT_EQ(manifest["flags"]["methods"], "quatro,ransac1k");
  TablesOf("run");
}

TEST_F(ExperimentProgramTest, KilledAtRandomMomentsItEndsTheSame) {
  ASSERT_EQ(RunProgram("quatro_experiment", Flags("whole")).exit_code, 0);
  Random random(3);
  int num_kills = 0;
  while (num_kills < 10) {
    if (RunAndKill(Flags("killed"), 0.005 + 0.12 * random.Uniform())) break;
    ++num_kills;
  }
  EXPECT_GE(num_kills, 2);
  const ProgramRun run = RunProgram("quatro_experiment", Flags("killed"));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(TablesOf("killed"), TablesOf("whole"));
  EXPECT_EQ(ReportOf("killed"), ReportOf("whole"));
}

TEST_F(ExperimentProgramTest, PartsMergeIntoTheWhole) {
  ASSERT_EQ(RunProgram("quatro_experiment", Flags("whole")).exit_code, 0);
  for (const char* shard : {"--shard=1/3", "--shard=3/3"}) {
    const ProgramRun run =
        RunProgram("quatro_experiment", Flags("parts", shard));
    ASSERT_EQ(run.exit_code, 0) << run.err;
  }
  const ProgramRun early =
      RunProgram("quatro_experiment", Flags("parts", "--merge"));
  EXPECT_EQ(early.exit_code, 2);
  EXPECT_THAT(early.err, HasSubstr("is not done"));
  ASSERT_EQ(
      RunProgram("quatro_experiment", Flags("parts", "--shard=2/3")).exit_code,
      0);
  const ProgramRun merged =
      RunProgram("quatro_experiment", Flags("parts", "--merge"));
  ASSERT_EQ(merged.exit_code, 0) << merged.err;
  EXPECT_EQ(TablesOf("parts"), TablesOf("whole"));
  EXPECT_EQ(ReportOf("parts"), ReportOf("whole"));
}

TEST_F(ExperimentProgramTest, OtherLimitsMakeTheTablesAnew) {
  ASSERT_EQ(RunProgram("quatro_experiment", Flags("run")).exit_code, 0);
  const ProgramRun again =
      RunProgram("quatro_experiment", Flags("run", "--limits=0/0"));
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_THAT(again.out, HasSubstr("success % / 0 m 0 deg"));
  EXPECT_THAT(again.out, Not(HasSubstr("100.00")));
  EXPECT_THAT(again.out, Not(HasSubstr("2 m 10 deg")));
  ExpectBadInput("quatro_experiment",
                 Flags("run", "--limits=2"),
                 "--limits",
                 "must be like 2/10");
}

TEST_F(ExperimentProgramTest, ProblemsAreStoppedGoneOnWithAndSharedOutToo) {
  const auto flags = [this](const std::string& folder,
                            const std::string& more) {
    return std::vector<std::string>{"--protocol=synthetic",
                                    "--families=outliers,degeneracy",
                                    "--methods=quatro,ransac1k",
                                    "--seeds=2",
                                    "--output=" + PathOf(folder),
                                    more};
  };
  const ProgramRun whole =
      RunProgram("quatro_experiment", flags("whole", "--threads=2"));
  ASSERT_EQ(whole.exit_code, 0) << whole.err;
  EXPECT_THAT(whole.out, HasSubstr("degeneracy"));
  // There are pairs at 9-12 m, but no loops at the paper's distances.
  EXPECT_FALSE(std::filesystem::exists(PathOf("whole/tables/table_one.csv")));
  for (const char* more : {"--shard=1/2", "--shard=2/2", "--merge"}) {
    const ProgramRun run =
        RunProgram("quatro_experiment", flags("parts", more));
    ASSERT_EQ(run.exit_code, 0) << run.err;
  }
  EXPECT_EQ(TablesOf("parts"), TablesOf("whole"));
  ExpectBadInput("quatro_experiment",
                 flags("whole", "--seeds=3"),
                 "belongs to another run",
                 "tasks");
  ExpectBadInput("quatro_experiment",
                 flags("other", "--families=magic"),
                 "--families",
                 "no family magic");
  ExpectBadInput("quatro_experiment",
                 flags("other", "--methods=gicp"),
                 "--methods",
                 "works on clouds");
}

TEST_F(ExperimentProgramTest, FiguresDrawnSinceComeIntoTheReport) {
  std::string error;
  if (!ReadReportTemplate(&error)) GTEST_SKIP() << error;
  ASSERT_EQ(RunProgram("quatro_experiment", Flags("run")).exit_code, 0);
  EXPECT_THAT(Read("run/report.html"), HasSubstr("\"figures\":[]"));
  std::filesystem::create_directory(PathOf("run/figures"));
  Write("run/figures/recall.png", "foobar");
  ASSERT_EQ(RunProgram("quatro_experiment", Flags("run")).exit_code, 0);
  EXPECT_THAT(
      Read("run/report.html"),
      HasSubstr("\"figures\":[{\"name\":\"recall\",\"png\":\"Zm9vYmFy\"}]"));
}

// Otherwise the lock and the rows would be standard input and standard error.
TEST_F(ExperimentProgramTest, ClosedStreamsDoNotEndUpInTheRows) {
  std::string command = std::string(QUATRO_BIN_DIR) + "/quatro_experiment";
  for (const std::string& flag : Flags("run")) command += " '" + flag + "'";
  ASSERT_EQ(std::system((command + " <&- 2>&- >/dev/null").c_str()), 0);
  EXPECT_THAT(Read("run/rows.csv"),
              ::testing::StartsWith(ResultCsvHeader() + "\n"));
  EXPECT_EQ(Read("run/run.lock"), "");
}

TEST_F(ExperimentProgramTest, OtherFlagsOrDataAreNotMixedIn) {
  ASSERT_EQ(RunProgram("quatro_experiment", Flags("run")).exit_code, 0);
  ExpectBadInput("quatro_experiment",
                 Flags("run", "--seed=2"),
                 "belongs to another run",
                 "seed");
  std::string list = Read("pairs.csv");
  list.replace(list.find("0.8,"), 3, "0.9");
  Write("pairs.csv", list);
  ExpectBadInput(
      "quatro_experiment", Flags("run"), "belongs to another run", "tasks");
}

TEST_F(ExperimentProgramTest, FlagsOfOtherProtocolsAreNotIgnored) {
  ExpectBadInput("quatro_experiment",
                 Flags("run", "--bins=0-2"),
                 "--bins cannot be used with --protocol=pairs",
                 "only with: loop, timing, tilt");
  ExpectBadInput("quatro_experiment",
                 {"--protocol=tims", "--outliers=0.5"},
                 "--outliers cannot be used with --protocol=tims",
                 "only with: film");
}

TEST_F(ExperimentProgramTest, BadFlagsAreOneLine) {
  ExpectBadInput("quatro_experiment",
                 {"--protocol=loop", "--output=" + PathOf("run")},
                 "--data",
                 "must name a folder");
  ExpectBadInput("quatro_experiment",
                 {"--protocol=pairs",
                  "--pairs=" + PathOf("nowhere.csv"),
                  "--output=" + PathOf("run")},
                 "nowhere.csv",
                 "");
  ExpectBadInput("quatro_experiment",
                 Flags("run", "--methods=magic"),
                 "magic",
                 "must be one of");
  ExpectBadInput(
      "quatro_experiment", Flags("run", "--shard=4/3"), "--shard", "k/n");
  ExpectBadInput("quatro_experiment",
                 Flags("run", "--report_views=-1"),
                 "--report_views",
                 "must be >= 0");
  ExpectBadInput("quatro_experiment", {"--protocol=magic"}, "magic", "must be");
  for (const char* text : {"0", "1.5", "nan", "99999999999", "1e300"}) {
    ExpectBadInput("quatro_experiment",
                   {"--protocol=interval",
                    "--data=" + PathOf("nowhere"),
                    "--output=" + PathOf("run"),
                    std::string("--intervals=1,") + text},
                   "--intervals",
                   "is not a number of frames");
  }
  for (const char* text : {"0", "1e-09", "nan", "181"}) {
    ExpectBadInput("quatro_experiment",
                   {"--protocol=yaw",
                    "--data=" + PathOf("nowhere"),
                    "--output=" + PathOf("run"),
                    std::string("--yaw_step_deg=") + text},
                   std::string("--yaw_step_deg=") + text,
                   "must be in [0.01, 180]");
  }
  for (const char* text : {"0", "1000001", "2147483647"}) {
    ExpectBadInput("quatro_experiment",
                   {"--protocol=tims", std::string("--seeds=") + text},
                   "--seeds",
                   "must be 1 to 1000000");
  }
  for (const char* text : {"999", "9223372036854775807"}) {
    ExpectBadInput("quatro_experiment",
                   {"--protocol=sizes", std::string("--max_matches=") + text},
                   "--max_matches",
                   "must be 1000 to 1000000000");
  }
  ExpectBadInput("quatro_experiment",
                 {"--protocol=pairs", "--pairs=" + PathOf("pairs.csv")},
                 "--output",
                 "must name a folder");
}

}  // namespace
}  // namespace quatro::experiment_program_test
