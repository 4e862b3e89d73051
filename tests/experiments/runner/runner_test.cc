// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/runner/runner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "experiments/runner/run_folder.h"
#include "experiments/runner/run_problem.h"
#include "experiments/runner/stop_signal.h"
#include "features/base/file.h"
#include "features/io/cloud_io.h"
#include "robust/estimators/quatro.h"
#include "tests/support/random_problems.h"
#include "tests/support/room_scans.h"
#include "tests/support/run_program.h"

namespace quatro::runner_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::vector<std::string> kTwoMethods = {"quatro", "icp"};

std::vector<PairResult> Results(const std::string& pair) {
  PairResult result;
  result.pair = pair;
  result.set = "set";
  result.status = "registered";
  std::vector<PairResult> results;
  for (const std::string& method : kTwoMethods) {
    results.push_back(result);
    results.back().method = method;
  }
  return results;
}

class RunFolderTest : public ProgramTest {
 protected:
  std::string Folder() const { return PathOf("run"); }

  std::unique_ptr<RunFolder> Open() {
    return RunFolder::Open(Folder(), kTwoMethods, &error_);
  }

  // A folder with the pairs a and b.
  void MakeTwoPairs() {
    const auto folder = Open();
    ASSERT_TRUE(folder) << error_;
    ASSERT_TRUE(folder->Append(Results("a"), "", "", &error_)) << error_;
    ASSERT_TRUE(folder->Append(Results("b"), "", "", &error_)) << error_;
  }

  std::string error_;
};

TEST_F(RunFolderTest, KeepsWhatIsDone) {
  MakeTwoPairs();
  const auto folder = Open();
  ASSERT_TRUE(folder) << error_;
  EXPECT_EQ(folder->size(), 2u);
  EXPECT_TRUE(folder->Has("a"));
  EXPECT_TRUE(folder->Has("b"));
  EXPECT_FALSE(folder->Has("c"));
}

TEST_F(RunFolderTest, WhatAKillLeftHalfWrittenIsRemoved) {
  MakeTwoPairs();
  std::filesystem::create_directories(Folder() + "/views");
  const std::string left[] = {"/results.csv.tmp.123.0",
                              "/views/71b9.json.tmp.123.17"};
  const std::string kept[] = {"/views/71b9.json", "/rows.csv", "/a.tmp.txt"};
  for (const std::string& name : {left[0], left[1], kept[0], kept[2]}) {
    std::ofstream(Folder() + name) << "{";
  }
  ASSERT_TRUE(Open()) << error_;
  for (const std::string& name : left) {
    EXPECT_FALSE(std::filesystem::exists(Folder() + name)) << name;
  }
  for (const std::string& name : kept) {
    EXPECT_TRUE(std::filesystem::exists(Folder() + name)) << name;
  }
}

TEST_F(RunFolderTest, ResultsAreInTheOrderOfTheTasks) {
  MakeTwoPairs();
  const auto folder = Open();
  ASSERT_TRUE(folder->Finish({"b", "a"}, &error_)) << error_;
  const auto results = ReadResultCsv(Folder() + "/results.csv", &error_);
  ASSERT_TRUE(results) << error_;
  ASSERT_EQ(results->size(), 4u);
  EXPECT_EQ((*results)[0].pair, "b");
  EXPECT_EQ((*results)[1].method, "icp");
  EXPECT_EQ((*results)[2].pair, "a");
  EXPECT_FALSE(folder->Finish({"a", "c"}, &error_));
  EXPECT_THAT(error_, HasSubstr("pair c is not done"));
}

// The file may be truncated at any byte by a kill.
TEST_F(RunFolderTest, APairThatIsNotWholeIsTakenOff) {
  MakeTwoPairs();
  const std::string rows = Folder() + "/rows.csv";
  const std::string whole = Read("run/rows.csv");
  const std::size_t header = whole.find('\n') + 1;
  const std::size_t first = header + (whole.size() - header) / 2;
  for (std::size_t size = 0; size <= whole.size(); ++size) {
    std::filesystem::remove(rows);
    std::ofstream(rows, std::ios::binary) << whole.substr(0, size);
    {
      const auto folder = Open();
      ASSERT_TRUE(folder) << size << ": " << error_;
      EXPECT_EQ(folder->size(),
                size < first ? 0u : (size < whole.size() ? 1u : 2u))
          << size;
      if (!folder->Has("a")) {
        ASSERT_TRUE(folder->Append(Results("a"), "", "", &error_));
      }
      if (!folder->Has("b")) {
        ASSERT_TRUE(folder->Append(Results("b"), "", "", &error_));
      }
    }
    EXPECT_EQ(Read("run/rows.csv"), whole) << size;
  }
}

