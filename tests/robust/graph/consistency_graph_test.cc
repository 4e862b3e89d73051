// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/graph/consistency_graph.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "tests/support/matched_problems.h"

namespace quatro::consistency_graph_test {
namespace {

using ::testing::HasSubstr;

constexpr ConsistencyTest kAllTests[] = {ConsistencyTest::kLength,
                                         ConsistencyTest::kPlanar,
                                         ConsistencyTest::kPlanarAndHeight};

Graph Build(const Points& source,
            const Points& target,
            ConsistencyTest test,
            int num_threads = 1) {
  ConsistencyOptions options;
  options.test = test;
  return BuildConsistencyGraph(source, target, options, num_threads);
}

bool AreEqual(const Graph& a, const Graph& b) {
  if (a.num_vertices() != b.num_vertices()) return false;
  for (int i = 0; i < a.num_vertices(); ++i) {
    if (!std::ranges::equal(a.Row(i), b.Row(i))) return false;
  }
  return true;
}

int NumEdges(const Graph& graph) {
  int sum = 0;
  for (int i = 0; i < graph.num_vertices(); ++i) sum += graph.Degree(i);
  return sum / 2;
}

// The tests of robust/graph/consistency_test.h in double precision: how far
// matches i and j are inside the bound [m], negative if they fail.
double Margin(const KnownProblem& problem,
              const ConsistencyOptions& options,
              int i,
              int j) {
  const Eigen::Vector3d a = problem.source.col(i) - problem.source.col(j);
  const Eigen::Vector3d b = problem.target.col(i) - problem.target.col(j);
  if (options.test == ConsistencyTest::kLength) {
    return options.bound - std::abs(a.norm() - b.norm());
  }
  const double a_xy = a.head<2>().norm();
  const double b_xy = b.head<2>().norm();
  const double planar = options.bound - std::abs(a_xy - b_xy);
  if (options.test == ConsistencyTest::kPlanar) return planar;
  const double height = options.bound +
                        std::max(a_xy, b_xy) * std::sin(options.max_tilt) -
                        std::abs(a.z() - b.z());
  return std::min(planar, height);
}

TEST(ConsistencyGraph, EdgesAreThoseOfTheDefinition) {
  // Narrow boxes, so that each test passes some pairs and fails others.
  const KnownProblem problem = MakeMatchedProblem(
      {.num_outliers = 110, .half_widths = {6.0, 6.0, 3.0}}, /*seed=*/1);
  for (const ConsistencyTest test : kAllTests) {
    ConsistencyOptions options;
    options.test = test;
    options.bound = 0.7;
    options.max_tilt = 0.1;
    const Graph graph =
        BuildConsistencyGraph(problem.source, problem.target, options, 1);
    int num_edges = 0;
    int num_close_calls = 0;
    for (int i = 0; i < graph.num_vertices(); ++i) {
      for (int j = 0; j < i; ++j) {
        const double margin = Margin(problem, options, i, j);
        num_edges += margin > 0.0;
        if (std::abs(margin) < 1e-4) {
          ++num_close_calls;
          continue;
        }
        EXPECT_EQ(graph.HasEdge(i, j), margin > 0.0)
            << "test " << static_cast<int>(test) << ", matches " << i << " and "
            << j << ", margin " << margin << " m";
      }
    }
    EXPECT_LT(num_close_calls, 100);
    EXPECT_GT(num_edges, 1000);
    EXPECT_LT(num_edges, 10000);
  }
}

TEST(ConsistencyGraph, IsSymmetricWithoutLoopsOrBitsBeyondTheEnd) {
  for (const int n : {1, 2, 63, 64, 65, 130}) {
    const KnownProblem problem =
        MakeMatchedProblem({.num_inliers = n, .num_outliers = 0}, /*seed=*/2);
    for (const ConsistencyTest test : kAllTests) {
      const Graph graph = Build(problem.source, problem.target, test);
      ASSERT_EQ(graph.num_vertices(), n);
      for (int i = 0; i < n; ++i) {
        // A bit beyond the last vertex would be counted too.
        EXPECT_EQ(graph.Degree(i), n - 1) << "vertex " << i << " of " << n;
        EXPECT_FALSE(graph.HasEdge(i, i)) << "vertex " << i << " of " << n;
        for (int j = 0; j < n; ++j) {
          EXPECT_EQ(graph.HasEdge(i, j), graph.HasEdge(j, i));
        }
      }
    }
  }
}

TEST(ConsistencyGraph, OfNoMatchesHasNoVertices) {
  const Graph graph =
      Build(Points(3, 0), Points(3, 0), ConsistencyTest::kLength);
  EXPECT_EQ(graph.num_vertices(), 0);
}

TEST(ConsistencyGraph, NumberOfThreadsDoesNotMatter) {
  const KnownProblem problem =
      MakeMatchedProblem({.num_inliers = 300, .num_outliers = 300}, /*seed=*/3);
  for (const ConsistencyTest test : kAllTests) {
    const Graph expected = Build(problem.source, problem.target, test, 1);
    EXPECT_GT(NumEdges(expected), 300 * 299 / 2 - 1);
    for (const int num_threads : {0, 2, 3}) {
      EXPECT_TRUE(AreEqual(
          Build(problem.source, problem.target, test, num_threads), expected))
          << num_threads << " threads";
    }
  }
}

// Edges may change only if a length is at its bound.
TEST(ConsistencyGraph, MovingTheTargetByYawAndTranslationKeepsIt) {
  const KnownProblem problem = MakeMatchedProblem({}, /*seed=*/4);
  const Rigid3 motion{RotationZ(-2.5), {100.0, -30.0, 7.0}};
  for (const ConsistencyTest test : kAllTests) {
    EXPECT_TRUE(
        AreEqual(Build(problem.source, motion.Apply(problem.target), test),
                 Build(problem.source, problem.target, test)));
  }
}

TEST(ConsistencyGraph, SwappingSourceAndTargetKeepsIt) {
  const KnownProblem problem = MakeMatchedProblem({}, /*seed=*/5);
  for (const ConsistencyTest test : kAllTests) {
    EXPECT_TRUE(AreEqual(Build(problem.source, problem.target, test),
                         Build(problem.target, problem.source, test)));
  }
}

TEST(ConsistencyGraph, OnlyLengthAllowsATurnAboutAnyAxis) {
  KnownProblem problem =
      MakeMatchedProblem({.num_inliers = 30, .num_outliers = 0}, /*seed=*/6);
  problem.target = RandomRotation(6) * problem.source;
  const int all = 30 * 29 / 2;
  EXPECT_EQ(
      NumEdges(Build(problem.source, problem.target, ConsistencyTest::kLength)),
      all);
  EXPECT_LT(
      NumEdges(Build(problem.source, problem.target, ConsistencyTest::kPlanar)),
      all / 2);
}

TEST(ConsistencyGraph, OnlyPlanarKeepsMatchesThatAreWrongInHeight) {
  KnownProblem problem = MakeMatchedProblem(
      {.num_inliers = 20, .num_outliers = 0, .half_widths = {10.0, 10.0, 4.0}},
      /*seed=*/7);
  problem.target.row(2) *= -1.0;  // Heights inverted.
  problem.target.row(2) *= 3.0;
  const int all = 20 * 19 / 2;
  EXPECT_EQ(
      NumEdges(Build(problem.source, problem.target, ConsistencyTest::kPlanar)),
      all);
  EXPECT_LT(
      NumEdges(Build(
          problem.source, problem.target, ConsistencyTest::kPlanarAndHeight)),
      all / 4);
  EXPECT_LT(
      NumEdges(Build(problem.source, problem.target, ConsistencyTest::kLength)),
      all / 2);
}

TEST(ConsistencyGraph, HeightMayDifferByTheTiltOfTheDistance) {
  // The points are 50 m apart and one end is 2 m higher. The bound allows 0.6 m
  // of it, a tilt of 0.035 rad 1.75 m.
  Points source = Points::Zero(3, 2);
  source(0, 1) = 50.0;
  Points target = source;
  target(2, 1) = 2.0;
  ConsistencyOptions options;
  options.test = ConsistencyTest::kPlanarAndHeight;
  options.max_tilt = 0.0;
  EXPECT_FALSE(BuildConsistencyGraph(source, target, options, 1).HasEdge(0, 1));
  options.max_tilt = 0.035;
  EXPECT_TRUE(BuildConsistencyGraph(source, target, options, 1).HasEdge(0, 1));
}

TEST(ConsistencyGraph, LargeCoordinatesCostNoPrecision) {
  const KnownProblem problem = MakeMatchedProblem({}, /*seed=*/8);
  const Eigen::Vector3d far(1e7, -3e7, 1e5);  // [m], e.g. UTM.
  for (const ConsistencyTest test : kAllTests) {
    EXPECT_TRUE(
        AreEqual(Build(problem.source.colwise() + far, problem.target, test),
                 Build(problem.source, problem.target, test)));
  }
}

TEST(ConsistencyGraph, OneFarOutlierCostsTheOthersNoPrecision) {
  const KnownProblem problem = MakeMatchedProblem({}, /*seed=*/9);
  const auto n = static_cast<int>(problem.source.cols());
  for (const double far : {1e7, 1e12}) {
    Points source = problem.source;
    Points target = problem.target;
    source.conservativeResize(3, n + 1);
    target.conservativeResize(3, n + 1);
    source.col(n).setConstant(far);
    target.col(n).setConstant(-far);
    const Graph expected =
        Build(problem.source, problem.target, ConsistencyTest::kLength);
    const Graph graph = Build(source, target, ConsistencyTest::kLength);
    int num_differences = 0;
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < i; ++j) {
        num_differences += graph.HasEdge(i, j) != expected.HasEdge(i, j);
      }
    }
    EXPECT_EQ(num_differences, 0) << "outlier at " << far << " m";
  }
}

