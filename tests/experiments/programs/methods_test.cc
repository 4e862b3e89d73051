// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/programs/methods.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "experiments/simulator/synthetic.h"
#include "robust/estimators/arc_consensus.h"
#include "robust/estimators/fgr.h"
#include "robust/estimators/ransac.h"
#include "robust/estimators/teaser.h"
#include "tests/support/ins_solutions.h"
#include "tests/support/random_problems.h"

namespace quatro::methods_test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::Not;
using ::testing::UnorderedElementsAre;

constexpr MethodInput kInputs[] = {
    MethodInput::kMatches, MethodInput::kMatchedClouds, MethodInput::kClouds};

std::vector<std::string> MatchMethodNames() {
  return ExperimentMethodNames(MethodInput::kMatches);
}

std::vector<std::string> CloudMethodNames() {
  std::vector<std::string> names =
      ExperimentMethodNames(MethodInput::kMatchedClouds);
  for (const auto& name : ExperimentMethodNames(MethodInput::kClouds)) {
    names.push_back(name);
  }
  return names;
}

RegistrationSummary RunMethod(const std::string& name,
                              const MatchedProblem& problem,
                              const RegistrationOptions& options) {
  std::string error;
  const MatchSolver solve = FindMatchSolver(name, {}, &error);
  EXPECT_TRUE(solve) << name;
  EXPECT_EQ(error, "");
  return solve({problem.source, problem.target}, options);
}

PoseSummary Solve(const std::string& name,
                  const MatchedProblem& problem,
                  RegistrationOptions options = {}) {
  if (NeedsIns(name)) options.ins.mode = InsMode::kLeveled;  // Level.
  const RegistrationSummary summary = RunMethod(name, problem, options);
  EXPECT_EQ(summary.error, "") << name;
  return summary.solution;
}

RegistrationSummary RegisterBy(const std::string& name,
                               const PointCloud& source,
                               const PointCloud& target,
                               const RegistrationOptions& options) {
  std::string error;
  const PairSolver solve = FindPairSolver(name, {}, &error);
  EXPECT_TRUE(solve) << error;
  return solve(source, target, /*matched=*/nullptr, options);
}

void ExpectSameBits(const PoseSummary& a, const PoseSummary& b) {
  ASSERT_TRUE(a.IsUsable()) << a.message;
  ASSERT_TRUE(b.IsUsable()) << b.message;
  EXPECT_EQ(a.target_from_source->ToMatrix(), b.target_from_source->ToMatrix());
}

TEST(Methods, EachTellsSizesThatDiffer) {
  MatchedProblem problem = MakeOutlierProblem(50, 0.5, 0.05, 1);
  problem.target.conservativeResize(3, 10);
  for (const std::string& name : MatchMethodNames()) {
    RegistrationOptions options;
    if (NeedsIns(name)) options.ins.mode = InsMode::kLeveled;
    const RegistrationSummary summary = RunMethod(name, problem, options);
    EXPECT_EQ(summary.solution.termination, PoseTermination::kInvalidInput)
        << name;
    EXPECT_EQ(summary.error,
              "50 source points but 10 target points; equal numbers are "
              "required")
        << name;
  }
}

TEST(Methods, AllNamesResolveAndSolve) {
  EXPECT_THAT(MatchMethodNames(),
              IsSupersetOf({"auto",
                            "quatro",
                            "quatro_single",
                            "quatro_exact",
                            "arc_consensus",
                            "consensus",
                            "teaser",
                            "fgr",
                            "ransac1k",
                            "ransac10k"}));
  const MatchedProblem problem = MakeOutlierProblem(200, 0.5, 0.05, 1);
  for (const std::string& name : MatchMethodNames()) {
    const PoseSummary summary = Solve(name, problem);
    ASSERT_TRUE(summary.IsUsable()) << name << ": " << summary.message;
    EXPECT_LE((summary.target_from_source->translation -
               problem.true_target_from_source.translation)
                  .norm(),
              0.3)
        << name;
    EXPECT_THAT("\n" + DescribeMatchMethods(), HasSubstr("\n" + name + " "));
  }
}