TEST_F(RunFolderTest, AViewIsThereOnceItsPairIs) {
  const auto folder = Open();
  ASSERT_TRUE(folder) << error_;
  const std::string name = "../<a>/b";
  ASSERT_TRUE(folder->Append(Results(name), "", "{}", &error_)) << error_;
  EXPECT_EQ(ReadWholeFile(ViewPath(Folder(), name), &error_), "{}");
  EXPECT_NE(ViewPath(Folder(), name), ViewPath(Folder(), name + "c"));
  // If a view cannot be stored, its pair is not completed.
  std::filesystem::remove_all(Folder() + "/views");
  std::ofstream(Folder() + "/views") << "in the way";
  EXPECT_FALSE(folder->Append(Results("c"), "", "{}", &error_));
  EXPECT_THAT(error_, HasSubstr("views"));
  EXPECT_FALSE(folder->Has("c"));
}

TEST_F(RunFolderTest, TwoProcessesRefuseEachOther) {
  const auto folder = Open();
  ASSERT_TRUE(folder) << error_;
  EXPECT_FALSE(Open());
  EXPECT_THAT(error_, HasSubstr("another process works in this folder"));
}

TEST_F(RunFolderTest, AFolderOfOtherThingsIsLeftAlone) {
  std::filesystem::create_directory(Folder());
  std::ofstream(Folder() + "/thesis.tex") << "x";
  EXPECT_FALSE(Open());
  EXPECT_THAT(error_, HasSubstr("holds other files"));
  EXPECT_FALSE(std::filesystem::exists(Folder() + "/run.lock"));
}

TEST_F(RunFolderTest, RowsOfOtherMethodsAreRefused) {
  MakeTwoPairs();
  EXPECT_FALSE(RunFolder::Open(Folder(), {"icp", "quatro"}, &error_));
  EXPECT_THAT(error_,
              HasSubstr("rows.csv: line 2: does not match the methods"));
}

TEST_F(RunFolderTest, ABrokenLineInTheMiddleIsAnError) {
  MakeTwoPairs();
  const std::string rows = Folder() + "/rows.csv";
  std::string text = Read("run/rows.csv");
  text.replace(text.find("\na,") + 1, 4, "a;;;");
  std::ofstream(rows, std::ios::binary) << text;
  EXPECT_FALSE(Open());
  EXPECT_THAT(error_, HasSubstr("rows.csv: line 2"));
  EXPECT_EQ(Read("run/rows.csv"), text);
}

TEST(ShardTest, PartsMakeTheWholeAndShareNothing) {
  std::vector<PairTask> tasks(11);
  for (int i = 0; i < 11; ++i) {
    tasks[static_cast<std::size_t>(i)].name = std::to_string(i);
  }
  for (const int count : {1, 2, 3, 11, 20}) {
    std::multiset<std::string> names;
    for (int k = 1; k <= count; ++k) {
      for (const PairTask& task : TakeShard(tasks, {k, count})) {
        names.insert(task.name);
      }
    }
    EXPECT_EQ(names.size(), 11u);
    EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), 11u);
  }
}

TEST(ShardTest, TextIsKOfN) {
  std::string error;
  const auto shard = ParseShard("2/5", &error);
  ASSERT_TRUE(shard) << error;
  EXPECT_EQ(shard->index, 2);
  EXPECT_EQ(shard->count, 5);
  for (const char* text : {"", "2", "0/5", "6/5", "2/", "/5", "2/5x", "-1/5"}) {
    EXPECT_FALSE(ParseShard(text, &error)) << text;
    EXPECT_THAT(error, HasSubstr("must be k/n"));
  }
}

class RunTasksTest : public RunFolderTest {
 protected:
  void SetUp() override {
    RunFolderTest::SetUp();
    const Rigid3 truth = TrueRoomPose();
    ASSERT_TRUE(WriteCloud(RoomSource(), PathOf("source.bin"), &error_))
        << error_;
    ASSERT_TRUE(WriteCloud(RoomTarget(), PathOf("target.bin"), &error_))
        << error_;
    for (int i = 0; i < 4; ++i) {
      PairTask task;
      task.name = "pair " + std::to_string(i);
      task.set = "room";
      task.bin = "yaw";
      task.source = PathOf("source.bin");
      task.target = PathOf("target.bin");
      task.added_yaw = 0.5 * i;
      task.true_target_from_source =
          truth * Rigid3{RotationZ(-task.added_yaw), Eigen::Vector3d::Zero()};
      tasks_.push_back(task);
    }
    methods_.names = kTwoMethods;
    methods_.options = RoomOptions();
  }

