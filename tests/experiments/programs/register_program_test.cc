// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Runs quatro_register as a program.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/programs/picture.h"
#include "experiments/report/report_template.h"
#include "features/base/random.h"
#include "features/base/rigid3.h"
#include "features/io/cloud_io.h"
#include "features/io/point_cloud.h"
#include "tests/support/matchers.h"
#include "tests/support/random_problems.h"
#include "tests/support/run_program.h"

namespace quatro::register_program_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

struct Box {
  Eigen::Vector3d corner;
  Eigen::Vector3d size;
  double yaw;
};

// A floor of 12 m x 12 m with seven boxes of different sizes and headings,
// sampled at random, with 5 mm of noise.
Points RandomYard(Eigen::Index n, std::uint64_t seed) {
  const std::array<Box, 7> boxes = {{{{-4.5, -4.0, 0}, {1.0, 0.6, 1.1}, 0.3},
                                     {{3.0, -4.5, 0}, {0.5, 1.7, 0.7}, 1.1},
                                     {{4.0, 3.5, 0}, {0.8, 0.8, 2.0}, 0.6},
                                     {{-3.0, 3.0, 0}, {2.2, 0.4, 1.4}, -0.4},
                                     {{0.5, 1.5, 0}, {0.3, 0.5, 0.9}, 0.0},
                                     {{1.0, -2.0, 0}, {1.3, 1.1, 0.4}, -0.8},
                                     {{-1.5, -0.5, 0}, {0.4, 0.4, 1.7}, 0.2}}};
  Random random(seed);
  Points yard(3, n);
  for (auto point : yard.colwise()) {
    const double u = random.Uniform();
    const double v = random.Uniform();
    if (random.Uniform() < 0.6) {
      point << 12.0 * u - 6.0, 12.0 * v - 6.0, 0.0;
    } else {
      const Box& box = boxes[random.Below(boxes.size())];
      const auto axis = static_cast<Eigen::Index>(random.Below(3));
      Eigen::Vector3d at(u, v, random.Uniform());
      at[axis] = random.Below(2) == 0 ? 0.0 : 1.0;
      point = box.corner + RotationZ(box.yaw) * at.cwiseProduct(box.size);
    }
    for (double& coordinate : point) coordinate += 0.005 * RandomNormal(random);
  }
  return yard;
}

