// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Real scans: the front end and the solver, compared with known poses.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "features/base/degree.h"
#include "features/base/rigid3.h"
#include "features/io/cloud_io.h"
#include "robust/estimators/quatro.h"
#include "robust/registration/presets.h"
#include "robust/registration/registration.h"
#include "robust/verdict/verdict.h"
#include "tests/support/run_program.h"

namespace quatro::pairs_test {
namespace {

// The success criteria of the registration benchmarks on KITTI.
constexpr double kMaxTranslationError = 0.6;         // [m]
constexpr double kMaxRotationError = 5.0 * kDegree;  // The whole rotation.

std::string DataPath(const std::string& name) {
  return std::string(QUATRO_DATA) + "/" + name;
}

bool Has(const std::string& name) {
  return std::filesystem::exists(DataPath(name));
}

// Columns by name; no cell read here contains a comma.
std::vector<std::map<std::string, std::string>> ReadTable(
    const std::string& name) {
  std::ifstream file(DataPath(name));
  std::vector<std::string> names;
  std::vector<std::map<std::string, std::string>> rows;
  for (std::string line; std::getline(file, line);) {
    std::istringstream cells(line);
    std::vector<std::string> row;
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
    if (names.empty()) {
      names = row;
      continue;
    }
    rows.emplace_back();
    for (std::size_t i = 0; i < names.size() && i < row.size(); ++i) {
      rows.back()[names[i]] = row[i];
    }
  }
  return rows;
}

struct Pair {
  std::string set;
  std::string source;
  std::string target;
  Rigid3 target_from_source;

  double Tilt() const {  // Between the two z axes. [rad]
    return std::acos(target_from_source.rotation(2, 2));
  }
};

std::vector<Pair> ReadPairs() {
  std::vector<Pair> pairs;
  for (const auto& row : ReadTable("pairs.csv")) {
    const auto number = [&](const char* name) {
      return std::stod(row.at(name));
    };
    const Eigen::Quaterniond rotation(
        number("qw"), number("qx"), number("qy"), number("qz"));
    pairs.push_back({row.at("set"),
                     row.at("source"),
                     row.at("target"),
                     {rotation.normalized().toRotationMatrix(),
                      {number("tx"), number("ty"), number("tz")}}});
  }
  return pairs;
}

PointCloud Read(const std::string& name) {
  std::string error;
  const auto cloud = ReadCloud(DataPath(name), &error);
  EXPECT_TRUE(cloud.has_value()) << error;
  return cloud.value_or(PointCloud());
}

RegistrationSummary RegisterFiles(const std::string& source,
                                  const std::string& target) {
  auto options = MakePreset("kitti");
  EXPECT_TRUE(options.has_value());
  options->num_threads = 2;
  return Register(Read(source), Read(target), *options);
}

bool IsWithin(const Rigid3& estimate,
              const Rigid3& truth,
              double max_translation_error,
              double max_rotation_error) {
  return (estimate.translation - truth.translation).norm() <=
             max_translation_error &&
         AngleBetween(estimate.rotation, truth.rotation) <= max_rotation_error;
}

class PairsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!Has("pairs.csv")) GTEST_SKIP() << "needs pairs.csv";
  }
};

// All pairs except the RGB-D pair, which is tilted by 15 degrees and not from a
// vehicle.
TEST_F(PairsTest, FindsAllPosesButTiltedOnes) {
  int num_pairs = 0;
  int num_found = 0;
  int num_registered = 0;
  for (const Pair& pair : ReadPairs()) {
    if (pair.set == "3dmatch_geotransformer") continue;
    const RegistrationSummary summary = RegisterFiles(pair.source, pair.target);
    ASSERT_EQ(summary.error, "");
    ++num_pairs;
    num_registered += summary.verdict.IsRegistered();
    const auto& pose = summary.target_from_source();
    if (pose && IsWithin(*pose,
                         pair.target_from_source,
                         kMaxTranslationError,
                         kMaxRotationError)) {
      ++num_found;
    } else {
      // A yaw cannot be more accurate than the ignored tilt.
      EXPECT_GT(pair.Tilt(), kMaxRotationError)
          << pair.source << " -> " << pair.target << ": "
          << summary.verdict.reason;
    }
  }
  EXPECT_EQ(num_pairs, 47);
  EXPECT_GE(num_found, 45);
  EXPECT_GE(num_registered, 45);
}