TEST(Methods, AreTheSolversTheyAreNamedFor) {
  const MatchedProblem problem = MakeOutlierProblem(200, 0.7, 0.1, 2);
  ExpectSameBits(Solve("quatro", problem),
                 SolveQuatro(problem.source, problem.target, {}));
  ExpectSameBits(Solve("quatro_single", problem),
                 SolveQuatro(problem.source, problem.target, {}));
  QuatroOptions exact;
  exact.yaw_solver = YawSolver::kExact;
  ExpectSameBits(Solve("quatro_exact", problem),
                 SolveQuatro(problem.source, problem.target, exact));
  ExpectSameBits(Solve("arc_consensus", problem),
                 SolveArcConsensus(problem.source, problem.target, {}));
  ExpectSameBits(Solve("teaser", problem),
                 SolveTeaser(problem.source, problem.target, {}));
  ExpectSameBits(Solve("fgr", problem),
                 SolveFgr(problem.source, problem.target, {}));
  ExpectSameBits(Solve("ransac10k", problem),
                 SolveRansac(problem.source, problem.target, {}));
  RansacOptions thousand;
  thousand.max_iterations = 1000;
  ExpectSameBits(Solve("ransac1k", problem),
                 SolveRansac(problem.source, problem.target, thousand));
}

TEST(Methods, TakeWhatAppliesToThemFromTheOptions) {
  const MatchedProblem problem = MakeOutlierProblem(200, 0.5, 0.1, 3);
  RegistrationOptions options;
  options.noise_bound = 0.05;  // Smaller than the noise.
  for (const std::string& name : MatchMethodNames()) {
    EXPECT_LT(Solve(name, problem, options).num_translation_inliers,
              Solve(name, problem).num_translation_inliers)
        << name;
  }
  options = {};
  options.quatro.crosscheck = true;
  options.teaser.crosscheck = true;
  EXPECT_TRUE(Solve("quatro", problem, options).crosscheck.has_value());
  EXPECT_TRUE(Solve("teaser", problem, options).crosscheck.has_value());
}

TEST(Methods, AnUnknownNameListsAll) {
  for (const char* name : {"", "Quatro", "Ransac"}) {
    std::string error, pair_error;
    EXPECT_FALSE(FindMatchSolver(name, {}, &error)) << name;
    EXPECT_FALSE(FindPairSolver(name, {}, &pair_error)) << name;
    EXPECT_EQ(error, pair_error);
    EXPECT_THAT(error, HasSubstr("method = " + std::string(name)));
    for (const MethodInput input : kInputs) {
      for (const std::string& known : ExperimentMethodNames(input)) {
        EXPECT_THAT(error, HasSubstr(" " + known));
      }
    }
  }
}

TEST(Methods, QuatroInsNeedsAnIns) {
  const MatchedProblem problem = MakeOutlierProblem(50, 0.5, 0.05, 1);
  RegistrationOptions options;
  RegistrationSummary summary = RunMethod("quatro_ins", problem, options);
  EXPECT_THAT(summary.error, HasSubstr("needs an INS"));
  EXPECT_THAT(summary.error, HasSubstr("ins_mode"));
  EXPECT_THAT(summary.error, HasSubstr("source_rpy and target_rpy"));
  EXPECT_FALSE(summary.target_from_source());
  // An axis has another meaning.
  options.ins.up = Eigen::Vector3d::UnitX();
  summary = RunMethod("quatro_ins", problem, options);
  EXPECT_THAT(summary.error, HasSubstr("needs an INS"));
  EXPECT_FALSE(summary.target_from_source());
}

