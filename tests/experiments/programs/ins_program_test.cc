// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The flags of the INS, tested through the programs.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/programs/matches_csv.h"
#include "features/base/degree.h"
#include "features/base/rigid3.h"
#include "features/io/cloud_io.h"
#include "features/io/point_cloud.h"
#include "solvers/closed_form/gravity.h"
#include "tests/support/matched_problems.h"
#include "tests/support/random_problems.h"
#include "tests/support/run_program.h"

namespace quatro::ins_program_test {
namespace {

using nlohmann::json;

Eigen::Matrix3d RotationOf(const json& report) {
  Eigen::Matrix3d rotation;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      rotation(static_cast<int>(row), static_cast<int>(column)) =
          report.at("target_from_source").at(row).at(column).get<double>();
    }
  }
  return rotation;
}

// A source rolled by 10 deg and pitched by -5 deg, and a level target.
class InsProgramTest : public ProgramTest {
 protected:
  InsProgramTest() {
    KnownProblem problem = MakeMatchedProblem({.num_inliers = 80}, 1);
    const Eigen::Matrix3d level_from_source =
        LevelFromBody(10.0 * kDegree, -5.0 * kDegree);
    problem.source = (level_from_source.transpose() * problem.source).eval();
    true_rotation_ =
        problem.true_target_from_source.rotation * level_from_source;
    path_ = Write("a.csv", FormatMatches(problem.source, problem.target));
  }

  std::vector<std::string> Args(const std::vector<std::string>& flags) const {
    std::vector<std::string> args = {"--correspondences=" + path_,
                                     "--method=quatro"};
    args.insert(args.end(), flags.begin(), flags.end());
    return args;
  }

  void ExpectRefused(const std::vector<std::string>& flags,
                     const std::string& what,
                     const std::string& why) const {
    ExpectBadInput("quatro_solve", Args(flags), what, why);
    std::vector<std::string> args = flags;
    args.insert(args.begin(), {"--source=none.bin", "--target=none.bin"});
    ExpectBadInput("quatro_register", args, what, why);
  }

  json Solve(const std::vector<std::string>& flags) const {
    const ProgramRun run = RunProgram("quatro_solve", Args(flags));
    EXPECT_NE(run.exit_code, 2) << run.err;
    return json::parse(run.out, nullptr, false);
  }

  double RotationErrorDeg(const json& report) const {
    return AngleBetween(RotationOf(report), true_rotation_) / kDegree;
  }

  const std::vector<std::string> attitudes_ = {"--source_rpy_deg=10,-5,0",
                                               "--target_rpy_deg=0,0,0"};

 private:
  std::string path_;
  Eigen::Matrix3d true_rotation_;
};

TEST_F(InsProgramTest, AllWaysFindTheTiltedPose) {
  for (const std::string mode : {"relative", "leveled", "fused"}) {
    for (const std::string method :
         {"auto", "quatro", "quatro_exact", "quatro_ins"}) {
      std::vector<std::string> flags = attitudes_;
      flags.insert(
          flags.end(),
          {"--ins_mode=" + mode, "--method=" + method, "--polish=off"});
      const json report = Solve(flags);
      EXPECT_EQ(report["status"], "registered") << mode;
      EXPECT_LT(RotationErrorDeg(report), 0.3) << mode;
      EXPECT_EQ(report["parameters"]["ins_mode"], mode);
      EXPECT_NEAR(report["parameters"]["source_rpy"][1].get<double>(),
                  -5.0 * M_PI / 180.0,
                  1e-12);
      EXPECT_NEAR(report["parameters"]["attitude_std"].get<double>(),
                  0.5 * M_PI / 180.0,
                  1e-12);
    }
  }
}

TEST_F(InsProgramTest, NoneIsPlainQuatro) {
  EXPECT_GT(RotationErrorDeg(Solve({"--polish=off"})), 5.0);
}

TEST_F(InsProgramTest, UnknownMode) {
  ExpectRefused({"--ins_mode=magic"}, "--ins_mode=magic", "must be none");
}

TEST_F(InsProgramTest, AttitudeThatIsNotThreeNumbers) {
  for (const std::string text :
       {"1,2", "1,2,3,4", "1,2,x", "1,2,nan", "1;2;3"}) {
    ExpectRefused({"--ins_mode=leveled",
                   "--source_rpy_deg=" + text,
                   "--target_rpy_deg=0,0,0"},
                  "--source_rpy_deg=" + text,
                  "must be three numbers");
  }
}

