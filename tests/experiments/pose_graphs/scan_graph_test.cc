// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Real scans of three places, registered pairwise and combined in one pose
// graph.

#include "experiments/pose_graphs/scan_graph.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "experiments/pose_graphs/g2o.h"
#include "experiments/pose_graphs/pose_graph_problem.h"
#include "features/base/degree.h"
#include "features/io/cloud_io.h"
#include "robust/registration/presets.h"
#include "tests/support/run_program.h"

namespace quatro::scan_graph_test {
namespace {

// The first six and the last are one place, 88 and 95 are another one 60 m
// away, and 850 is far from both. Scans of different places have no correct
// pose.
constexpr int kFrames[] = {0, 5, 10, 20, 88, 95, 850, 4413};

std::string DataPath(const std::string& name) {
  return std::string(QUATRO_DATA) + "/" + name;
}

std::string ScanPath(int frame) {
  char name[32];
  std::snprintf(name, sizeof(name), "kitti_00/%06d.bin", frame);
  return DataPath(name);
}

// Twelve numbers of a 3 x 4 matrix, its rotation made orthonormal.
Rigid3 ParsePose(std::istream& numbers) {
  Eigen::Matrix<double, 3, 4> m;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) numbers >> m(row, column);
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(
      m.leftCols<3>(), Eigen::ComputeFullU | Eigen::ComputeFullV);
  return {svd.matrixU() * svd.matrixV().transpose(), m.col(3)};
}

// Poses of the lidar at kFrames, from one of the trajectories of KITTI.
std::vector<Rigid3> ReadTrajectory(const std::string& kind) {
  Rigid3 camera_from_scanner;
  std::ifstream calib(DataPath("kitti_poses/calib/00.txt"));
  for (std::string line; std::getline(calib, line);) {
    if (line.rfind("Tr: ", 0) != 0) continue;
    std::istringstream numbers(line.substr(4));
    camera_from_scanner = ParsePose(numbers);
  }
  std::vector<Rigid3> poses;
  std::ifstream file(DataPath("kitti_poses/" + kind + "/00.txt"));
  int frame = 0;
  for (std::string line; std::getline(file, line); ++frame) {
    if (std::find(std::begin(kFrames), std::end(kFrames), frame) ==
        std::end(kFrames)) {
      continue;
    }
    std::istringstream numbers(line);
    poses.push_back(Inverse(camera_from_scanner) * ParsePose(numbers) *
                    camera_from_scanner);
  }
  return poses;
}

// Odometry from GPS and INS: 0.1 m and 0.5 deg over a few meters, and about 2 m
// and 1 deg after minutes.
PoseGraph MakeOdometry(const std::vector<Rigid3>& poses) {
  PoseGraph graph;
  graph.world_from_pose = poses;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    graph.ids.push_back(kFrames[i]);
    if (i == 0) continue;
    const bool is_near = kFrames[i] - kFrames[i - 1] < 20;
    PoseEdge edge;
    edge.from = i - 1;
    edge.to = i;
    edge.from_from_to = Inverse(poses[i - 1]) * poses[i];
    edge.information = is_near ? DiagonalInformation(0.1, 0.5 * kDegree)
                               : DiagonalInformation(2.0, 1.0 * kDegree);
    graph.edges.push_back(edge);
  }
  return graph;
}

TEST(DiagonalInformation, IsOneOverTheVariance) {
  const Eigen::MatrixXd information = DiagonalInformation(0.1, 0.5);
  EXPECT_NEAR(information(0, 0), 100.0, 1e-9);
  EXPECT_NEAR(information(5, 5), 4.0, 1e-12);
  EXPECT_EQ(information(0, 1), 0.0);
}

