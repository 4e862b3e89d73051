// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/nearest_within.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/random_problems.h"

namespace quatro::nearest_within_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// The reference: computes all distances.
std::int32_t NearestOf(const Points& points,
                       const Eigen::Vector3d& place,
                       double radius) {
  std::int32_t nearest = kNoneWithin;
  double least = radius * radius;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Eigen::Vector3d d = place - points.col(i);
    const double d2 = d.x() * d.x() + d.y() * d.y() + d.z() * d.z();
    if (d2 < least || (d2 == least && nearest == kNoneWithin)) {
      least = d2;
      nearest = static_cast<std::int32_t>(i);
    }
  }
  return nearest;
}

TEST(FindNearestWithin, IsTheNearestOfAll) {
  const Points street = RandomStreet(800, 0.02, 1);
  const Points far_off = street.colwise() + Eigen::Vector3d(1e7, -1e7, 3.0);
  for (const Points& points : {street, far_off}) {
    // Places next to the points, around all of them, and beyond.
    Points places = RandomPoints(1000, 40.0, 2);
    places.colwise() += points.rowwise().mean();
    places.leftCols(500) = points.leftCols(500) + RandomPoints(500, 0.4, 3);
    for (const double radius : {0.2, 0.7, 3.0}) {
      const auto nearest = FindNearestWithin(KdTree(points), places, radius, 1);
      ASSERT_EQ(nearest.size(), 1000u);
      int num_none = 0;
      for (Eigen::Index i = 0; i < places.cols(); ++i) {
        const std::int32_t found = nearest[static_cast<std::size_t>(i)];
        ASSERT_EQ(found, NearestOf(points, places.col(i), radius))
            << "radius " << radius << ", place " << i;
        num_none += found == kNoneWithin;
      }
      EXPECT_GT(num_none, 100);
      EXPECT_LT(num_none, 1000);
    }
  }
}

TEST(FindNearestWithin, TheBallIsClosedAndTheLowestIndexWins) {
  Points points(3, 4);
  points.col(0) << 2.0, 0.0, 0.0;
  points.col(1) << -1.0, 0.0, 0.0;
  points.col(2) << 1.0, 0.0, 0.0;
  points.col(3) << 1.0, 0.0, 0.0;
  Points places = Points::Zero(3, 2);
  places(0, 1) = 3.0;
  EXPECT_THAT(FindNearestWithin(KdTree(points), places, 1.0, 1),
              ElementsAre(1, 0));
  EXPECT_THAT(
      FindNearestWithin(KdTree(points), places, std::nextafter(1.0, 0.0), 1),
      ElementsAre(kNoneWithin, kNoneWithin));
}

TEST(FindNearestWithin, WhatIsNowhereIsNearToNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  Points places = Points::Zero(3, 4);
  places(1, 0) = nan;
  places(2, 1) = infinity;
  places(0, 2) = -1e300;
  Points points = Points::Zero(3, 2);
  points(0, 1) = 1.0;
  EXPECT_THAT(FindNearestWithin(KdTree(points), places, 1.0, 1),
              ElementsAre(kNoneWithin, kNoneWithin, kNoneWithin, 0));
  // Too wide for cells.
  points(0, 1) = 1e9;
  EXPECT_THAT(FindNearestWithin(KdTree(points), places, 1.0, 1),
              ElementsAre(kNoneWithin, kNoneWithin, kNoneWithin, 0));
  EXPECT_THAT(FindNearestWithin(KdTree(Points(3, 0)), places, 1.0, 1),
              ElementsAre(kNoneWithin, kNoneWithin, kNoneWithin, kNoneWithin));
  EXPECT_THAT(FindNearestWithin(KdTree(points), Points(3, 0), 1.0, 1),
              IsEmpty());
}

TEST(FindNearestWithin, DoesNotDependOnTheNumberOfThreads) {
  const KdTree tree(RandomStreet(3000, 0.02, 1));
  const Points places = tree.points() + RandomPoints(3000, 0.5, 4);
  const auto one = FindNearestWithin(tree, places, 0.5, 1);
  for (const int num_threads : {0, 2, 3}) {
    EXPECT_EQ(FindNearestWithin(tree, places, 0.5, num_threads), one);
  }
}

}  // namespace
}  // namespace quatro::nearest_within_test
