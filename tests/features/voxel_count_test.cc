// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/voxel_count.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <vector>

#include "tests/support/random_problems.h"

namespace quatro::voxel_count_test {
namespace {

// The first point of each cell, found by a set of cells.
std::vector<Eigen::Index> FirstByBruteForce(const Points& points, double size) {
  const Eigen::Vector3d low = points.rowwise().minCoeff();
  std::set<std::array<double, 3>> seen;
  std::vector<Eigen::Index> first;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    std::array<double, 3> cell;
    for (int axis = 0; axis < 3; ++axis) {
      cell[static_cast<std::size_t>(axis)] =
          std::floor((points(axis, i) - low[axis]) / size);
    }
    if (seen.insert(cell).second) first.push_back(i);
  }
  return first;
}

// Multiples of 1/64 in a cube of 64 m. Single precision represents them, so
// that each point is in the same cell.
Points Rounded(const Points& points) {
  Points rounded = (points.cwiseAbs() * 64.0).array().round() / 64.0;
  rounded.col(0).fill(0.0);
  rounded.col(1).fill(64.0);
  return rounded;
}

TEST(VoxelCounter, FindsTheFirstPointOfEachCell) {
  for (const Eigen::Index n : {2, 3, 3000}) {
    const Points points = Rounded(RandomPoints(n, 5.0, 3));
    const VoxelCounter counter(points);
    EXPECT_EQ(counter.num_points(), static_cast<std::size_t>(n));
    EXPECT_EQ(counter.width(), 64.0);
    for (const double size : {0.03125, 0.5, 2.0, 128.0}) {
      const auto wanted = FirstByBruteForce(points, size);
      EXPECT_EQ(counter.FirstPoints(size), wanted) << n << " " << size;
      EXPECT_EQ(counter.Estimate(size), static_cast<double>(wanted.size()));
    }
  }
}

TEST(VoxelCounter, AQuarterOfTheCellsGivesTheNumberOfAll) {
  const Points points = RandomPoints(200'000, 5.0, 4);
  const VoxelCounter counter(points);
  for (const double size : {0.05, 0.3, 0.8}) {
    const auto exact = static_cast<double>(counter.FirstPoints(size).size());
    EXPECT_NEAR(counter.Estimate(size), exact, 4.0 * std::sqrt(3.0 * exact));
    EXPECT_NE(counter.Estimate(size), exact) << "all cells were counted";
  }
}

TEST(VoxelCounter, TheLeastSizeIsAccepted) {
  const Points points = RandomPoints(1000, 5.0, 5);
  const VoxelCounter counter(points);
  EXPECT_EQ(counter.Estimate(counter.min_voxel_size()), 1000.0);
}

TEST(VoxelCounter, CopiesAreOneCell) {
  const VoxelCounter counter(Points::Ones(3, 10));
  EXPECT_EQ(counter.width(), 0.0);
  EXPECT_EQ(counter.Estimate(1.0), 1.0);
  EXPECT_EQ(counter.FirstPoints(1.0), std::vector<Eigen::Index>{0});
}

}  // namespace
}  // namespace quatro::voxel_count_test