  RunEnd Run(const RunControl& control) {
    const auto folder = Open();
    EXPECT_TRUE(folder) << error_;
    return RunTasks(tasks_, methods_, control, folder.get(), &error_);
  }

  // The results without their times.
  std::vector<std::string> Outcome() {
    std::vector<std::string> lines;
    auto results = ReadResultCsv(Folder() + "/results.csv", &error_);
    EXPECT_TRUE(results) << error_;
    for (PairResult& result : *results) {
      result.stage_times.clear();
      result.total_seconds = 0.0;
      lines.push_back(FormatResultCsv(result));
    }
    return lines;
  }

  std::vector<PairTask> tasks_;
  RunMethods methods_;
};

TEST_F(RunTasksTest, StoppedAndGoneOnWithGivesTheSame) {
  RunControl control;
  std::vector<int> done;
  control.progress = [&](int num_done, int num_tasks) {
    EXPECT_EQ(num_tasks, 4);
    done.push_back(num_done);
  };
  ASSERT_EQ(Run(control), RunEnd::kDone) << error_;
  EXPECT_THAT(done, ::testing::ElementsAre(1, 2, 3, 4));
  const std::vector<std::string> undisturbed = Outcome();
  std::filesystem::remove_all(Folder());

  control.num_workers = 2;
  int num_asked = 0;
  control.should_stop = [&] { return ++num_asked > 2; };
  done.clear();
  EXPECT_EQ(Run(control), RunEnd::kStopped);
  EXPECT_FALSE(std::filesystem::exists(Folder() + "/results.csv"));
  EXPECT_EQ(done.size(), 2u);
  control.should_stop = nullptr;
  EXPECT_EQ(Run(control), RunEnd::kDone) << error_;
  EXPECT_EQ(done.size(), 4u);
  EXPECT_EQ(Outcome(), undisturbed);
}

TEST_F(RunTasksTest, ResultsAreOfTheTurnedSource) {
  ASSERT_EQ(Run({}), RunEnd::kDone) << error_;
  const auto results = ReadResultCsv(Folder() + "/results.csv", &error_);
  ASSERT_TRUE(results) << error_;
  for (std::size_t i = 0; i < 4; ++i) {
    const PairResult& quatro = (*results)[2 * i];
    const double yaw = 0.4 - tasks_[i].added_yaw;
    EXPECT_NEAR(*quatro.true_yaw, yaw, 1e-9);
    EXPECT_NEAR(*quatro.true_tilt, 0.0, 1e-9);
    EXPECT_NEAR(*quatro.distance, Eigen::Vector3d(0.8, -0.5, 0.1).norm(), 1e-9);
    ASSERT_TRUE(quatro.error) << quatro.status;
    EXPECT_LT(quatro.error->rotation, 0.02) << quatro.pair;
    EXPECT_LT(quatro.error->translation, 0.1) << quatro.pair;
    EXPECT_GT(quatro.num_matches, 0);
    EXPECT_GT(quatro.total_seconds, 0.0);
  }
}

TEST_F(RunTasksTest, AScanThatIsMissingIsToldAndCounted) {
  tasks_[1].source = PathOf("nowhere.bin");
  ASSERT_EQ(Run({}), RunEnd::kDone) << error_;
  const auto results = ReadResultCsv(Folder() + "/results.csv", &error_);
  ASSERT_TRUE(results) << error_;
  for (std::size_t i = 0; i < results->size(); ++i) {
    EXPECT_EQ((*results)[i].status == "unreadable", i / 2 == 1) << i;
  }
  EXPECT_THAT(Read("run/notes.txt"),
              AllOf(StartsWith("pair 1: "), HasSubstr("nowhere.bin")));
}

TEST_F(RunTasksTest, AMethodThatNeedsAnInsIsInsufficientWithoutOne) {
  methods_.names = {"quatro_ins"};
  EXPECT_EQ(RunTask(tasks_[0], methods_).results[0].status, "insufficient");
  tasks_[0].ins = PairIns{{}, {}, 0.005};
  const TaskOutcome outcome = RunTask(tasks_[0], methods_);
  const PairResult& with_ins = outcome.results[0];
  ASSERT_TRUE(with_ins.error) << outcome.note;
  EXPECT_LT(with_ins.error->rotation, 0.02);
}

