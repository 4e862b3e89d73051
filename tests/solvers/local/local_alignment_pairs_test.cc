// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Local registration of real scans from 3 deg and 0.5 m off.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "features/base/degree.h"
#include "features/io/cloud_io.h"
#include "features/voxel_grid.h"
#include "solvers/local/gicp.h"
#include "solvers/local/icp.h"
#include "solvers/local/vgicp.h"
#include "tests/support/alignment_problems.h"
#include "tests/support/random_problems.h"

namespace quatro::local_alignment_pairs_test {
namespace {

constexpr double kVoxelSize = 0.3;  // [m]

struct Pair {
  std::string name;
  Points source;  // Voxel means.
  Points target;
  Rigid3 truth;
};

Points ReadVoxels(const std::string& name) {
  std::string error;
  const auto cloud = ReadCloud(std::string(QUATRO_DATA) + "/" + name, &error);
  EXPECT_TRUE(cloud.has_value()) << error;
  if (!cloud) return Points(3, 0);
  return SampleVoxels(cloud->points, kVoxelSize, &error).value();
}

// Reads lines set,source,target,tx,ty,tz,qx,qy,qz,qw,...; keeps those of KITTI.
std::vector<Pair> ReadKittiPairs(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  std::vector<Pair> pairs;
  while (std::getline(file, line)) {
    if (line.rfind("kitti", 0) != 0) continue;
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
    const auto number = [&](std::size_t i) { return std::stod(cells.at(i)); };
    const Eigen::Quaterniond rotation(
        number(9), number(6), number(7), number(8));
    pairs.push_back({cells[1] + " -> " + cells[2],
                     ReadVoxels(cells[1]),
                     ReadVoxels(cells[2]),
                     {rotation.normalized().toRotationMatrix(),
                      {number(3), number(4), number(5)}}});
  }
  return pairs;
}

class LocalAlignmentPairsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    path_ = std::string(QUATRO_DATA) + "/pairs.csv";
    if (!std::filesystem::exists(path_)) GTEST_SKIP() << "needs pairs.csv";
  }

  // Every pair must end within 0.3 m and 1 deg of its known pose.
  template <typename Solve>
  void ExpectAllConverge(const Solve& solve) const {
    std::vector<double> times;
    std::uint64_t seed = 0;
    for (const Pair& pair : ReadKittiPairs(path_)) {
      ++seed;
      Vector6 delta;
      delta << 3.0 * kDegree * RandomDirection(seed),
          0.5 * RandomDirection(seed + 1000);
      const Rigid3 start = Perturbed(pair.truth, delta);
      const std::clock_t begin = std::clock();
      const AlignmentSummary summary = solve(pair.source, pair.target, start);
      times.push_back(1e3 * static_cast<double>(std::clock() - begin) /
                      CLOCKS_PER_SEC);
      ASSERT_EQ(summary.termination, AlignmentTermination::kConverged)
          << pair.name << ": " << summary.message;
      const Rigid3& pose = *summary.target_from_source;
      EXPECT_LE((pose.translation - pair.truth.translation).norm(), 0.3)
          << pair.name;
      EXPECT_LE(AngleBetween(pose.rotation, pair.truth.rotation), kDegree)
          << pair.name;
    }
    ASSERT_EQ(times.size(), 39u);
    std::sort(times.begin(), times.end());
    std::cout << "median " << times[times.size() / 2] << " ms, largest "
              << times.back() << " ms of one core, trees and normals in it\n";
  }

  std::string path_;
};

TEST_F(LocalAlignmentPairsTest, IcpConverges) {
  ExpectAllConverge([](const Points& a, const Points& b, const Rigid3& start) {
    return SolveIcp(a, b, start, {});
  });
}

TEST_F(LocalAlignmentPairsTest, GicpConverges) {
  ExpectAllConverge([](const Points& a, const Points& b, const Rigid3& start) {
    return SolveGicp(a, b, start, {});
  });
}

TEST_F(LocalAlignmentPairsTest, VgicpConverges) {
  ExpectAllConverge([](const Points& a, const Points& b, const Rigid3& start) {
    return SolveVgicp(a, b, start, {});
  });
}

}  // namespace
}  // namespace quatro::local_alignment_pairs_test