TEST(AddLoops, TakesThoseWithAnAnswer) {
  PoseGraph graph;
  graph.ids = {0, 1, 2, 3};
  graph.world_from_pose.resize(4);
  std::vector<ScanPair> pairs(2);
  pairs[0].to = 2;
  pairs[1].from = 1;
  pairs[1].to = 3;
  pairs[1].from_from_to = Rigid3{RotationZ(0.1), {1, 2, 3}};
  AddLoops(pairs, DiagonalInformation(1.0, 1.0), &graph);
  ASSERT_EQ(graph.edges.size(), 1u);
  EXPECT_EQ(graph.edges[0].from, 1u);
  EXPECT_EQ(graph.edges[0].to, 3u);
  EXPECT_EQ(graph.edges[0].from_from_to.translation, Eigen::Vector3d(1, 2, 3));
}

// A line of pairs.csv whose scans are both in the graph: the pose of the first
// as seen from the second.
struct ListedPair {
  std::size_t source = 0;
  std::size_t target = 0;
  Rigid3 target_from_source;
};

std::optional<std::size_t> IndexOfScan(const std::string& path) {
  for (std::size_t i = 0; i < std::size(kFrames); ++i) {
    if (DataPath(path) == ScanPath(kFrames[i])) return i;
  }
  return std::nullopt;
}

std::vector<ListedPair> ReadListedPairs() {
  std::vector<ListedPair> pairs;
  std::ifstream file(DataPath("pairs.csv"));
  for (std::string line; std::getline(file, line);) {
    std::istringstream cells(line);
    std::vector<std::string> row;
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
    if (row.size() < 10) continue;
    const auto source = IndexOfScan(row[1]);
    const auto target = IndexOfScan(row[2]);
    if (!source || !target) continue;
    const auto number = [&](std::size_t i) { return std::stod(row[i]); };
    const Eigen::Quaterniond q(number(9), number(6), number(7), number(8));
    pairs.push_back({*source,
                     *target,
                     {q.normalized().toRotationMatrix(),
                      {number(3), number(4), number(5)}}});
  }
  return pairs;
}

class ScanGraphTest : public ProgramTest {};

TEST_F(ScanGraphTest, GncKeepsTheRightPairsOfRealScansAndDropsTheWrong) {
  for (const int frame : kFrames) {
    if (!std::filesystem::exists(ScanPath(frame)) ||
        !std::filesystem::exists(DataPath("kitti_poses"))) {
      GTEST_SKIP() << "needs kitti_00 and kitti_poses";
    }
  }
  std::vector<PointCloud> scans;
  std::string error;
  for (const int frame : kFrames) {
    scans.push_back(*ReadCloud(ScanPath(frame), &error));
  }
  auto options = *MakePreset("kitti");
  options.num_threads = 2;
  const auto pairs = RegisterPairs(scans, options, [](int, int) {});
  ASSERT_EQ(pairs.size(), 21u);

  const std::vector<Rigid3> truth = ReadTrajectory("semantickitti");
  PoseGraph graph = MakeOdometry(ReadTrajectory("kitti"));
  ASSERT_EQ(truth.size(), std::size(kFrames));
  const std::size_t num_odometry = graph.edges.size();
  AddLoops(pairs, DiagonalInformation(0.1, 0.5 * kDegree), &graph);

  PoseGraph plain = graph;
  PoseGraphOptions least_squares;
  least_squares.loss = LoopLoss::kNone;
  ASSERT_TRUE(SolvePoseGraph(least_squares, &plain).is_usable);
  const auto summary = SolvePoseGraph(PoseGraphOptions(), &graph);
  ASSERT_TRUE(summary.is_usable) << summary.report;

  int num_right = 0, num_wrong = 0;
  for (std::size_t i = num_odometry; i < graph.edges.size(); ++i) {
    const PoseEdge& edge = graph.edges[i];
    const Rigid3 expected = Inverse(truth[edge.from]) * truth[edge.to];
    const double error_m =
        (expected.translation - edge.from_from_to.translation).norm();
    const double error_deg =
        AngleBetween(expected.rotation, edge.from_from_to.rotation) / kDegree;
    const auto name = std::to_string(kFrames[edge.from]) + " and " +
                      std::to_string(kFrames[edge.to]);
    if (error_m < 0.3 && error_deg < 1.5) {
      ++num_right;
      EXPECT_EQ(summary.weights[i], 1.0)
          << name << ", off by " << error_m << " m, " << error_deg << " deg";
    } else if (error_m > 2.0 || error_deg > 10.0) {
      ++num_wrong;
      EXPECT_EQ(summary.weights[i], 0.0)
          << name << ", off by " << error_m << " m, " << error_deg << " deg";
    }
  }
  EXPECT_GE(num_right, 4);
  EXPECT_GE(num_wrong, 4);

  // Frame 4413 revisits frame 0; the error of the GPS exceeds this.
  const auto error_of = [&](const std::vector<Rigid3>& poses) {
    const Rigid3 back = Inverse(poses[0]) * poses[7];
    const Rigid3 expected = Inverse(truth[0]) * truth[7];
    return (back.translation - expected.translation).norm();
  };
  RecordProperty("right", num_right);
  RecordProperty("wrong", num_wrong);
  std::printf(
      "%d right loops, %d wrong; frame 4413 from frame 0 off by %.3f m "
      "by odometry, %.3f m by least squares, %.3f m by GNC\n",
      num_right,
      num_wrong,
      error_of(ReadTrajectory("kitti")),
      error_of(plain.world_from_pose),
      error_of(graph.world_from_pose));
  EXPECT_LT(error_of(graph.world_from_pose), 0.3);

  const auto listed = ReadListedPairs();
  EXPECT_GE(listed.size(), 6u);
  for (const ListedPair& pair : listed) {
    const Rigid3 found = Inverse(graph.world_from_pose[pair.target]) *
                         graph.world_from_pose[pair.source];
    const auto name = std::to_string(kFrames[pair.source]) + " and " +
                      std::to_string(kFrames[pair.target]);
    EXPECT_LT((found.translation - pair.target_from_source.translation).norm(),
              0.3)
        << name;
    EXPECT_LT(AngleBetween(found.rotation, pair.target_from_source.rotation),
              1.0 * kDegree)
        << name;
  }
  EXPECT_GT(error_of(plain.world_from_pose), 0.5);
}