TEST_F(RunTasksTest, AViewIsOfAllMethodsAndAlwaysTheSame) {
  EXPECT_EQ(RunTask(tasks_[1], methods_).view, "");
  tasks_[1].keeps_view = true;
  const std::string view = RunTask(tasks_[1], methods_).view;
  EXPECT_EQ(RunTask(tasks_[1], methods_).view, view);
  const auto json = nlohmann::json::parse(view);
  EXPECT_EQ(json["pair"], "pair 1");
  ASSERT_EQ(json["methods"].size(), 2u);
  EXPECT_FALSE(json["methods"][0]["stages"].is_null());
  EXPECT_TRUE(json["methods"][1]["stages"].is_null());  // icp has no matches.
  methods_.options.seed = 5;
  EXPECT_NE(RunTask(tasks_[1], methods_).view, view);
  tasks_[1].source = PathOf("nowhere.bin");
  EXPECT_EQ(RunTask(tasks_[1], methods_).view, "");
}

TEST_F(RunTasksTest, TwoTasksOfOneNameAreRefused) {
  tasks_[1].name = tasks_[0].name;
  EXPECT_EQ(Run({}), RunEnd::kFailed);
  EXPECT_THAT(error_, HasSubstr("pair pair 0 is listed twice"));
}

TEST_F(RunTasksTest, AnOwnMethodStandsBesideOurs) {
  const Rigid3 anywhere{RotationZ(1.0), {3.0, 2.0, 1.0}};
  methods_.own = {
      {"same",
       "",
       [](const QuatroOptions& options) -> PoseSolver {
         return [options](const PointsRef& p, const PointsRef& q) {
           return SolveQuatro(p, q, options);
         };
       }},
      {"anywhere", "", [anywhere](const QuatroOptions&) -> PoseSolver {
         return [anywhere](const PointsRef&, const PointsRef&) {
           PoseSummary summary;
           summary.termination = PoseTermination::kSolved;
           summary.target_from_source = anywhere;
           return summary;
         };
       }}};
  methods_.names = {"quatro_single", "same", "anywhere"};
  const TaskOutcome outcome = RunTask(tasks_[0], methods_);
  const std::vector<PairResult>& results = outcome.results;
  ASSERT_EQ(results.size(), 3u) << outcome.note;
  ASSERT_TRUE(results[0].target_from_source);
  ASSERT_TRUE(results[1].target_from_source);
  ASSERT_TRUE(results[2].target_from_source);
  EXPECT_EQ(results[1].method, "same");
  EXPECT_EQ(results[1].target_from_source->ToMatrix(),
            results[0].target_from_source->ToMatrix());
  EXPECT_EQ(results[2].target_from_source->ToMatrix(), anywhere.ToMatrix());
}

// Matched points instead of scans, under `true_target_from_source`; all are
// inliers except every tenth.
PairTask ProblemTask(const Rigid3& true_target_from_source) {
  PairTask task;
  task.name = "points";
  task.true_target_from_source = true_target_from_source;
  task.make_problem = [true_target_from_source] {
    MatchedProblem problem;
    problem.source = RandomPoints(50, 20.0, 3);
    problem.target = true_target_from_source.Apply(problem.source);
    for (Eigen::Index i = 0; i < 50; i += 10) {
      problem.target.col(i) +=
          Eigen::Vector3d(5.0, static_cast<double>(i), -3.0);
    }
    problem.true_target_from_source = true_target_from_source;
    return problem;
  };
  return task;
}

TEST_F(RunTasksTest, ProblemsAreRunAsScansAre) {
  const Rigid3 truth{RotationZ(2.0), {3.0, -4.0, 0.5}};
  tasks_ = {ProblemTask(truth)};
  methods_.names = {"quatro", "ransac10k"};
  ASSERT_EQ(Run({}), RunEnd::kDone) << error_;
  const auto results = ReadResultCsv(Folder() + "/results.csv", &error_);
  ASSERT_TRUE(results) << error_;
  ASSERT_EQ(results->size(), 2u);
  for (const PairResult& result : *results) {
    EXPECT_EQ(result.status, "registered") << result.method;
    ASSERT_TRUE(result.error) << result.method;
    EXPECT_LT(result.error->rotation, 1e-6) << result.method;
    EXPECT_LT(result.error->translation, 1e-6) << result.method;
    EXPECT_NEAR(*result.true_yaw, 2.0, 1e-12);
    EXPECT_EQ(result.num_matches, 50);
    EXPECT_EQ(result.num_inliers, 45);
  }
}

