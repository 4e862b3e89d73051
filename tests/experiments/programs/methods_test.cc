// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/programs/methods.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "experiments/simulator/synthetic.h"
#include "robust/estimators/arc_consensus.h"
#include "robust/estimators/fgr.h"
#include "robust/estimators/ransac.h"
#include "robust/estimators/teaser.h"
#include "tests/support/random_problems.h"

namespace quatro {
namespace {

using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::UnorderedElementsAre;

PoseSummary Solve(const std::string& name,
                  const MatchedProblem& problem,
                  const QuatroOptions& options = {}) {
  std::string error;
  InsOptions ins;  // Level.
  if (name == "quatro_ins") ins.mode = InsMode::kLeveled;
  const PoseSolver solve = MakeSolver(name, options, ins, &error);
  EXPECT_TRUE(solve) << name;
  EXPECT_EQ(error, "");
  return solve(problem.source, problem.target);
}

void ExpectSameBits(const PoseSummary& a, const PoseSummary& b) {
  ASSERT_TRUE(a.IsUsable()) << a.message;
  ASSERT_TRUE(b.IsUsable()) << b.message;
  EXPECT_EQ(a.target_from_source->ToMatrix(), b.target_from_source->ToMatrix());
}

TEST(Methods, EachTellsSizesThatDiffer) {
  MatchedProblem problem = MakeOutlierProblem(50, 0.5, 0.05, 1);
  problem.target.conservativeResize(3, 10);
  for (const std::string& name : MethodNames()) {
    const PoseSummary summary = Solve(name, problem);
    EXPECT_EQ(summary.termination, PoseTermination::kInvalidInput) << name;
    EXPECT_EQ(summary.message,
              "50 source points but 10 target points; equal numbers are "
              "required")
        << name;
  }
}

TEST(Methods, AllNamesResolveAndSolve) {
  EXPECT_THAT(MethodNames(),
              IsSupersetOf({"auto",
                            "quatro",
                            "quatro_exact",
                            "arc_consensus",
                            "teaser",
                            "fgr",
                            "ransac1k",
                            "ransac10k"}));
  const MatchedProblem problem = MakeOutlierProblem(200, 0.5, 0.05, 1);
  for (const std::string& name : MethodNames()) {
    const PoseSummary summary = Solve(name, problem);
    ASSERT_TRUE(summary.IsUsable()) << name << ": " << summary.message;
    EXPECT_LE((summary.target_from_source->translation -
               problem.true_target_from_source.translation)
                  .norm(),
              0.3)
        << name;
    EXPECT_THAT(DescribeMethods(), HasSubstr(name + " ")) << name;
  }
}

TEST(Methods, AreTheSolversTheyAreNamedFor) {
  const MatchedProblem problem = MakeOutlierProblem(200, 0.7, 0.1, 2);
  ExpectSameBits(Solve("quatro", problem),
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
  QuatroOptions options;
  options.noise_bound = 0.05;  // Smaller than the noise.
  for (const std::string& name : MethodNames()) {
    EXPECT_LT(Solve(name, problem, options).num_translation_inliers,
              Solve(name, problem).num_translation_inliers)
        << name;
  }
  options = {};
  options.crosscheck = true;
  EXPECT_TRUE(Solve("quatro", problem, options).crosscheck.has_value());
  EXPECT_TRUE(Solve("teaser", problem, options).crosscheck.has_value());
}

TEST(Methods, AnUnknownNameListsAll) {
  for (const char* name : {"", "Quatro", "Ransac"}) {
    std::string error;
    EXPECT_FALSE(MakeSolver(name, {}, &error)) << name;
    EXPECT_THAT(error, HasSubstr("--method=" + std::string(name)));
    for (const std::string& known : MethodNames()) {
      EXPECT_THAT(error, HasSubstr(" " + known));
    }
  }
}

TEST(Methods, QuatroInsNeedsAnIns) {
  std::string error;
  EXPECT_FALSE(MakeSolver("quatro_ins", {}, &error));
  EXPECT_THAT(error, HasSubstr("needs an INS"));
  EXPECT_THAT(error, HasSubstr("--source_rpy_deg"));
  // An axis has another meaning.
  InsOptions ins;
  ins.up = Eigen::Vector3d::UnitX();
  EXPECT_FALSE(MakeSolver("quatro_ins", {}, ins, &error));
}

TEST(Methods, AnInsIsTakenByThoseThatTurnAboutTheVertical) {
  const SlopeProblem problem = MakeSlopeProblem(200, 0.5, 0.05, 0.2, 0.0, 1);
  QuatroOptions options;
  options.polish = false;
  InsOptions ins;
  ins.mode = InsMode::kLeveled;
  ins.source_attitude = problem.source_attitude;
  ins.target_attitude = problem.target_attitude;
  for (const std::string& name : MethodNames()) {
    std::string error;
    const PoseSolver solve = MakeSolver(name, options, ins, &error);
    const PoseSolver level = MakeLevelSolver(name, options, ins, &error);
    ASSERT_EQ(static_cast<bool>(level), static_cast<bool>(solve)) << name;
    const bool is_about_the_vertical = name == "auto" ||
                                       name == "arc_consensus" ||
                                       name.rfind("quatro", 0) == 0;
    if (!is_about_the_vertical) {
      EXPECT_FALSE(solve);
      EXPECT_THAT(error, HasSubstr("--ins_mode needs one of --method=auto, "));
      EXPECT_THAT(error, HasSubstr("not " + name));
      continue;
    }
    ASSERT_TRUE(solve) << error;
    const MatchedProblem& matches = problem.matches;
    const PoseSummary summary = solve(matches.source, matches.target);
    ASSERT_TRUE(summary.IsUsable()) << name;
    EXPECT_LT(AngleBetween(summary.target_from_source->rotation,
                           matches.true_target_from_source.rotation),
              0.01)
        << name;
    ExpectSameBits(
        SolveWithIns(matches.source, matches.target, level, 0.3, ins), summary);
  }
}

TEST(Methods, OdometriesAreListedAndPointToTheirProgram) {
  EXPECT_THAT(OdometryMethodNames(), UnorderedElementsAre("aloam", "suma"));
  for (const std::string& name : OdometryMethodNames()) {
    EXPECT_THAT(DescribeMethods(), HasSubstr("\n" + name + " "));
    std::string error;
    EXPECT_FALSE(MakeSolver(name, {}, &error));
    EXPECT_THAT(error, HasSubstr("--method=" + name + " is an odometry"));
    EXPECT_THAT(error, HasSubstr("quatro_odometry"));
    EXPECT_FALSE(FindCloudSolver(name));
  }
  // Methods that are not built are not listed.
  std::string error;
  EXPECT_FALSE(MakeSolver("nothing", {}, &error));
  EXPECT_THAT(error, ::testing::Not(HasSubstr("suma")));
}

TEST(Methods, ThoseOfCloudsAreNotOfMatches) {
  EXPECT_THAT(CloudMethodNames(),
              IsSupersetOf({"quatro_c2f", "icp", "gicp", "vgicp"}));
  for (const std::string& name : CloudMethodNames()) {
    std::string error;
    EXPECT_FALSE(MakeSolver(name, {}, &error)) << name;
    EXPECT_THAT(error, HasSubstr(name + " works on clouds, not on matches"));
    EXPECT_TRUE(FindCloudSolver(name)) << name;
    EXPECT_THAT(DescribeMethods(), HasSubstr(name + " ")) << name;
  }
  for (const std::string& name : MethodNames()) {
    EXPECT_FALSE(FindCloudSolver(name)) << name;
  }
  EXPECT_FALSE(FindCloudSolver("nothing"));
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
        FindCloudSolver(name)(source, target, Rigid3(), options);
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
  for (const std::string& name : CloudMethodNames()) {
    if (IsGlobal(name)) continue;
    const RegistrationSummary summary =
        FindCloudSolver(name)(cloud, cloud, guess, {});
    ASSERT_TRUE(summary.refinement.has_value()) << name << summary.error;
    EXPECT_EQ(summary.refinement->unrefined_target_from_source.ToMatrix(),
              guess.ToMatrix());
    EXPECT_GT(summary.refinement->moved_rotation, 0.01) << name;
  }
}

TEST(Methods, RefinementsAreKnownByTheirNames) {
  for (const char* name : {"none", "icp", "gicp", "vgicp"}) {
    RefinementMethod method{};
    std::string error;
    ASSERT_TRUE(ParseRefinement(name, &method, &error)) << error;
    EXPECT_STREQ(RefinementName(method), name);
  }
  RefinementMethod method{};
  std::string error;
  EXPECT_FALSE(ParseRefinement("GICP", &method, &error));
  EXPECT_THAT(error, HasSubstr("--refine=GICP"));
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
}  // namespace quatro