// A street scanned again 10 m further on: the uncertainty of the pose is tenths
// of a degree and centimeters, neither zero nor meters.
TEST_F(PairsTest, CovarianceOfARealPairIsPlausible) {
  const std::string source = "kitti_00/000010.bin";
  const std::string target = "kitti_00/000000.bin";
  if (!Has(source) || !Has(target)) GTEST_SKIP() << "needs kitti_00";
  const ProgramRun run = RunProgram(
      "quatro_register",
      {"--source=" + DataPath(source), "--target=" + DataPath(target)});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto report = nlohmann::json::parse(run.out);
  const auto& about = report["covariance_about"];
  ASSERT_FALSE(about.is_null()) << report["unobservable_directions"];
  for (std::size_t i = 0; i < 6; ++i) {
    const double deviation = std::sqrt(about["covariance"][i][i].get<double>());
    EXPECT_GT(deviation, i < 3 ? 1e-5 : 1e-3) << i;
    EXPECT_LT(deviation, i < 3 ? 0.01 : 0.1) << i;
    if (i >= 3) continue;
    // A rotation is the same about any point.
    EXPECT_NEAR(report["covariance"][i][i].get<double>(),
                about["covariance"][i][i].get<double>(),
                1e-9);
  }
  EXPECT_EQ(report["error_radius"]["regime"], "street");
  EXPECT_LT(report["error_radius"]["translation_m"].get<double>(), 0.3);
  EXPECT_LT(report["error_radius"]["rotation_deg"].get<double>(), 1.0);
  EXPECT_GT(report["match_sigma"]["from_residuals"].get<double>(), 0.02);
  EXPECT_LT(report["match_sigma"]["from_residuals"].get<double>(), 0.2);
  EXPECT_GT(
      report["surface_observability"]["weakest_level_share"].get<double>(),
      0.0);
}

TEST_F(PairsTest, DoesNotRegisterDifferentPlaces) {
  if (!Has("pairs_negative.csv")) GTEST_SKIP() << "needs pairs_negative.csv";
  const auto rows = ReadTable("pairs_negative.csv");
  EXPECT_FALSE(rows.empty());
  for (const auto& row : rows) {
    const RegistrationSummary summary =
        RegisterFiles(row.at("source"), row.at("target"));
    EXPECT_FALSE(summary.verdict.IsRegistered())
        << row.at("source") << " -> " << row.at("target") << ": "
        << summary.verdict.reason;
  }
}

TEST_F(PairsTest, ProgramExitsWithOneForDifferentPlaces) {
  if (!Has("pairs_negative.csv")) GTEST_SKIP() << "needs pairs_negative.csv";
  const auto rows = ReadTable("pairs_negative.csv");
  EXPECT_FALSE(rows.empty());
  for (const auto& row : rows) {
    const ProgramRun run =
        RunProgram("quatro_register",
                   {"--source=" + DataPath(row.at("source")),
                    "--target=" + DataPath(row.at("target"))});
    EXPECT_EQ(run.exit_code, 1) << run.err;
    EXPECT_NE(nlohmann::json::parse(run.out)["status"], "registered");
  }
}

