// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/kd_tree.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "features/base/simd.h"
#include "features/cell_neighborhoods.h"
#include "tests/support/random_problems.h"

namespace quatro::kd_tree_test {
namespace {

using ::testing::Contains;
using ::testing::IsEmpty;
using ::testing::SizeIs;

double SquaredDistance(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d d = a - b;
  return d.x() * d.x() + d.y() * d.y() + d.z() * d.z();
}

std::vector<Neighbor> BruteForceWithinRadius(const Points& points,
                                             const Eigen::Vector3d& query,
                                             double radius) {
  std::vector<Neighbor> neighbors;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const double d2 = SquaredDistance(query, points.col(i));
    if (d2 <= radius * radius) neighbors.push_back({i, d2});
  }
  return neighbors;
}

std::vector<double> BruteForceNearestDistances(const Points& points,
                                               const Eigen::Vector3d& query,
                                               int k) {
  std::vector<double> d2;
  for (const auto point : points.colwise()) {
    d2.push_back(SquaredDistance(query, point));
  }
  std::sort(d2.begin(), d2.end());
  d2.resize(std::min(d2.size(), static_cast<std::size_t>(k)));
  return d2;
}

// `size` points on each side of a grid, `step` [m] apart. If the step is not a
// power of two, distances tie up to rounding.
Points Grid(int size, double step) {
  Points points(3, size * size * size);
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    points.col(i) << static_cast<double>(i / size / size),
        static_cast<double>(i / size % size), static_cast<double>(i % size);
  }
  return step * points;
}

// Ten tight clusters far apart.
Points Clusters(Eigen::Index n, std::uint64_t seed) {
  const Points centers = RandomPoints(10, 100.0, seed);
  Points points = RandomPoints(n, 0.01, seed + 1);
  for (Eigen::Index i = 0; i < n; ++i) points.col(i) += centers.col(i % 10);
  return points;
}

struct NamedCloud {
  std::string name;
  Points points;
};

std::vector<NamedCloud> Clouds() {
  return {
      {"wide", RandomPoints(1000, 100.0, 1)},
      {"clustered", Clusters(1000, 2)},
      {"street", RandomStreet(1000, 0.02, 3)},
      {"grid of integers", Grid(8, 1.0)},
      {"grid of tenths", Grid(8, 0.1)},
      {"flat", RandomPlane(500, 10.0, 4).points},
      {"far away", RandomPoints(500, 10.0, 5).array() + 1e7},
      {"identical", Eigen::Vector3d(1.0, 2.0, 3.0).replicate(1, 300)},
      {"five", RandomPoints(5, 1.0, 6)},
      {"one", RandomPoints(1, 1.0, 7)},
      {"none", Points(3, 0)},
  };
}

// Points of the cloud, places between them, and places far outside.
Points Queries(const Points& points) {
  const Eigen::Index n = points.cols();
  if (n == 0) return RandomPoints(5, 1.0, 8);
  Points queries(3, 60);
  Random random(9);
  for (Eigen::Index i = 0; i < queries.cols(); ++i) {
    const auto a = static_cast<Eigen::Index>(random.Below(n));
    const auto b = static_cast<Eigen::Index>(random.Below(n));
    const double t = static_cast<double>(i % 3);
    queries.col(i) = points.col(a) + t * (points.col(b) - points.col(a));
    if (i % 4 == 3) queries.col(i) += RandomPoints(1, 1.0, 10).col(0);
  }
  return queries;
}

// Some fixed radii, and some that reach points of the cloud exactly.
std::vector<double> Radii(const Points& points, const Eigen::Vector3d& query) {
  std::vector<double> radii = {0.0, 0.01, 0.1, 0.3, 1.0, 3.0, 100.0};
  for (Eigen::Index i = 0; i < points.cols(); i += 1 + points.cols() / 20) {
    radii.push_back(std::sqrt(SquaredDistance(query, points.col(i))));
  }
  return radii;
}