TEST_F(ScanGraphTest, BadFlagsAreRefused) {
  const std::string g2o = Write("odometry.g2o", "VERTEX_SE2 0 0 0 0\n");
  const std::string scans = "--scans=a.bin,b.bin,c.bin";
  const std::string odometry = "--odometry=" + g2o;
  const auto expect_refused = [&](const std::vector<std::string>& flags,
                                  const std::string& what) {
    ExpectBadInput("quatro_scan_graph", flags, "", what);
  };
  expect_refused({"--scans=a.bin,b.bin", odometry}, "three clouds");
  expect_refused({scans}, "--odometry is empty");
  expect_refused({scans, odometry}, "a pose in space for each of the 3 clouds");
  expect_refused({scans, odometry, "--preset=none"}, "--preset=none");
  expect_refused({scans, odometry, "--loss=l1"}, "--loss=l1");
  for (const char* value : {"0", "1e-160", "1e160", "inf", "nan"}) {
    for (const std::string name : {"--loop_sigma_m", "--loop_sigma_deg"}) {
      expect_refused({scans, odometry, name + "=" + value},
                     ", must be 1e-6 to 1");
    }
  }
  const std::string poses =
      "VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1\nVERTEX_SE3:QUAT 1 0 0 0 0 0 0 1\n"
      "VERTEX_SE3:QUAT 2 0 0 0 0 0 0 1\n";
  const auto edge = [](const std::string& ids) {
    return "EDGE_SE3:QUAT " + ids +
           " 1 0 0 0 0 0 1 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1\n";
  };
  expect_refused({scans, "--odometry=" + Write("none.g2o", poses)},
                 "an edge from pose 0 to pose 1");
  expect_refused({scans, "--odometry=" + Write("gap.g2o", poses + edge("0 1"))},
                 "an edge from pose 1 to pose 2");
  const std::string ok =
      "--odometry=" + Write("ok.g2o", poses + edge("1 2") + edge("0 1"));
  expect_refused({scans, ok}, "a.bin");
}

}  // namespace
}  // namespace quatro::scan_graph_test