TEST_F(InsProgramTest, MissingAttitude) {
  ExpectRefused({"--ins_mode=fused", "--source_rpy_deg=1,2,3"},
                "--target_rpy_deg is empty",
                "--ins_mode=fused needs it");
}

TEST_F(InsProgramTest, AttitudeThatWouldBeIgnored) {
  ExpectRefused(
      {"--target_rpy_deg=1,2,3"}, "--target_rpy_deg", "--ins_mode is none");
}

TEST_F(InsProgramTest, StandardDeviationOutOfRange) {
  for (const std::string text : {"0", "-1", "nan", "inf"}) {
    ExpectRefused({"--ins_std_deg=" + text}, "--ins_std_deg", "must be in");
  }
}

TEST_F(InsProgramTest, GravityWithoutDirection) {
  for (const std::string text : {"0,0,0", "0,1", "up", "inf,0,0", ""}) {
    ExpectRefused({"--gravity=" + text},
                  "--gravity=" + text,
                  "must be scans, none or three");
  }
}

TEST_F(InsProgramTest, MethodThatNeedsAnIns) {
  for (const std::string gravity : {"0,0,1", "1,0,0"}) {
    ExpectRefused({"--method=quatro_ins", "--gravity=" + gravity},
                  "--method=quatro_ins needs an INS: set --ins_mode",
                  "--source_rpy_deg and --target_rpy_deg");
  }
}

TEST_F(InsProgramTest, MethodWithoutIns) {
  std::vector<std::string> flags = attitudes_;
  flags.insert(flags.end(), {"--ins_mode=leveled", "--method=teaser"});
  ExpectRefused(flags, "ins_mode", "needs one of the methods auto, quatro");
  ExpectRefused({"--gravity=1,0,0", "--method=teaser"},
                "gravity",
                "needs one of the methods auto, quatro");
}

// Two scans of a street corner, the source rolled by 12 deg and the target
// pitched by -3 deg, with x up.
TEST_F(InsProgramTest, RegistersTiltedScansInAnyAxes) {
  const Rigid3 true_pose{RotationZ(0.7), {1.0, -0.8, 0.1}};
  const Eigen::Matrix3d level_from_source = LevelFromBody(12.0 * kDegree, 0.0);
  const Eigen::Matrix3d level_from_target = LevelFromBody(0.0, -3.0 * kDegree);
  const Eigen::Matrix3d axes =
      RotationBetween(Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX());
  const auto write = [&](const std::string& name,
                         const Eigen::Matrix3d& level_from_body,
                         const Points& level) {
    PointCloud cloud;
    cloud.points = axes * level_from_body.transpose() * level;
    std::string error;
    EXPECT_TRUE(WriteCloud(cloud, PathOf(name), &error)) << error;
    return PathOf(name);
  };
  const std::vector<std::string> args = {
      "--source=" + write("a.ply",
                          level_from_source,
                          Inverse(true_pose).Apply(
                              RandomStreet(12000, 0.01, /*seed=*/1))),
      "--target=" + write("b.ply",
                          level_from_target,
                          RandomStreet(12000, 0.01, /*seed=*/2)),
      "--preset=kitti",
      "--polish=off",
      "--gravity=2,0,0"};
  const Eigen::Matrix3d expected = axes * level_from_target.transpose() *
                                   true_pose.rotation * level_from_source *
                                   axes.transpose();
  const auto error_deg = [&](const std::vector<std::string>& flags) {
    std::vector<std::string> all = args;
    all.insert(all.end(), flags.begin(), flags.end());
    const ProgramRun run = RunProgram("quatro_register", all);
    const json report = json::parse(run.out, nullptr, false);
    EXPECT_TRUE(report.is_object()) << run.err;
    if (!report.is_object() || report["target_from_source"].is_null()) {
      return 180.0;
    }
    return AngleBetween(RotationOf(report), expected) / kDegree;
  };
  const std::vector<std::string> ins = {"--source_rpy_deg=12,0,0",
                                        "--target_rpy_deg=0,-3,0"};
  for (const std::string mode : {"leveled", "fused"}) {
    for (const std::string method : {"quatro", "quatro_ins", "arc_consensus"}) {
      EXPECT_LT(
          error_deg(
              {"--ins_mode=" + mode, "--method=" + method, ins[0], ins[1]}),
          1.0)
          << mode << ", " << method;
    }
  }
  EXPECT_GT(error_deg({"--method=quatro_single"}), 10.0);
  // The search finds the tilt by itself.
  EXPECT_LT(error_deg({}), 1.0);
}

}  // namespace
}  // namespace quatro::ins_program_test