TEST(ConsistencyGraph, FarMatchesHaveTheEdgesOfTheDefinition) {
  // Half of the matches as far away as a float does not resolve the bound: on
  // both sides alike, but for some that are off.
  for (const double far : {1e7, 1e9, 1e12}) {
    KnownProblem problem = MakeMatchedProblem({}, /*seed=*/10);
    for (Eigen::Index i = 0; i < problem.source.cols(); i += 2) {
      problem.source.col(i) += Eigen::Vector3d(far, 0.0, 0.0);
      problem.target.col(i) = problem.source.col(i);
      problem.target(0, i) += 0.5 * static_cast<double>(i % 5);
    }
    for (const ConsistencyTest test : kAllTests) {
      ConsistencyOptions options;
      options.test = test;
      const Graph graph = Build(problem.source, problem.target, test);
      int num_edges = 0;
      for (int i = 0; i < graph.num_vertices(); i += 2) {
        for (int j = 0; j < graph.num_vertices(); ++j) {
          if (i == j) continue;
          const double margin = Margin(problem, options, i, j);
          if (std::abs(margin) < 1e-3) continue;
          EXPECT_EQ(graph.HasEdge(i, j), margin > 0.0)
              << far << " m, test " << static_cast<int>(test) << ", " << margin;
          EXPECT_EQ(graph.HasEdge(j, i), graph.HasEdge(i, j));
          num_edges += graph.HasEdge(i, j);
        }
      }
      EXPECT_GT(num_edges, 100);
      EXPECT_LT(num_edges, 2000);
    }
  }
}