const Rigid3& TruePose() {
  static const Rigid3 pose = {RotationZ(1.9), {1.2, -0.7, 0.1}};
  return pose;
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

class RegisterProgramTest : public ProgramTest {
 protected:
  std::string WritePoints(const std::string& name, const Points& points) const {
    PointCloud cloud;
    cloud.points = points;
    std::string error;
    EXPECT_TRUE(WriteCloud(cloud, PathOf(name), &error)) << error;
    return PathOf(name);
  }

  // Two scans of the yard without common points.
  void WriteYard(
      const Eigen::Vector3d& offset = Eigen::Vector3d::Zero()) const {
    WritePoints("source.ply", RandomYard(40000, 1).colwise() + offset);
    WritePoints("target.ply",
                TruePose().Apply(RandomYard(40000, 2)).colwise() + offset);
  }

  ProgramRun Register(const std::vector<std::string>& flags) const {
    std::vector<std::string> args = {"--source=" + PathOf("source.ply"),
                                     "--target=" + PathOf("target.ply"),
                                     "--preset=indoor"};
    args.insert(args.end(), flags.begin(), flags.end());
    return RunProgram("quatro_register", args);
  }

  // Neither cloud has features.
  void ExpectInsufficient(const Points& points) const {
    WritePoints("source.ply", points);
    WritePoints("target.ply", points);
    const ProgramRun run = Register({});
    EXPECT_EQ(run.exit_code, 1) << run.err;
    const json report = json::parse(run.out);
    EXPECT_EQ(report["status"], "insufficient");
    EXPECT_TRUE(report["target_from_source"].is_null());
  }

  // As source and as target.
  void ExpectRefused(const std::string& name,
                     const std::string& bytes,
                     const std::string& why) const {
    const std::string bad = Write(name, bytes);
    const std::string good = WritePoints("good.ply", Points::Random(3, 100));
    ExpectBadInput("quatro_register",
                   {"--source=" + bad, "--target=" + good},
                   bad + ": ",
                   why);
    ExpectBadInput("quatro_register",
                   {"--source=" + good, "--target=" + bad},
                   bad + ": ",
                   why);
  }

  // An invalid flag, with everything else valid.
  void ExpectRefusedFlag(const std::string& flag,
                         const std::string& what,
                         const std::string& why) const {
    const std::string good = WritePoints("good.ply", Points::Random(3, 100));
    ExpectBadInput("quatro_register",
                   {"--source=" + good, "--target=" + good, flag},
                   what,
                   why);
  }
};

// Bad input

TEST_F(RegisterProgramTest, NoFiles) {
  ExpectBadInput("quatro_register", {}, "--source", "is empty");
}

TEST_F(RegisterProgramTest, NoTarget) {
  ExpectBadInput("quatro_register",
                 {"--source=" + WritePoints("a.ply", Points::Random(3, 9))},
                 "--target",
                 "is empty");
}

TEST_F(RegisterProgramTest, MissingFile) {
  const std::string path = PathOf("none.bin");
  ExpectBadInput("quatro_register",
                 {"--source=" + path, "--target=" + path},
                 path,
                 "No such file or directory");
}

TEST_F(RegisterProgramTest, Folder) {
  const std::string path = PathOf("a.bin");
  std::filesystem::create_directory(path);
  ExpectBadInput("quatro_register",
                 {"--source=" + path, "--target=" + path},
                 path,
                 "is a directory");
}

TEST_F(RegisterProgramTest, EmptyBin) { ExpectRefused("a.bin", "", "empty"); }

TEST_F(RegisterProgramTest, EmptyPly) { ExpectRefused("a.ply", "", ""); }

TEST_F(RegisterProgramTest, EmptyPcd) { ExpectRefused("a.pcd", "", ""); }

TEST_F(RegisterProgramTest, TruncatedBin) {
  ExpectRefused("a.bin", std::string(50, '\1'), "is not a multiple of 16");
}

TEST_F(RegisterProgramTest, TruncatedPly) {
  ExpectRefused("a.ply",
                "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                "property float y\nproperty float z\nend_header\n1 2 3\n",
                "3");
}

TEST_F(RegisterProgramTest, PcdOfUnknownData) {
  ExpectRefused("a.pcd",
                "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\n"
                "COUNT 1 1 1\nWIDTH 1\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\n"
                "POINTS 1\nDATA morse\n1 2 3\n",
                "DATA");
}

TEST_F(RegisterProgramTest, UnknownEnding) {
  ExpectRefused("a.las", "1 2 3\n", "ending '.las'");
}

TEST_F(RegisterProgramTest, AllNan) {
  ExpectRefused("a.ply",
                "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\n"
                "property float y\nproperty float z\nend_header\n"
                "nan nan nan\n1 nan 2\n",
                "none of 2 is finite");
}

TEST_F(RegisterProgramTest, CloudTooWideForItsVoxels) {
  Points points = Points::Random(3, 100);
  points(0, 0) = 1e12;
  const std::string path = WritePoints("a.ply", points);
  ExpectBadInput("quatro_register",
                 {"--source=" + path, "--target=" + path},
                 "voxel",
                 "m wide");
}

TEST_F(RegisterProgramTest, UnknownFlag) {
  ExpectRefusedFlag("--colour=red", "colour", "unknown");
}

TEST_F(RegisterProgramTest, TextForANumber) {
  ExpectRefusedFlag("--voxel_size=small", "voxel_size", "small");
}

TEST_F(RegisterProgramTest, NegativeVoxelSize) {
  ExpectRefusedFlag("--voxel_size=-1", "--voxel_size=-1", "must be > 0");
}

TEST_F(RegisterProgramTest, NegativeNoiseBound) {
  ExpectRefusedFlag("--noise_bound=-1", "--noise_bound=-1", "must be > 0");
}

TEST_F(RegisterProgramTest, NanNoiseBound) {
  ExpectRefusedFlag("--noise_bound=nan", "--noise_bound=nan", "must be > 0");
}

TEST_F(RegisterProgramTest, DescriptorsNarrowerThanNormals) {
  ExpectRefusedFlag("--fpfh_radius=0.1", "fpfh_radius", "normal_radius");
}

TEST_F(RegisterProgramTest, DescriptorsOfTheWholeCloud) {
  ExpectRefusedFlag(
      "--fpfh_radius=1e300", "--fpfh_radius=1e+300", "must be <=");
}

TEST_F(RegisterProgramTest, AnOptionIsGivenOnce) {
  ExpectRefusedFlag("--options=noise_bound=0.3;noise_bound=0.4",
                    "noise_bound",
                    "is given twice");
}

TEST_F(RegisterProgramTest, MatchesAreNoCloud) {
  ExpectRefused("matches.csv",
                "sx,sy,sz,tx,ty,tz\n1,2,3,4,5,6\n",
                "has the columns of matches");
}

TEST_F(RegisterProgramTest, PointFloatsAreOfABin) {
  const std::string path = Write("a.xyz", "1 2 3\n4 5 6\n");
  ExpectBadInput("quatro_register",
                 {"--source=" + path, "--target=" + path, "--point_floats=5"},
                 "--point_floats",
                 "neither cloud is one");
}

TEST_F(RegisterProgramTest, UnknownPreset) {
  ExpectRefusedFlag("--preset=moon",
                    "--preset=moon, must be one of kitti, paper, ",
                    "indoor, auto\n");
}

TEST_F(RegisterProgramTest, UnknownMethod) {
  ExpectRefusedFlag("--method=magic", "--method=magic", "must be");
}

TEST_F(RegisterProgramTest, AnOdometryIsOfAnotherProgram) {
  ExpectRefusedFlag("--method=aloam", "--method=aloam", "quatro_odometry");
}

TEST_F(RegisterProgramTest, UnknownRefinement) {
  ExpectRefusedFlag("--refine=best", "--refine=best", "none, icp, gicp");
}

TEST_F(RegisterProgramTest, StrayArgument) {
  ExpectRefusedFlag("stray", "stray", "not a flag");
}

TEST_F(RegisterProgramTest, AFileWithoutItsFlag) {
  const std::string path = WritePoints("a.ply", Points::Random(3, 9));
  ExpectBadInput(
      "quatro_register", {path}, "not a flag", "--source=" + path + ";");
  ExpectBadInput("quatro_register",
                 {"--source=" + path, path},
                 "not a flag",
                 "--target=" + path + ";");
}

TEST_F(RegisterProgramTest, MissingOutputFolder) {
  for (const std::string flag :
       {"json", "picture", "report", "correspondences_out"}) {
    ExpectRefusedFlag("--" + flag + "=" + PathOf("none/a"),
                      PathOf("none/a"),
                      "there is no folder");
  }
}

TEST_F(RegisterProgramTest, OutputOntoAFolder) {
  for (const std::string flag :
       {"json", "picture", "report", "correspondences_out"}) {
    ExpectRefusedFlag(
        "--" + flag + "=" + PathOf(""), PathOf(""), "is a directory");
  }
}

TEST_F(RegisterProgramTest, AFlagOfSolveIsToldAsSuch) {
  ExpectRefusedFlag("--correspondences=a.csv",
                    "has no flag --correspondences",
                    "it is one of quatro_solve's");
  ExpectRefusedFlag("--tuple_test=off", "--tuple_test", "is an option");
}

TEST_F(RegisterProgramTest, ListsTheMethodsThatItTakes) {
  const std::string list =
      RunProgram("quatro_register", {"--list_methods"}).out;
  for (const char* method : {"quatro_ins ", "quatro_c2f ", "vgicp "}) {
    EXPECT_THAT(list, HasSubstr(method));
  }
  EXPECT_THAT(list, Not(HasSubstr("aloam")));
  EXPECT_THAT(list, Not(HasSubstr("suma")));
}

// Where the vertical cannot come from the scans.
TEST_F(RegisterProgramTest, AVerticalByScansMustHaveAnEffect) {
  WriteYard();
  for (const std::string flag : {"--method=teaser",
                                 "--method=quatro_single",
                                 "--preset=paper",
                                 "--options=max_rung=0",
                                 "--max_yaw_deg=30"}) {
    const ProgramRun run = Register({"--gravity=scans", flag});
    EXPECT_EQ(run.exit_code, 2) << flag;
    EXPECT_THAT(run.err, HasSubstr("--gravity=scans has no effect here"));
  }
  EXPECT_EQ(Register({"--gravity=scans"}).exit_code, 0);
  // Not asked for: the default of auto.
  const ProgramRun of_auto = Register({"--preset=auto", "--method=teaser"});
  EXPECT_NE(of_auto.exit_code, 2) << of_auto.err;
}

// Too little data

TEST_F(RegisterProgramTest, OnePointIsInsufficient) {
  ExpectInsufficient(Points::Ones(3, 1));
}

TEST_F(RegisterProgramTest, TwoPointsAreInsufficient) {
  ExpectInsufficient((Points(3, 2) << 1, 4, 2, 5, 3, 6).finished());
}

TEST_F(RegisterProgramTest, IdenticalPointsAreInsufficient) {
  ExpectInsufficient(Points::Ones(3, 1000));
}

TEST_F(RegisterProgramTest, ABareFloorIsNotRegistered) {
  Points floor = 12.0 * Points::Random(3, 20000);
  floor.row(2).setZero();
  WritePoints("source.ply", floor);
  floor = 12.0 * Points::Random(3, 20000);
  floor.row(2).setZero();
  WritePoints("target.ply", floor);
  const ProgramRun run = Register({});
  EXPECT_EQ(run.exit_code, 1) << run.out;
  EXPECT_THAT(run.err, Not(HasSubstr("units")));
}

TEST_F(RegisterProgramTest, UnitsThatDifferAreHintedAt) {
  WriteYard();
  WritePoints("source.ply", 1000.0 * RandomYard(40000, 1));
  const ProgramRun run = Register({});
  EXPECT_EQ(run.exit_code, 1) << run.err;
  EXPECT_THAT(run.err, HasSubstr("their units may differ; convert both"));
  EXPECT_EQ(run.err.find("m wide"), run.err.rfind("m wide")) << run.err;
}

// Two scans of the same place

TEST_F(RegisterProgramTest, FindsThePose) {
  WriteYard();
  const ProgramRun run = Register({});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const json report = json::parse(run.out);
  EXPECT_EQ(report["status"], "registered");
  const Rigid3 pose = PoseOf(report);
  EXPECT_THAT(Yaw(pose.rotation), IsAngleNear(1.9, 1.0 * M_PI / 180.0));
  EXPECT_LT((pose.translation - TruePose().translation).norm(), 0.1);
  EXPECT_THAT(report["yaw_deg"].get<double>() * M_PI / 180.0,
              IsAngleNear(Yaw(pose.rotation), 1e-12));
  EXPECT_EQ(report["counts"]["source_points"], 40000);
  EXPECT_EQ(report["parameters"]["voxel_size"], 0.1);
}

// There are fewer matches than near the origin, where the sensor is assumed to
// be: seen from afar, the normals of two scans are no longer oriented
// consistently.
TEST_F(RegisterProgramTest, FindsThePoseFarFromTheOrigin) {
  const Eigen::Vector3d offset(1e7, -1e7, 100.0);
  WriteYard(offset);
  const ProgramRun run = Register({});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const Rigid3 pose = PoseOf(json::parse(run.out));
  EXPECT_THAT(Yaw(pose.rotation), IsAngleNear(1.9, 2.0 * M_PI / 180.0));
  // Measured at the points: at the origin, a hundredth of a degree is 2 km.
  EXPECT_LT((pose * offset - (TruePose().translation + offset)).norm(), 0.2);
}

TEST_F(RegisterProgramTest, RefinesThePoseAndSaysByHowMuch) {
  WriteYard();
  const json plain = json::parse(Register({}).out);
  EXPECT_TRUE(plain["refinement"].is_null());
  const ProgramRun run = Register({"--refine=gicp"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const json report = json::parse(run.out);
  const json& refinement = report["refinement"];
  EXPECT_EQ(refinement["method"], "gicp");
  EXPECT_EQ(refinement["accepted"], true) << refinement["message"];
  EXPECT_EQ(refinement["termination"], "converged");
  EXPECT_GT(refinement["inliers"], 1000);
  EXPECT_GT(refinement["iterations"], 0);
  EXPECT_GT(refinement["moved_m"], 0.0);
  EXPECT_GT(refinement["moved_deg"], 0.0);
  EXPECT_EQ(refinement["unrefined_target_from_source"],
            plain["target_from_source"]);
  EXPECT_GT(report["timings_ms"]["refinement"], 0.0);
  EXPECT_LE((PoseOf(report).translation - TruePose().translation).norm(), 0.05);

  const json c2f = json::parse(Register({"--method=quatro_c2f"}).out);
  EXPECT_EQ(c2f["target_from_source"], report["target_from_source"]);
}

// The true pose is 109 deg from the identity.
TEST_F(RegisterProgramTest, LocalMethodsDoNotVouchForWhatTheyFind) {
  WriteYard();
  for (const std::string method : {"icp", "gicp", "vgicp"}) {
    const ProgramRun run = Register({"--method=" + method});
    EXPECT_EQ(run.exit_code, 1) << run.err;
    EXPECT_EQ(json::parse(run.out)["refinement"]["method"], method);
    EXPECT_FALSE(json::parse(run.out)["counts"].contains("mutual_matches"));
    const ProgramRun explained = Register({"--method=" + method, "--explain"});
    for (const char* of_matches : {"FPFH", "consensus", "matches:", "radii"}) {
      EXPECT_THAT(explained.err + explained.out, Not(HasSubstr(of_matches)));
    }
    ExpectBadInput("quatro_register",
                   {"--source=" + PathOf("source.ply"),
                    "--target=" + PathOf("target.ply"),
                    "--method=" + method,
                    "--refine=icp"},
                   "--refine",
                   "--method=" + method);
  }
}

TEST_F(RegisterProgramTest, LocalMethodsStartFromTheGuess) {
  WriteYard();
  for (const std::string method : {"icp", "gicp"}) {
    const ProgramRun run =
        Register({"--method=" + method, "--guess=1.1,-0.6,0.1,107"});
    const json report = json::parse(run.out);
    ASSERT_FALSE(report["target_from_source"].is_null()) << run.err;
    EXPECT_LT((PoseOf(report).ToMatrix() - TruePose().ToMatrix()).norm(), 0.1);
    const ProgramRun bounded = Register(
        {"--method=" + method, "--max_translation=0.1", "--max_yaw_deg=1"});
    EXPECT_EQ(bounded.exit_code, 1);
    EXPECT_TRUE(json::parse(bounded.out)["target_from_source"].is_null());
  }
}

// A flag that is not given changes nothing of the preset.
TEST_F(RegisterProgramTest, TheRefinementIsThePresetsUnlessGiven) {
  WriteYard();
  const json of_auto = json::parse(Register({"--preset=auto"}).out);
  EXPECT_EQ(of_auto["refinement"]["method"], "vgicp");
  const json none =
      json::parse(Register({"--preset=auto", "--refine=none"}).out);
  EXPECT_TRUE(!none.contains("refinement") || none["refinement"].is_null());
}

TEST_F(RegisterProgramTest, BoundsDecideWhereThePoseMayBe) {
  WriteYard();
  const std::vector<std::string> around = {
      "--guess=1.1,-0.6,0.1,107", "--max_translation=1", "--max_yaw_deg=10"};
  const ProgramRun near = Register(around);
  EXPECT_EQ(near.exit_code, 0) << near.err;
  EXPECT_LT(
      (PoseOf(json::parse(near.out)).ToMatrix() - TruePose().ToMatrix()).norm(),
      0.1);
  const ProgramRun far = Register({"--max_yaw_deg=30"});
  EXPECT_EQ(far.exit_code, 1);
  EXPECT_NE(json::parse(far.out)["status"], "registered");
}

TEST_F(RegisterProgramTest, OutputIsTheSourceInTheTargetsFrame) {
  WriteYard();
  const ProgramRun run = Register({"--output=" + PathOf("aligned.ply")});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  std::string error;
  const auto source = ReadCloud(PathOf("source.ply"), &error);
  const auto aligned = ReadCloud(PathOf("aligned.ply"), &error);
  ASSERT_TRUE(source && aligned) << error;
  EXPECT_TRUE(aligned->points.isApprox(
      PoseOf(json::parse(run.out)).Apply(source->points), 1e-9));
}

TEST_F(RegisterProgramTest, NoPoseNoOutput) {
  WritePoints("source.ply", Points::Ones(3, 1));
  WritePoints("target.ply", Points::Ones(3, 1));
  const ProgramRun run = Register({"--output=" + PathOf("aligned.ply")});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.err,
              HasSubstr("aligned.ply: not written, because there is "
                        "no pose"));
  EXPECT_EQ(Contents().size(), 2u);
}

TEST_F(RegisterProgramTest, OutputsThatCannotBeAreRefused) {
  ExpectRefusedFlag("--output=-", "--output=-", "name a .bin, .ply or .pcd");
  ExpectRefusedFlag("--output=a.txt", "--output=a.txt", "'.txt'");
  ExpectRefusedFlag("--output_clouds=both", "--output_clouds", "no effect");
  ExpectRefusedFlag("--report=-", "--json and --report", "name a file");
}

TEST_F(RegisterProgramTest, ThreadsChangeNothing) {
  WriteYard();
  const std::string matches = "--correspondences_out=" + PathOf("matches.csv");
  const ProgramRun one = Register({"--threads=1", matches});
  const std::string matches_of_one = Read("matches.csv");
  for (const char* threads : {"--threads=2", "--threads=3"}) {
    const ProgramRun many = Register({threads, matches});
    EXPECT_EQ(WithoutTimings(many.out), WithoutTimings(one.out));
    EXPECT_EQ(Read("matches.csv"), matches_of_one);
  }
}

TEST_F(RegisterProgramTest, JsonGoesToAFileInstead) {
  WriteYard();
  const ProgramRun to_file = Register({"--json=" + PathOf("a.json")});
  EXPECT_EQ(to_file.exit_code, 0);
  EXPECT_EQ(to_file.out, "");
  EXPECT_EQ(WithoutTimings(Read("a.json")), WithoutTimings(Register({}).out));
  EXPECT_EQ(Contents().size(), 3u);
}

TEST_F(RegisterProgramTest, SolvingTheMatchesGivesTheSamePose) {
  WriteYard();
  const ProgramRun whole =
      Register({"--correspondences_out=" + PathOf("matches.csv")});
  const ProgramRun solved = RunProgram(
      "quatro_solve",
      {"--correspondences=" + PathOf("matches.csv"), "--preset=indoor"});
  EXPECT_EQ(solved.exit_code, 0) << solved.err;
  EXPECT_EQ(json::parse(solved.out)["target_from_source"].dump(),
            json::parse(whole.out)["target_from_source"].dump());
}

TEST_F(RegisterProgramTest, PictureIsAPng) {
  std::string error;
  if (!CanDrawPictures(&error)) GTEST_SKIP() << "needs matplotlib: " << error;
  WriteYard();
  const ProgramRun run = Register({"--picture=" + PathOf("a.png")});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(Read("a.png"), StartsWith(kPngSignature));
  EXPECT_EQ(Contents().size(), 3u);
}

TEST_F(RegisterProgramTest, ReportHoldsThePairAndItsPose) {
  std::string error;
  if (!ReadReportTemplate(&error)) GTEST_SKIP() << error;
  WriteYard();
  const ProgramRun run = Register({"--report=" + PathOf("a.html")});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const std::string page = Read("a.html");
  EXPECT_THAT(page, StartsWith("<!DOCTYPE html>"));
  const std::string mark = "id=\"view-0\">";
  const std::size_t begin = page.find(mark) + mark.size();
  const json view =
      json::parse(page.substr(begin, page.find("</script>", begin) - begin));
  EXPECT_EQ(view["methods"][0]["pose"].dump(),
            json::parse(run.out)["target_from_source"].dump());
  EXPECT_EQ(Contents().size(), 3u);
}

TEST_F(RegisterProgramTest, ReportOfNoAnswerIsAPageToo) {
  std::string error;
  if (!ReadReportTemplate(&error)) GTEST_SKIP() << error;
  WritePoints("source.ply", Points::Ones(3, 5));
  WritePoints("target.ply", Points::Ones(3, 5));
  const ProgramRun run = Register({"--report=" + PathOf("a.html")});
  EXPECT_EQ(run.exit_code, 1) << run.err;
  EXPECT_THAT(Read("a.html"), HasSubstr("\"pose\":null"));
}

}  // namespace
}  // namespace quatro::register_program_test
