// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/odometry/aloam/ring_features.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "experiments/odometry/aloam/scan_rings.h"
#include "features/base/degree.h"

namespace quatro::ring_features_test {
namespace {

// A level ring over azimuths -60 ... 60 deg in steps of 0.2 deg, with the range
// range(azimuth); no point if it is not finite.
Points Ring(const std::function<double(double)>& range) {
  std::vector<Eigen::Vector3d> seen;
  for (int i = -300; i <= 300; ++i) {
    const double a = 0.2 * i * kDegree;
    const double r = range(a);
    if (std::isfinite(r)) {
      seen.emplace_back(r * std::cos(a), r * std::sin(a), 0.0);
    }
  }
  Points points(3, static_cast<Eigen::Index>(seen.size()));
  for (std::size_t i = 0; i < seen.size(); ++i) {
    points.col(static_cast<Eigen::Index>(i)) = seen[i];
  }
  return points;
}

ScanRings OneRing(const Points& points) {
  ScanRings scan;
  scan.source = RingSource::kOrder;
  scan.elevations = {0.0};
  scan.rings.resize(1);
  scan.rings[0].resize(static_cast<std::size_t>(points.cols()));
  std::iota(scan.rings[0].begin(), scan.rings[0].end(), 0);
  return scan;
}

// Two walls that meet at (10, 0) at a right angle, pointing away from the
// sensor.
double InnerCorner(double a) {
  return 10.0 / (std::cos(a) + std::abs(std::sin(a)));
}

// The range of a wall across at x = 10.
double Wall(double a) { return 10.0 / std::cos(a); }

// Half the angle of the post below [rad].
constexpr double kPost = 5.0 * kDegree;

// A post 6 m away in front of the wall.
double WallBehindPost(double a) { return std::abs(a) < kPost ? 6.0 : Wall(a); }

double Nearest(const RingPoints& points, const Eigen::Vector3d& p) {
  if (points.ring.empty()) return std::numeric_limits<double>::infinity();
  return std::sqrt(
      (points.points.colwise() - p).colwise().squaredNorm().minCoeff());
}

TEST(FindRingFeatures, SharpIsTheCornerOfTwoWallsAndFlatIsNot) {
  const Points points = Ring(InnerCorner);
  const RingFeatures features = FindRingFeatures(points, OneRing(points), {});
  const Eigen::Vector3d corner(10.0, 0.0, 0.0);
  ASSERT_GE(features.sharp.points.cols(), 1);
  for (const auto& p : features.sharp.points.colwise()) {
    EXPECT_LT((p - corner).norm(), 0.15) << p.transpose();
  }
  ASSERT_GT(features.flat.points.cols(), 15);
  EXPECT_GT(Nearest(features.flat, corner), 0.1);
  for (const auto& p : features.flat.points.colwise()) {
    EXPECT_NEAR(p.x() + std::abs(p.y()), 10.0, 1e-9);
  }
}

TEST(FindRingFeatures, CountsHoldASector) {
  // Teeth of 0.5 m give edges everywhere.
  const Points points = Ring([](double a) {
    return 8.0 + 0.5 * std::abs(std::remainder(a / (4.0 * kDegree), 1.0));
  });
  RingFeatureOptions options;
  options.edge_curvature = 0.002;
  RingFeatures features = FindRingFeatures(points, OneRing(points), options);
  EXPECT_EQ(features.sharp.points.cols(), 2 * 6);
  EXPECT_GT(features.less_sharp.points.cols(), 2 * 6);
  EXPECT_LE(features.less_sharp.points.cols(), 20 * 6);
  options.num_sectors = 3;
  options.max_sharp = 1;
  options.max_less_sharp = 2;
  features = FindRingFeatures(points, OneRing(points), options);
  EXPECT_EQ(features.sharp.points.cols(), 3);
  EXPECT_EQ(features.less_sharp.points.cols(), 6);
}

// (1) by hand: a point 0.05 m in front of a wall, with ten neighbors in a line,
// has c = (10 * 0.05)^2 = 0.25; its neighbors have only 0.05^2.
TEST(FindRingFeatures, CurvatureIsTheSquaredSumOfDifferences) {
  Points points(3, 41);
  for (int i = 0; i < 41; ++i) points.col(i) << 10.0, 0.03 * (i - 20), 0.0;
  points(0, 20) -= 0.05;
  RingFeatureOptions options;
  options.num_sectors = 1;
  options.edge_curvature = 0.249;
  RingFeatures features = FindRingFeatures(points, OneRing(points), options);
  ASSERT_EQ(features.sharp.points.cols(), 1);
  EXPECT_EQ(features.sharp.points(1, 0), 0.0);
  options.edge_curvature = 0.251;
  features = FindRingFeatures(points, OneRing(points), options);
  EXPECT_EQ(features.sharp.points.cols(), 0);
}

TEST(FindRingFeatures, TheRimOfTheShadowIsNotAnEdgeAndThePostIs) {
  const Points points = Ring(WallBehindPost);
  const RingFeatures features = FindRingFeatures(points, OneRing(points), {});
  ASSERT_GE(features.less_sharp.points.cols(), 2);
  for (const double side : {-1.0, 1.0}) {
    const double a = side * kPost;
    const Eigen::Vector3d direction(std::cos(a), std::sin(a), 0.0);
    EXPECT_LT(Nearest(features.less_sharp, 6.0 * direction), 0.1);
    EXPECT_GT(Nearest(features.less_sharp, Wall(a) * direction), 0.2);
    EXPECT_GT(Nearest(features.flat, Wall(a) * direction), 0.1);
  }
}

// A wall along the line of sight, y = 0.6: its points are 0.018 to 0.041 of the
// range apart, less than a rim.
TEST(FindRingFeatures, AWallAlongTheBeamIsNotChosen) {
  const Points points = Ring([](double a) {
    const double r = 0.6 / std::sin(a);
    return r < 7.0 && r > 3.2 ? r : std::numeric_limits<double>::infinity();
  });
  ASSERT_GT(points.cols(), 25);
  RingFeatures features = FindRingFeatures(points, OneRing(points), {});
  EXPECT_EQ(features.less_sharp.points.cols(), 0);
  EXPECT_EQ(features.flat.points.cols(), 0);
  RingFeatureOptions options;
  options.max_relative_step = 0.1;
  features = FindRingFeatures(points, OneRing(points), options);
  EXPECT_GT(features.flat.points.cols() + features.sharp.points.cols(), 0);
}

TEST(FindRingFeatures, NearPointsAreTheCarsOwn) {
  const Points points = Ring([](double a) { return 0.2 * InnerCorner(a); });
  const RingFeatures features = FindRingFeatures(points, OneRing(points), {});
  EXPECT_EQ(features.sharp.points.cols(), 0);
  EXPECT_EQ(features.less_flat.points.cols(), 0);
  RingFeatureOptions options;
  options.min_range = 0.0;
  options.edge_curvature = 0.004;
  EXPECT_GT(FindRingFeatures(points, OneRing(points), options)
                .less_flat.points.cols(),
            0);
}

TEST(FindRingFeatures, OfNothingAreNone) {
  for (const int n : {0, 1, 10}) {
    const Points points = Points::Constant(3, n, 5.0);
    const RingFeatures features =
        FindRingFeatures(points, OneRing(points), RingFeatureOptions{});
    EXPECT_EQ(features.less_sharp.points.cols(), 0);
    EXPECT_EQ(features.less_flat.points.cols(), 0);
  }
}

TEST(RingFeatureOptions, ErrorNamesTheField) {
  const auto error_of = [](auto change) {
    RingFeatureOptions options;
    change(&options);
    std::string error;
    EXPECT_FALSE(options.IsValid(&error));
    return error;
  };
  using ::testing::HasSubstr;
  EXPECT_THAT(error_of([](auto* o) { o->num_sectors = 0; }),
              HasSubstr("num_sectors = 0"));
  EXPECT_THAT(error_of([](auto* o) { o->max_less_sharp = 1; }),
              HasSubstr("max_less_sharp = 1"));
  EXPECT_THAT(error_of([](auto* o) { o->edge_curvature = std::nan(""); }),
              HasSubstr("edge_curvature"));
  EXPECT_THAT(error_of([](auto* o) { o->less_flat_voxel = 0.0; }),
              HasSubstr("less_flat_voxel = 0"));
  EXPECT_THAT(error_of([](auto* o) { o->min_range = -1.0; }),
              HasSubstr("min_range = -1"));
  EXPECT_THAT(error_of([](auto* o) { o->min_rim = 0.0; }),
              HasSubstr("min_rim = 0"));
}

}  // namespace
}  // namespace quatro::ring_features_test