// The neighbors that the tree finds for its point i, in order and bit for bit.
bool IsRowOf(const Neighborhoods::Row& row,
             const KdTree& tree,
             Eigen::Index i,
             double radius) {
  const auto found = tree.WithinRadius(tree.points().col(i), radius);
  if (row.size() != found.size() ||
      row.squared_distance.size() != found.size()) {
    return false;
  }
  for (std::size_t k = 0; k < found.size(); ++k) {
    if (row.index[k] != found[k].index ||
        row.squared_distance[k] !=
            static_cast<float>(found[k].squared_distance)) {
      return false;
    }
  }
  return true;
}

bool AreSame(const Neighborhoods& a, const Neighborhoods& b) {
  if (a.size() != b.size()) return false;
  for (Eigen::Index i = 0; i < a.size(); ++i) {
    if (!std::ranges::equal(a.row(i).index, b.row(i).index) ||
        !std::ranges::equal(a.row(i).squared_distance,
                            b.row(i).squared_distance)) {
      return false;
    }
  }
  return true;
}

TEST(KdTree, WithinRadiusIsTheClosedBallInOrderOfIndex) {
  for (const auto& [name, points] : Clouds()) {
    SCOPED_TRACE(name);
    const KdTree tree(points);
    const Points queries = Queries(points);
    for (const auto query : queries.colwise()) {
      for (const double radius : Radii(points, query)) {
        const auto found = tree.WithinRadius(query, radius);
        const auto expected = BruteForceWithinRadius(points, query, radius);
        ASSERT_EQ(found.size(), expected.size())
            << "radius " << radius << " about " << query.transpose();
        for (std::size_t i = 0; i < found.size(); ++i) {
          ASSERT_EQ(found[i].index, expected[i].index);
          ASSERT_EQ(found[i].squared_distance, expected[i].squared_distance);
        }
      }
    }
  }
}

TEST(KdTree, PointsExactlyAtTheRadiusAreWithinIt) {
  // The square of the radius is the point's squared distance, bit for bit. Wide
  // clouds and corners of grids make it likely that a tree prunes too early.
  int num_checked = 0;
  for (const auto& [name, points] : Clouds()) {
    SCOPED_TRACE(name);
    const KdTree tree(points);
    const Points queries = Queries(points);
    for (const auto query : queries.colwise()) {
      for (Eigen::Index i = 0; i < points.cols(); ++i) {
        const double d2 = SquaredDistance(query, points.col(i));
        const double radius = std::sqrt(d2);
        if (radius * radius != d2) continue;
        if (++num_checked % 5 != 0) continue;
        const auto found = tree.WithinRadius(query, radius);
        ASSERT_TRUE(std::any_of(
            found.begin(),
            found.end(),
            [&](const Neighbor& neighbor) { return neighbor.index == i; }))
            << "radius " << radius << " about " << query.transpose();
      }
    }
  }
  EXPECT_GT(num_checked, 10000);
}

TEST(KdTree, NearestAreTheNearestFirst) {
  for (const auto& [name, points] : Clouds()) {
    SCOPED_TRACE(name);
    const KdTree tree(points);
    const Points queries = Queries(points);
    for (const auto query : queries.colwise()) {
      for (const int k : {1, 2, 3, 10, 2000}) {
        const auto found = tree.Nearest(query, k);
        // Points at equal distances may come in any order, so indices are not
        // compared.
        const auto expected = BruteForceNearestDistances(points, query, k);
        ASSERT_EQ(found.size(), expected.size()) << "k = " << k;
        std::vector<Eigen::Index> indices;
        for (std::size_t i = 0; i < found.size(); ++i) {
          ASSERT_DOUBLE_EQ(found[i].squared_distance, expected[i])
              << "number " << i << " of " << k;
          ASSERT_EQ(found[i].squared_distance,
                    SquaredDistance(query, points.col(found[i].index)));
          indices.push_back(found[i].index);
        }
        std::sort(indices.begin(), indices.end());
        ASSERT_EQ(std::adjacent_find(indices.begin(), indices.end()),
                  indices.end())
            << "a point came twice";
      }
    }
  }
}

