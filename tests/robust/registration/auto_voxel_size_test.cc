// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/registration/auto_voxel_size.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "features/voxel_grid.h"
#include "tests/support/random_problems.h"

namespace quatro::auto_voxel_size_test {
namespace {

double SizeFor(const Points& source, const Points& target) {
  return AutoVoxelSize(source, target).value_or(0.0);
}

// A street corner of 16 m. Its walls are not parallel to the axes, because the
// number of voxels of such a wall depends on where the grid begins.
Points Street(Eigen::Index num_points, std::uint64_t seed) {
  return RandomRotation(8) * RandomStreet(num_points, 0.01, seed);
}

class AutoVoxelSizeTest : public ::testing::Test {
 protected:
  const Points dense_ = Street(60'000, 1);
  const Points sparse_ = dense_.leftCols(1500);
};

TEST_F(AutoVoxelSizeTest, LeavesTheWantedNumberOfVoxels) {
  for (const Eigen::Index n : {60'000, 300'000}) {
    const Points cloud = Street(n, 4);
    const double size = SizeFor(cloud, cloud);
    std::string error;
    EXPECT_NEAR(static_cast<double>(SampleVoxels(cloud, size, &error)->cols()),
                15'000.0,
                1'500.0)
        << size;
  }
}

TEST_F(AutoVoxelSizeTest, ScalesWithTheCloud) {
  const double base = SizeFor(dense_, dense_);
  EXPECT_GT(base, 0.02);
  for (const double scale : {1e-6, 1e-3, 0.5, 3.0, 10.0, 1e3, 1e9}) {
    const double scaled = SizeFor(scale * dense_, scale * dense_);
    EXPECT_NEAR(scaled / (scale * base), 1.0, 0.06) << scale;  // Two digits.
  }
}

TEST_F(AutoVoxelSizeTest, StaysAsTheCloudsAreMoved) {
  const double base = SizeFor(dense_, sparse_);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const auto move = [&](const Points& points) -> Points {
      return (RandomRotation(seed) * points).colwise() +
             Eigen::Vector3d(9.0, -70.0, 3.0);
    };
    const double moved = SizeFor(move(dense_), move(sparse_));
    EXPECT_NEAR(moved / base, 1.0, 0.16) << seed;  // One step for the surfaces.
  }
}

// Of many points, every k-th is enough.
TEST_F(AutoVoxelSizeTest, ManyPointsGiveTheSizeOfFewer) {
  const Points many = Street(900'000, 2);
  const Points fewer = many(Eigen::all, Eigen::seq(0, Eigen::last, 3));
  EXPECT_NEAR(SizeFor(many, many) / SizeFor(fewer, fewer), 1.0, 0.07);
}

TEST_F(AutoVoxelSizeTest, AreTheSameWithCloudsSwapped) {
  EXPECT_EQ(SizeFor(dense_, sparse_), SizeFor(sparse_, dense_));
}

TEST_F(AutoVoxelSizeTest, VoxelsAreNoSmallerThanTheSpacingOfTheSparserCloud) {
  // 1500 points on some 500 m^2 are about 0.3 m apart.
  EXPECT_GT(SizeFor(sparse_, sparse_), 0.15);
  EXPECT_GT(SizeFor(dense_, sparse_), 0.15);
  EXPECT_LT(SizeFor(dense_, dense_), 0.25);
}

TEST_F(AutoVoxelSizeTest, NormalsReachFromOneRingToTheNext) {
  // Two walls in rows of points 0.02 m apart.
  for (const double gap : {0.4, 0.8}) {
    Points rows(3, 20000);
    for (int i = 0; i < 20000; ++i) {
      const double along = 0.02 * (i % 500);
      const double up = gap * (i / 1000);
      if (i % 1000 < 500) {
        rows.col(i) << 10.0, along, up;
      } else {
        rows.col(i) << along, -5.0, up;
      }
    }
    const double normal_radius = 3.0 * SizeFor(rows, rows);
    EXPECT_GT(normal_radius, gap) << gap;
    EXPECT_LT(normal_radius, 2.0 * gap) << gap;
    EXPECT_EQ(SizeFor(dense_, rows), SizeFor(rows, dense_));
    EXPECT_GT(3.0 * SizeFor(dense_, rows), gap);
  }
}

TEST_F(AutoVoxelSizeTest, ALineStaysAsItIs) {
  Points line = Points::Zero(3, 2000);
  line.row(0).setLinSpaced(0.0, 20.0);
  const double size = SizeFor(line, line);
  EXPECT_LT(size, 0.02);
}

TEST_F(AutoVoxelSizeTest, HasTwoDigits) {
  const double size = SizeFor(dense_, dense_);
  const double thousandths = 1000.0 * size;  // Sizes here are 0.10-0.99 m.
  ASSERT_GT(size, 0.1);
  EXPECT_NEAR(thousandths / 10.0, std::round(thousandths / 10.0), 1e-9);
}

// Far from everything else, it makes the box of the cloud 1000 times as wide.
TEST_F(AutoVoxelSizeTest, AStrayPointChangesLittle) {
  for (const Points& cloud : {dense_, sparse_}) {
    Points stray = cloud;
    stray.col(0) << 1.6e4, 0.0, 0.0;
    EXPECT_NEAR(SizeFor(stray, stray) / SizeFor(cloud, cloud), 1.0, 0.16);
  }
}

// The size of the rest, with which the front end refuses the cloud.
TEST_F(AutoVoxelSizeTest, APointTooFarForVoxelsChangesNothing) {
  Points stray = sparse_;
  stray.col(0) << 1e12, 0.0, 0.0;
  EXPECT_LT(SizeFor(stray, stray), 2.0 * SizeFor(sparse_, sparse_));
}

TEST_F(AutoVoxelSizeTest, OfNothingIsNone) {
  EXPECT_FALSE(AutoVoxelSize(Points(3, 0), dense_));
  EXPECT_FALSE(AutoVoxelSize(dense_, Points(3, 0)));
  EXPECT_FALSE(AutoVoxelSize(Points::Ones(3, 1), Points::Zero(3, 1)));
  EXPECT_FALSE(AutoVoxelSize(Points::Ones(3, 100), Points::Ones(3, 100)));
  // The squares of such distances are zero.
  EXPECT_FALSE(AutoVoxelSize(1e-300 * dense_, dense_));
  EXPECT_FALSE(AutoVoxelSize(dense_, 1e160 * dense_));  // Infinite.
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity(),
                           std::numeric_limits<double>::max()}) {
    Points points = sparse_;
    points.col(7).fill(bad);
    points.col(8).fill(-bad);
    EXPECT_FALSE(AutoVoxelSize(points, dense_)) << bad;
  }
}

TEST_F(AutoVoxelSizeTest, FewPointsAreEnough) {
  for (const Eigen::Index n : {2, 3, 10}) {
    const Points few = dense_.leftCols(n);
    EXPECT_GT(SizeFor(few, few), 0.0) << n;
    EXPECT_GT(SizeFor(few, Points::Ones(3, 1)), 0.0) << n;
    EXPECT_EQ(SizeFor(few, dense_), SizeFor(dense_, few)) << n;
  }
}

}  // namespace
}  // namespace quatro::auto_voxel_size_test