TEST(RunProblemTest, AnOwnMethodIsGivenTheOptions) {
  RunMethods methods;
  double noise_bound = 0.0;
  std::uint64_t seed = 0;
  methods.own = {{"mine", "", [&](const QuatroOptions& options) -> PoseSolver {
                    noise_bound = options.noise_bound;
                    seed = options.seed;
                    return [options](const PointsRef& p, const PointsRef& q) {
                      return SolveQuatro(p, q, options);
                    };
                  }}};
  methods.names = {"mine"};
  methods.options.noise_bound = 0.125;
  methods.options.seed = 17;
  const Rigid3 truth{RotationZ(-1.0), {1.0, 2.0, 0.0}};
  const TaskOutcome outcome = RunProblem(ProblemTask(truth), methods);
  ASSERT_EQ(outcome.results.size(), 1u);
  EXPECT_EQ(outcome.results[0].method, "mine");
  ASSERT_TRUE(outcome.results[0].error);
  EXPECT_LT(outcome.results[0].error->translation, 1e-6);
  EXPECT_EQ(noise_bound, 0.125);
  EXPECT_EQ(seed, 17u);
}

TEST(RunProblemTest, MethodsThatNeedMoreThanMatchesAreRefused) {
  RunMethods methods;
  std::string error;
  methods.names = {"quatro", "teaser"};
  EXPECT_TRUE(CanRunProblems(methods, &error)) << error;
  methods.names = {"quatro", "icp"};
  EXPECT_FALSE(CanRunProblems(methods, &error));
  EXPECT_THAT(error, HasSubstr("icp works on clouds"));
  methods.names = {"quatro_ins"};
  EXPECT_FALSE(CanRunProblems(methods, &error));
  EXPECT_THAT(error, HasSubstr("quatro_ins needs an INS"));
  methods.names = {"quatro", "quatro"};
  EXPECT_FALSE(CanRunProblems(methods, &error));
  EXPECT_THAT(error, HasSubstr("is listed twice"));
}

TEST(RunMethodsTest, AnOwnNameIsKnownUnlessItIsOneOfOurs) {
  RunMethods methods;
  std::string error;
  methods.names = {"quatro", "mine"};
  EXPECT_FALSE(methods.IsValid(&error));
  EXPECT_THAT(error, HasSubstr("method = mine, must be one of"));
  methods.own = {{"mine", "", nullptr}};
  EXPECT_TRUE(methods.IsValid(&error)) << error;
  methods.own[0].name = "quatro";
  methods.names = {"quatro"};
  EXPECT_FALSE(methods.IsValid(&error));
  EXPECT_THAT(error,
              HasSubstr("method quatro is both an own one and one of quatro"));
}

TEST(RunMethodsTest, NamesAreOfTheRegistryAndComeOnce) {
  RunMethods methods;
  std::string error;
  EXPECT_FALSE(methods.IsValid(&error));
  methods.names = {"quatro", "icp", "quatro_c2f"};
  EXPECT_TRUE(methods.IsValid(&error)) << error;
  methods.names = {"quatro", "quatro"};
  EXPECT_FALSE(methods.IsValid(&error));
  EXPECT_THAT(error, HasSubstr("is listed twice"));
  methods.names = {"aloam"};
  EXPECT_FALSE(methods.IsValid(&error));
  EXPECT_THAT(error, HasSubstr("odometry"));
}

// The exit code of a process that is sent this signal; 0 if it goes on unasked.
int ExitCodeAfter(int signal, bool is_ignored) {
  const pid_t child = fork();
  if (child == 0) {
    if (is_ignored) std::signal(signal, SIG_IGN);
    ListenForStop();
    std::raise(signal);
    _exit(WasAskedToStop() ? 1 : 0);
  }
  int status = 0;
  EXPECT_EQ(waitpid(child, &status, 0), child);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

TEST(StopSignalTest, AClosedTerminalStopsARunUnlessItIsIgnored) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    EXPECT_EQ(ExitCodeAfter(signal, /*is_ignored=*/false), 1) << signal;
  }
  EXPECT_EQ(ExitCodeAfter(SIGHUP, /*is_ignored=*/true), 0);  // nohup
}

}  // namespace
}  // namespace quatro::runner_test