TEST(KdTree, NearestWithinIsTheNearestIfThereIsOne) {
  const Points points = RandomPoints(500, 2.0, 21);
  const KdTree tree(points);
  const Points queries = RandomPoints(200, 3.0, 22);
  int num_found = 0;
  for (const auto query : queries.colwise()) {
    const Neighbor nearest = tree.Nearest(query, 1).front();
    // The ball includes its boundary.
    const double distance = std::sqrt(nearest.squared_distance);
    for (const double radius : {0.5, distance * (1.0 + 1e-12)}) {
      const auto found = tree.NearestWithin(query, radius);
      ASSERT_EQ(found.has_value(), nearest.squared_distance <= radius * radius);
      if (!found) continue;
      ++num_found;
      EXPECT_EQ(found->index, nearest.index);
      EXPECT_EQ(found->squared_distance, nearest.squared_distance);
    }
    EXPECT_FALSE(tree.NearestWithin(query, 0.999 * distance));
  }
  EXPECT_GT(num_found, 220);
  EXPECT_LT(num_found, 380);
  // The point itself at distance zero, and one exactly at the radius.
  EXPECT_EQ(tree.NearestWithin(points.col(3), 0.0)->index, 3);
  EXPECT_TRUE(KdTree(Points::Zero(3, 1)).NearestWithin({3.0, 0.0, 4.0}, 5.0));
}

TEST(KdTree, NearestIsEmptyForNoneAskedFor) {
  const KdTree tree(RandomPoints(10, 1.0, 1));
  EXPECT_THAT(tree.Nearest(Eigen::Vector3d::Zero(), 0), IsEmpty());
}

TEST(KdTree, EmptyTreeFindsNothing) {
  const KdTree tree(Points(3, 0));
  EXPECT_EQ(tree.points().cols(), 0);
  EXPECT_THAT(tree.WithinRadius(Eigen::Vector3d::Zero(), 1.0), IsEmpty());
  EXPECT_THAT(tree.Nearest(Eigen::Vector3d::Zero(), 3), IsEmpty());
  const Neighborhoods none = FindNeighborhoods(tree, 1.0, 2);
  EXPECT_EQ(none.size(), 0);
  EXPECT_EQ(none.num_neighbors(), 0u);
  EXPECT_FALSE(tree.NearestWithin({0.0, 0.0, 0.0}, 1.0));
}

TEST(KdTree, UnboundedRadiusFindsEveryPoint) {
  const KdTree tree(RandomPoints(100, 10.0, 1));
  EXPECT_THAT(tree.WithinRadius(Eigen::Vector3d::Zero(),
                                std::numeric_limits<double>::infinity()),
              SizeIs(100));
}

TEST(KdTree, MovingTheTreeKeepsItsPoints) {
  const Points points = RandomPoints(100, 1.0, 1);
  KdTree tree(points);
  KdTree moved(std::move(tree));
  KdTree assigned(RandomPoints(3, 1.0, 2));
  assigned = std::move(moved);
  EXPECT_EQ(assigned.points(), points);
  EXPECT_EQ(assigned.Nearest(points.col(42), 1).front().index, 42);
}

TEST(FindNeighborhoods, RowsAreTheBallsAboutEachPoint) {
  for (const auto& [name, points] : Clouds()) {
    SCOPED_TRACE(name);
    const KdTree tree(points);
    for (const double radius : {0.05, 0.1, 1.0, 10.0}) {
      const Neighborhoods rows = FindNeighborhoods(tree, radius, 1);
      ASSERT_EQ(rows.size(), points.cols());
      ASSERT_TRUE(AreSame(rows, FindNeighborhoodsByTree(tree, radius, 2)));
      for (Eigen::Index i = 0; i < points.cols(); ++i) {
        ASSERT_TRUE(IsRowOf(rows.row(i), tree, i, radius)) << "point " << i;
        ASSERT_THAT(rows.row(i).index, Contains(i));
      }
    }
  }
}