TEST(Methods, AnInsIsTakenByThoseThatTurnAboutTheVertical) {
  const SlopeProblem problem = MakeSlopeProblem(200, 0.5, 0.05, 0.2, 0.0, 1);
  const MatchedProblem& matches = problem.matches;
  RegistrationOptions options;
  options.quatro.polish = false;
  options.ins.mode = InsMode::kLeveled;
  options.ins.source_attitude = problem.source_attitude;
  options.ins.target_attitude = problem.target_attitude;
  for (const std::string& name : MatchMethodNames()) {
    const RegistrationSummary registration = RunMethod(name, matches, options);
    const bool is_about_the_vertical =
        name == "auto" || name == "arc_consensus" || name == "consensus" ||
        name.rfind("quatro", 0) == 0;
    if (!is_about_the_vertical) {
      EXPECT_FALSE(registration.target_from_source()) << name;
      EXPECT_THAT(registration.error,
                  HasSubstr("ins_mode needs one of the methods auto, "));
      EXPECT_THAT(registration.error, HasSubstr("not " + name));
      continue;
    }
    ASSERT_EQ(registration.error, "") << name;
    const PoseSummary& summary = registration.solution;
    ASSERT_TRUE(summary.IsUsable()) << name;
    EXPECT_LT(AngleBetween(summary.target_from_source->rotation,
                           matches.true_target_from_source.rotation),
              0.01)
        << name;
    // The solver of level matches, as any other.
    std::string error;
    const Method* method = FindMethod(name, &error);
    ASSERT_TRUE(method) << error;
    RegistrationOptions adjusted = options;
    if (method->adjust) method->adjust(&adjusted);
    const PoseSolver level = method->make(WithSharedValues(adjusted));
    ExpectSameBits(
        SolveWithIns(matches.source, matches.target, level, 0.3, options.ins),
        summary);
  }
}

TEST(Methods, OdometriesAreListedAndPointToTheirProgram) {
  EXPECT_THAT(OdometryMethodNames(), UnorderedElementsAre("aloam", "suma"));
  for (const std::string& name : OdometryMethodNames()) {
    EXPECT_THAT(DescribeMethods(), HasSubstr("\n" + name + " "));
    EXPECT_THAT(DescribePairMethods(), Not(HasSubstr("\n" + name + " ")));
    std::string error, pair_error;
    EXPECT_FALSE(FindMatchSolver(name, {}, &error));
    EXPECT_THAT(error, HasSubstr("method " + name + " is an odometry"));
    EXPECT_THAT(error, HasSubstr("quatro_odometry"));
    EXPECT_FALSE(FindPairSolver(name, {}, &pair_error));
    EXPECT_EQ(pair_error, error);
  }
  EXPECT_THAT(DescribeMethods(), Not(HasSubstr("quatro_ins ")));
  EXPECT_THAT(DescribePairMethods(), HasSubstr("quatro_ins "));
  // Methods that are not built are not listed.
  std::string error;
  EXPECT_FALSE(FindMatchSolver("nothing", {}, &error));
  EXPECT_THAT(error, Not(HasSubstr("suma")));
}

TEST(Methods, ThoseOfCloudsAreNotOfMatches) {
  EXPECT_THAT(CloudMethodNames(),
              IsSupersetOf({"quatro_c2f", "icp", "gicp", "vgicp"}));
  for (const std::string& name : CloudMethodNames()) {
    std::string error;
    EXPECT_FALSE(FindMatchSolver(name, {}, &error)) << name;
    EXPECT_THAT(error, HasSubstr(name + " works on clouds, not on matches"));
    EXPECT_TRUE(FindPairSolver(name, {}, &error)) << name;
    EXPECT_THAT(DescribePairMethods(), HasSubstr("\n" + name + " ")) << name;
    EXPECT_THAT(DescribeMatchMethods(), Not(HasSubstr("\n" + name + " ")));
  }
  // Those of matches run on clouds, too, but need none.
  for (const std::string& name : MatchMethodNames()) {
    std::string error;
    EXPECT_TRUE(FindMatchSolver(name, {}, &error)) << error;
    EXPECT_TRUE(FindPairSolver(name, {}, &error)) << error;
    EXPECT_THAT(CloudMethodNames(), Not(Contains(name)));
  }
  std::string error;
  EXPECT_FALSE(FindPairSolver("nothing", {}, &error));
}

// Neither of the doors takes what it cannot use.
TEST(Methods, ThoseOfCloudsSayWhatTheyMiss) {
  const MatchedProblem problem = MakeOutlierProblem(50, 0.0, 0.05, 1);
  for (const MethodInput input :
       {MethodInput::kMatchedClouds, MethodInput::kClouds}) {
    for (const std::string& name : MethodNames(input)) {
      RegistrationOptions options;
      options.method = name;
      RegistrationSummary summary =
          RegisterMatches({problem.source, problem.target}, options);
      EXPECT_THAT(summary.error,
                  HasSubstr(name + " works on clouds, not on matches"));
      EXPECT_FALSE(summary.target_from_source());
      if (input != MethodInput::kClouds) continue;
      summary = RegisterMatched(MatchedClouds(), options);
      EXPECT_THAT(summary.error,
                  HasSubstr(name + " needs the clouds themselves"));
    }
  }
}