// Registering in both directions moves the matched points by at most twice the
// noise bound per axis, because each direction is within one bound of its
// inliers. The motion is measured at the points, as a root mean square, and not
// as the translation: that is the motion of the origin, where a rotation error
// is multiplied by the distance of the points.
TEST_F(PairsTest, SwappedScansGiveTheInverse) {
  constexpr double kNoiseBound = 0.3;  // [m], of preset kitti.
  const std::vector<std::pair<std::string, std::string>> pairs = {
      {"kitti_00/000010.bin", "kitti_00/000000.bin"},
      {"kitti_07_submap/000003.bin", "kitti_07_submap/000000.bin"},
      {"kitti_10m_turboreg/060_pts_src.ply",
       "kitti_10m_turboreg/060_pts_dst.ply"}};
  for (const auto& [source, target] : pairs) {
    const RegistrationSummary forth = RegisterFiles(source, target);
    const RegistrationSummary back = RegisterFiles(target, source);
    ASSERT_TRUE(forth.verdict.IsRegistered()) << forth.verdict.reason;
    ASSERT_TRUE(back.verdict.IsRegistered()) << back.verdict.reason;
    const Rigid3 round_trip =
        *back.target_from_source() * *forth.target_from_source();
    const Points inliers =
        forth.matched_source(Eigen::all, forth.solution.translation_inliers);
    const Points moved = round_trip.Apply(inliers) - inliers;
    const Eigen::Vector3d rms = moved.rowwise().squaredNorm().cwiseSqrt() /
                                std::sqrt(static_cast<double>(moved.cols()));
    EXPECT_LE(rms.maxCoeff(), 2.0 * kNoiseBound) << source;
    EXPECT_LE(AngleBetween(round_trip.rotation, Eigen::Matrix3d::Identity()),
              kMaxRotationError)
        << source;
  }
}

// Published FPFH matches of other authors, with 97 to 99 % outliers.
class PublishedMatchesTest : public ProgramTest {
 protected:
  // Joins two files of x y z per line into one with six columns.
  std::string Zip(const std::string& source, const std::string& target) const {
    std::ifstream source_file(DataPath(source));
    std::ifstream target_file(DataPath(target));
    std::string text;
    std::string target_line;
    for (std::string line; std::getline(source_file, line) &&
                           std::getline(target_file, target_line);) {
      text += line + " " + target_line + "\n";
    }
    return Write("matches.csv", text);
  }
};

TEST_F(PublishedMatchesTest, QuatroSolveFindsThePoses) {
  if (!Has("pairs.csv")) GTEST_SKIP() << "needs pairs.csv";
  if (!Has("kitti_10m_turboreg")) GTEST_SKIP() << "needs kitti_10m_turboreg";
  int num_pairs = 0;
  for (const Pair& pair : ReadPairs()) {
    if (pair.set != "kitti_10m_fpfh_corr") continue;
    const std::string stem =
        pair.source.substr(0, pair.source.find("_pts_src"));
    const std::string matches =
        Zip(stem + "_fpfh_kpts_src.txt", stem + "_fpfh_kpts_dst.txt");
    const ProgramRun run =
        RunProgram("quatro_solve", {"--correspondences=" + matches});
    ASSERT_THAT(run.exit_code, ::testing::AnyOf(0, 1)) << run.err;
    const auto report = nlohmann::json::parse(run.out);
    ASSERT_FALSE(report["target_from_source"].is_null()) << stem;
    Rigid3 pose;
    for (int row = 0; row < 3; ++row) {
      const auto numbers = report["target_from_source"]
                               .at(static_cast<std::size_t>(row))
                               .get<std::vector<double>>();
      for (int column = 0; column < 3; ++column) {
        pose.rotation(row, column) = numbers[static_cast<std::size_t>(column)];
      }
      pose.translation[row] = numbers[3];
    }
    EXPECT_TRUE(IsWithin(
        pose, pair.target_from_source, kMaxTranslationError, kMaxRotationError))
        << stem << ": off by "
        << (pose.translation - pair.target_from_source.translation).norm()
        << " m, "
        << AngleBetween(pose.rotation, pair.target_from_source.rotation) /
               kDegree
        << " deg; " << report["reason"];
    ++num_pairs;
  }
  EXPECT_EQ(num_pairs, 6);
}

}  // namespace
}  // namespace quatro::pairs_test