TEST(FindNeighborhoodsByCells, IsTheSameByAnyInstructions) {
  for (const auto& [name, points] : Clouds()) {
    SCOPED_TRACE(name);
    const KdTree tree(points);
    for (const double radius : {0.01, 0.1, 1.0}) {
      for (const SimdLevel level :
           {SimdLevel::kBaseline, SimdLevel::kAvx2, SimdLevel::kAvx512}) {
        if (level > BestSimdLevel()) continue;
        const auto rows = FindNeighborhoodsByCells(points, radius, 1, level);
        ASSERT_TRUE(rows);
        for (Eigen::Index i = 0; i < points.cols(); ++i) {
          ASSERT_TRUE(IsRowOf(rows->row(i), tree, i, radius)) << "point " << i;
        }
      }
    }
  }
}

TEST(FindNeighborhoodsByCells, CloudsWiderThanItsCellsAreLeftToTheTree) {
  Points points = RandomPoints(50, 1.0, 1);
  const auto by_cells = [&](double radius) {
    return FindNeighborhoodsByCells(points, radius, 1, SimdLevel::kBaseline);
  };
  EXPECT_TRUE(by_cells(1.0));
  EXPECT_FALSE(by_cells(0.0));
  points(1, 7) = 2e6;
  EXPECT_TRUE(by_cells(2.0));
  EXPECT_FALSE(by_cells(1.0));
  const Neighborhoods rows = FindNeighborhoods(KdTree(points), 1.0, 1);
  EXPECT_EQ(rows.row(7).size(), 1u);
  EXPECT_GT(rows.num_neighbors(), 200u);
}

TEST(FindNeighborhoods, DoesNotDependOnTheNumberOfThreads) {
  const KdTree tree(RandomStreet(3000, 0.02, 1));
  const Neighborhoods one = FindNeighborhoods(tree, 0.6, 1);
  ASSERT_GT(one.num_neighbors(), 10000u);
  for (const int num_threads : {0, 2, 3}) {
    const Neighborhoods several = FindNeighborhoods(tree, 0.6, num_threads);
    EXPECT_TRUE(AreSame(several, one)) << num_threads << " threads";
  }
}

TEST(FindNearestNeighborhoods, RowsAreTheNearestOfEachPoint) {
  for (const auto& [name, points] : Clouds()) {
    const KdTree tree(points);
    const Neighborhoods two = FindNearestNeighborhoods(tree, 7, 2);
    const Neighborhoods one = FindNearestNeighborhoods(tree, 7, 1);
    EXPECT_TRUE(AreSame(one, two)) << name;
    ASSERT_EQ(one.size(), points.cols()) << name;
    for (Eigen::Index i = 0; i < one.size(); ++i) {
      const Neighborhoods::Row& row = one.row(i);
      const std::vector<double> expected =
          BruteForceNearestDistances(points, points.col(i), 7);
      ASSERT_EQ(row.size(), expected.size());
      std::vector<double> distances;
      for (std::size_t k = 0; k < row.size(); ++k) {
        const double d2 =
            SquaredDistance(points.col(i), points.col(row.index[k]));
        EXPECT_EQ(row.squared_distance[k], static_cast<float>(d2));
        distances.push_back(d2);
      }
      EXPECT_EQ(distances, expected) << name;
    }
  }
}

TEST(FindNearestNeighborhoods, FewerPointsThanAskedForAreAllFound) {
  const KdTree tree(RandomPoints(3, 1.0, 1));
  const Neighborhoods all = FindNearestNeighborhoods(tree, 20, 1);
  for (Eigen::Index i = 0; i < 3; ++i) {
    ASSERT_EQ(all.row(i).size(), 3u);
    EXPECT_EQ(all.row(i).index[0], i);
    EXPECT_EQ(all.row(i).squared_distance[0], 0.0f);
  }
  EXPECT_EQ(FindNearestNeighborhoods(KdTree(Points(3, 0)), 20, 1).size(), 0);
}

}  // namespace
}  // namespace quatro::kd_tree_test
