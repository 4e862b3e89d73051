// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/surface_share.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "tests/support/random_problems.h"

namespace quatro::surface_share_test {
namespace {

// A wall scanned by few beams: rows `gap` apart of points 0.02 m apart.
Points Rows(int num_rows, double gap) {
  constexpr int kPerRow = 300;
  Points points(3, num_rows * kPerRow);
  for (int row = 0; row < num_rows; ++row) {
    for (int i = 0; i < kPerRow; ++i) {
      points.col(row * kPerRow + i) << 5.0, 0.02 * i, gap * row;
    }
  }
  return points;
}

double Share(const Points& points, double radius) {
  return SurfaceShare(points, radius);
}

TEST(SurfaceShare, RowsAreASurfaceOnceTheRadiusReachesTheNext) {
  for (const double gap : {0.2, 0.5}) {
    const Points wall = Rows(20, gap);
    EXPECT_EQ(Share(wall, 0.9 * gap), 0.0) << gap;
    EXPECT_EQ(Share(wall, 1.5 * gap), 1.0) << gap;
  }
}

TEST(SurfaceShare, HalfAWallIsHalf) {
  // Rows close to each other, and as many points on rows far apart.
  Points both(3, 12000);
  both << Rows(20, 0.1), Rows(20, 2.0).colwise() + Eigen::Vector3d(50, 0, 0);
  EXPECT_NEAR(Share(both, 0.3), 0.5, 0.01);
}

TEST(SurfaceShare, FewNeighborsAreNoSurface) {
  Points square(3, 4);
  square << 0, 1, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0;
  EXPECT_EQ(Share(square, 2.0), 0.0);
  Points five(3, 5);
  five << square, Eigen::Vector3d(0.5, 0.5, 0.0);
  EXPECT_EQ(Share(five, 2.0), 1.0);
}

TEST(SurfaceShare, IsTheSameWhereverTheCloudIsAndAtAnyScale) {
  const Points street = RandomStreet(3000, 0.01, /*seed=*/3);
  const double share = Share(street, 0.4);
  EXPECT_GT(share, 0.2);
  EXPECT_LT(share, 0.98);
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).matrix();
  const Points moved =
      (turn * street).colwise() + Eigen::Vector3d(1e3, -2e3, 50.0);
  EXPECT_NEAR(Share(moved, 0.4), share, 0.005);
  EXPECT_NEAR(Share(10.0 * street, 4.0), share, 1e-12);
}

TEST(SurfaceShare, OfNothingIsZero) {
  EXPECT_EQ(Share(Points(3, 0), 1.0), 0.0);
  EXPECT_EQ(Share(Points::Zero(3, 10), 1.0), 0.0);
}

}  // namespace
}  // namespace quatro::surface_share_test
