// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/verdict/free_space.h"

#include <gtest/gtest.h>

#include <vector>

#include "features/base/rigid3.h"
#include "tests/support/random_problems.h"

namespace quatro::free_space_test {
namespace {

using Sight = RangeImage::Sight;

constexpr double kVoxel = 0.3;   // [m]
constexpr double kMargin = 0.5;  // [m]

// A wall 10 m ahead, 16 m wide, from 3 m below the sensor to 3 m above it, and
// a point 1 m behind the sensor, since places closer than the nearest point are
// unknown.
std::vector<Eigen::Vector3d> Wall() {
  std::vector<Eigen::Vector3d> wall = {{-1.0, 0.0, 0.0}};
  for (double y = -8.0; y <= 8.0; y += kVoxel) {
    for (double z = -3.0; z <= 3.0; z += kVoxel) wall.push_back({10.0, y, z});
  }
  return wall;
}

Points AsPoints(const std::vector<Eigen::Vector3d>& list) {
  Points points(3, static_cast<Eigen::Index>(list.size()));
  Eigen::Index i = 0;
  for (const auto& point : list) points.col(i++) = point;
  return points;
}

class RangeImageTest : public ::testing::Test {
 protected:
  Sight At(const std::vector<Eigen::Vector3d>& seen,
           const Eigen::Vector3d& point) const {
    return RangeImage(AsPoints(seen), Eigen::Vector3d::Zero(), kVoxel)
        .At(point, kMargin);
  }
};

TEST_F(RangeImageTest, BeforeTheWallIsFree) {
  for (const double x : {6.0, 8.0, 9.0}) {
    for (const double y : {-3.0, -0.01, 0.01, 3.0}) {
      EXPECT_EQ(At(Wall(), {11.0, y, 1.0}), Sight::kNotFree) << y;
      const Eigen::Vector3d before = Eigen::Vector3d(10.0, y, 1.0) * x / 10.0;
      EXPECT_EQ(At(Wall(), before), Sight::kFree) << x << " " << y;
    }
  }
}

TEST_F(RangeImageTest, NearerThanAllThatWasSeenIsUnknown) {
  EXPECT_EQ(At(Wall(), {0.9, 0.0, 0.0}), Sight::kUnknown);
  EXPECT_EQ(At(Wall(), {1.1, 0.0, 0.0}), Sight::kFree);
  EXPECT_EQ(At(Wall(), {0.0, 0.0, 0.0}), Sight::kUnknown);
}

TEST_F(RangeImageTest, AtTheWallAndBehindItIsNotFree) {
  for (const double x : {9.6, 10.0, 10.4, 12.0, 100.0}) {
    EXPECT_EQ(At(Wall(), {x, 0.1, 0.1}), Sight::kNotFree) << x;
  }
}

TEST_F(RangeImageTest, WhereNoBeamWentIsUnknown) {
  const auto seen = Wall();
  EXPECT_EQ(At(seen, {-5.0, 5.0, 0.0}), Sight::kUnknown);
  EXPECT_EQ(At(seen, {5.0, 0.0, 4.0}), Sight::kUnknown);
}

TEST_F(RangeImageTest, BetweenTwoBeamsIsUnknown) {
  std::vector<Eigen::Vector3d> seen = {{-1.0, 0.0, 0.0}};
  for (double y = -8.0; y <= 8.0; y += kVoxel) {
    for (const double z : {-0.7, 0.7}) seen.push_back({20.0, y, z});  // 4 deg.
  }
  EXPECT_EQ(At(seen, {10.0, 0.0, 0.0}), Sight::kUnknown);
  EXPECT_EQ(At(seen, {10.0, 0.0, 0.35}), Sight::kFree);
}

// A pole 5 m ahead and the wall behind it. The wall was seen next to the pole,
// but the pole of the other scan may have a small error.
TEST_F(RangeImageTest, BesideAnEdgeIsNotFree) {
  auto seen = Wall();
  for (double z = -2.0; z <= 2.0; z += kVoxel) seen.push_back({5.0, 0.0, z});
  for (const double y : {-0.3, -0.1, 0.1, 0.3}) {
    EXPECT_EQ(At(seen, {5.1, y, 0.0}), Sight::kNotFree) << y;
  }
  EXPECT_EQ(At(seen, {5.1, 1.0, 0.0}), Sight::kFree);
}

TEST_F(RangeImageTest, ThePlaceOfTheSensorMattersAndNotTheFrame) {
  const Points points = AsPoints(Wall());
  const RangeImage image(points, Eigen::Vector3d::Zero(), kVoxel);
  const Points queries = RandomPoints(5000, 6.0, /*seed=*/1);
  // A rotation by 90 deg maps cells to cells.
  const Rigid3 motion{RotationZ(M_PI / 2), {30.0, -20.0, 5.0}};
  const RangeImage moved(motion.Apply(points), motion.translation, kVoxel);
  int num_free = 0;
  int num_different = 0;
  for (const auto query : queries.colwise()) {
    const Sight sight = image.At(query, kMargin);
    num_free += sight == Sight::kFree;
    num_different +=
        sight != moved.At(motion * Eigen::Vector3d(query), kMargin);
  }
  EXPECT_GT(num_free, 100);
  EXPECT_LE(num_different, 2);  // Rounding at cell borders.
}

TEST_F(RangeImageTest, WithoutPointsAllIsUnknown) {
  EXPECT_EQ(At({}, {1.0, 2.0, 3.0}), Sight::kUnknown);
  // A point at the sensor makes nothing known either.
  EXPECT_EQ(At({{0.0, 0.0, 0.0}}, {1.0, 2.0, 3.0}), Sight::kUnknown);
}

}  // namespace
}  // namespace quatro::free_space_test
