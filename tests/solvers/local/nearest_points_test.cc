// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "solvers/local/nearest_points.h"

#include <gtest/gtest.h>

#include <cstdint>

#include "tests/support/random_problems.h"

namespace quatro::nearest_points_test {
namespace {

TEST(NearestPoints, AreThoseOfASearchAtEachPlace) {
  constexpr double kMaxDistance = 0.4;
  int num_found = 0;
  int num_out_of_reach = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const KdTree cloud(RandomPoints(200, 1.0, seed));
    Points queries = RandomPoints(100, 1.2, seed + 100);
    NearestPoints nearest(cloud, queries.cols(), kMaxDistance);
    for (std::uint64_t step = 0; step < 20; ++step) {
      for (Eigen::Index i = 0; i < queries.cols(); ++i) {
        const Neighbor expected = cloud.Nearest(queries.col(i), 1).front();
        const bool is_near =
            expected.squared_distance <= kMaxDistance * kMaxDistance;
        EXPECT_EQ(nearest.Find(i, queries.col(i)),
                  is_near ? expected.index : -1);
        ++(is_near ? num_found : num_out_of_reach);
      }
      // Steps from one meter down to one micrometer.
      queries += RandomPoints(queries.cols(),
                              std::pow(0.5, static_cast<double>(step)),
                              1000 * seed + step);
    }
  }
  EXPECT_GT(num_found, 1000);
  EXPECT_GT(num_out_of_reach, 1000);
}

TEST(NearestPoints, CloudOfOneOrNone) {
  const KdTree none(Points(3, 0));
  EXPECT_EQ(NearestPoints(none, 1, 1.0).Find(0, Eigen::Vector3d::Zero()), -1);
  const KdTree one(Points::Zero(3, 1));
  NearestPoints nearest(one, 1, 1.0);
  EXPECT_EQ(nearest.Find(0, Eigen::Vector3d::UnitX() * 2.0), -1);
  EXPECT_EQ(nearest.Find(0, Eigen::Vector3d::UnitX()), 0);
  EXPECT_EQ(nearest.Find(0, Eigen::Vector3d::UnitX() * 1.1), -1);
}

}  // namespace
}  // namespace quatro::nearest_points_test