// Quatro on matches of another library's descriptors.
bool IsFrontEnd(const std::string& name) { return name.ends_with("_fpfh"); }

bool IsGlobal(const std::string& name) {
  return name == "quatro_c2f" || IsFrontEnd(name);
}

TEST(Methods, OfCloudsAreWhatTheyAreNamedFor) {
  PointCloud source;
  PointCloud target;
  source.points = RandomStreet(3000, 0.01, 1);
  target.points =
      RandomStreet(3000, 0.01, 2).colwise() + Eigen::Vector3d(0.2, -0.1, 0.0);
  RegistrationOptions options;
  for (const std::string& name : CloudMethodNames()) {
    const RegistrationSummary summary =
        RegisterBy(name, source, target, options);
    EXPECT_EQ(summary.refinement.has_value(), !IsFrontEnd(name))
        << name << summary.error;
    if (summary.refinement) {
      EXPECT_TRUE(summary.refinement->is_accepted) << name;
      // The summary of another library: open3d_icp.
      EXPECT_EQ(RefinementName(summary.refinement->method),
                IsGlobal(name) ? "gicp" : name.substr(name.find('_') + 1));
    }
    EXPECT_EQ(summary.verdict.IsRegistered(), IsGlobal(name)) << name;
    ASSERT_TRUE(summary.target_from_source()) << name;
    EXPECT_LE((summary.target_from_source()->translation -
               Eigen::Vector3d(0.2, -0.1, 0.0))
                  .norm(),
              IsFrontEnd(name) ? 0.3 : 0.1)
        << name;
  }
}

TEST(Methods, LocalOnesStartFromTheGuess) {
  PointCloud cloud;
  cloud.points = RandomStreet(3000, 0.01, 1);
  const Rigid3 guess{RotationZ(0.02), {0.2, 0.1, 0.0}};
  RegistrationOptions options;
  options.bounds.guess = guess;
  int num_local = 0;
  for (const std::string& name : CloudMethodNames()) {
    if (IsGlobal(name)) continue;
    ++num_local;
    const RegistrationSummary summary = RegisterBy(name, cloud, cloud, options);
    ASSERT_TRUE(summary.refinement.has_value()) << name << summary.error;
    EXPECT_EQ(summary.refinement->unrefined_target_from_source.ToMatrix(),
              guess.ToMatrix());
    EXPECT_GT(summary.refinement->moved_rotation, 0.01) << name;
  }
  EXPECT_GE(num_local, 3);
}

TEST(Methods, RefinementsAreKnownByTheirNames) {
  RegistrationOptions options;
  const Option refine = RefinementOptionList(&options).front();
  ASSERT_EQ(refine.name, "refine");
  for (const char* name : {"none", "icp", "gicp", "vgicp"}) {
    std::string error;
    ASSERT_TRUE(refine.Parse(name, &error)) << error;
    EXPECT_STREQ(RefinementName(options.refinement.method), name);
  }
  std::string error;
  EXPECT_FALSE(refine.Parse("GICP", &error));
  EXPECT_THAT(
      error, HasSubstr("refine = GICP, must be one of none, icp, gicp, vgicp"));
}

TEST(Methods, AutoTakesArcConsensusAboveTwentyThousandMatches) {
  const MatchedProblem many = MakeOutlierProblem(20001, 0.9, 0.1, 4);
  ExpectSameBits(Solve("auto", many), Solve("arc_consensus", many));
  // No graph is built.
  EXPECT_EQ(Solve("auto", many).stage_times.front().stage,
            std::string("pairs"));
  const MatchedProblem few{many.source.rightCols(20000),
                           many.target.rightCols(20000),
                           many.true_target_from_source};
  const PoseSummary summary = Solve("auto", few);
  EXPECT_EQ(summary.stage_times.front().stage, std::string("graph"));
  ExpectSameBits(summary, Solve("quatro", few));
}

}  // namespace
}  // namespace quatro::methods_test