TEST(ConsistencyGraph, LengthsThatNoDoubleResolvesHaveNoEdge) {
  Points points = Points::Zero(3, 3);
  points.row(0) << 0.0, 1.0, 1e16;
  const Graph graph = Build(points, points, ConsistencyTest::kLength);
  EXPECT_TRUE(graph.HasEdge(0, 1));
  EXPECT_EQ(graph.Degree(2), 0);
}

TEST(Graph, NeighborsComeInAscendingOrder) {
  Graph graph(130);
  for (const int j : {129, 3, 64, 63, 0}) graph.AddEdge(70, j);
  std::vector<int> neighbors;
  graph.ForEachNeighbor(70, [&](int j) { neighbors.push_back(j); });
  EXPECT_THAT(neighbors, ::testing::ElementsAre(0, 3, 63, 64, 129));
  EXPECT_EQ(graph.Degree(70), 5);
  EXPECT_EQ(graph.Degree(129), 1);
  EXPECT_TRUE(graph.HasEdge(129, 70));
  EXPECT_FALSE(graph.HasEdge(128, 70));
  graph.SetEdge(129, 70, false);
  EXPECT_FALSE(graph.HasEdge(129, 70));
  EXPECT_FALSE(graph.HasEdge(70, 129));
  EXPECT_EQ(graph.Degree(70), 4);
}

TEST(ConsistencyOptions, ErrorNamesTheFieldThatIsOutOfRange) {
  std::string error;
  EXPECT_TRUE(ConsistencyOptions().IsValid(&error)) << error;
  EXPECT_TRUE(error.empty());
  EXPECT_FALSE((ConsistencyOptions{.bound = 0.0}.IsValid(&error)));
  EXPECT_THAT(error, HasSubstr("bound = 0"));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE((ConsistencyOptions{.bound = nan}.IsValid(&error)));
  EXPECT_FALSE((ConsistencyOptions{.max_tilt = -0.1}.IsValid(&error)));
  EXPECT_THAT(error, HasSubstr("max_tilt = -0.1"));
  EXPECT_FALSE((ConsistencyOptions{.max_tilt = 1.6}.IsValid(&error)));
}

}  // namespace
}  // namespace quatro::consistency_graph_test
