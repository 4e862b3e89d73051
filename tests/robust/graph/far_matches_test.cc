// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/graph/far_matches.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "robust/estimators/distinct_matches.h"
#include "tests/support/random_problems.h"

namespace quatro::far_matches_test {
namespace {

using ::testing::ElementsAre;
using ::testing::SizeIs;

// On a line about the origin: at 0, 1, -1, 2, -2, 3 and `last` [m].
Points Line(double last) {
  Points points = Points::Zero(3, 7);
  points.row(0) << 0.0, 1.0, -1.0, 2.0, -2.0, 3.0, last;
  return points;
}

TEST(Median, IsThatOfEachAxis) {
  Points points(3, 3);
  points << 1.0, 3.0, 2.0, -1e300, 5.0, 6.0, 9.0, 8.0, 7.0;
  EXPECT_EQ(Median(points), Eigen::Vector3d(2.0, 5.0, 8.0));
}

TEST(FindNear, IsWithinTwentyMedianDistances) {
  // The median is 1 m, half the points are within 2 m of it.
  EXPECT_THAT(FindNear(Line(40.9), Line(0.5), 0.3), SizeIs(7));
  EXPECT_THAT(FindNear(Line(41.1), Line(0.5), 0.3),
              ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_THAT(FindNear(Line(0.5), Line(-1e300), 0.3),
              ElementsAre(0, 1, 2, 3, 4, 5));
}

TEST(FindNear, PointsAtOnePlaceCountAsANoiseBoundApart) {
  Points points = Points::Zero(3, 5);
  points(1, 4) = 5.9;
  EXPECT_THAT(FindNear(points, points, 0.3), SizeIs(5));
  points(1, 4) = 6.1;
  EXPECT_THAT(FindNear(points, points, 0.3), SizeIs(4));
}

TEST(FindNear, GivesAllIfNoMatchIs) {
  // Half of the matches are far in the source, the others in the target.
  Points source = Points::Zero(3, 4);
  Points target = Points::Zero(3, 4);
  source.row(0) << 1e9, 1e9, 0.0, 0.0;
  target.row(0) << 0.0, 0.0, 1e9, -1e9;
  EXPECT_THAT(FindNear(source, target, 0.3), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(FindNear(Points(3, 0), Points(3, 0), 0.3), SizeIs(0));
}

TEST(FindPlaceable, LeavesOutWhatIsFartherThanADoubleResolves) {
  const double reach = 1.0 / std::numeric_limits<double>::epsilon();
  EXPECT_THAT(FindPlaceable(Line(reach), Line(0.5), 0.3), SizeIs(7));
  EXPECT_THAT(FindPlaceable(Line(3.0 * reach), Line(0.5), 0.3), SizeIs(6));
  EXPECT_THAT(FindPlaceable(Line(0.5), Line(-1e300), 0.3), SizeIs(6));
  EXPECT_THAT(FindDistinctMatches(
                  Line(0.5), Line(std::numeric_limits<double>::max()), 0.3)
                  .columns,
              SizeIs(6));
}

TEST(FindPlaceable, KeepsScansWhereverTheyAreAndWhateverTheBound) {
  const Points points = RandomPoints(50, 20.0, /*seed=*/1);
  for (const double bound : {1e-300, 1e-15, 0.3, 1e300}) {
    EXPECT_THAT(FindPlaceable(points, points, bound), SizeIs(50)) << bound;
    const Points far = points.array() + 1e18;
    EXPECT_THAT(FindPlaceable(points, far, bound), SizeIs(50)) << bound;
  }
}

}  // namespace
}  // namespace quatro::far_matches_test
