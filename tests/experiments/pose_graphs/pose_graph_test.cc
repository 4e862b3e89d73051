// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <string>

#include "experiments/pose_graphs/pose_graph_problem.h"
#include "experiments/pose_graphs/pose_graph_protocol.h"
#include "experiments/pose_graphs/pose_graph_worlds.h"

namespace quatro::pose_graph_test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::Ge;
using ::testing::HasSubstr;
using ::testing::Le;

GraphWorld Make(const std::string& name,
                double wrong_share,
                std::uint64_t seed) {
  GraphWorldOptions options;
  options.world = name;
  options.num_poses = 200;
  options.num_loops = 100;
  options.wrong_share = wrong_share;
  options.seed = seed;
  std::string error;
  auto world = MakeGraphWorld(options, &error);
  EXPECT_TRUE(world.has_value()) << error;
  return *world;
}

PoseGraphOptions With(LoopLoss loss) {
  PoseGraphOptions options;
  options.loss = loss;
  return options;
}

class PoseGraphWorld : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Worlds,
                         PoseGraphWorld,
                         ::testing::Values("manhattan", "sphere"));

TEST_P(PoseGraphWorld, IsWhatItSays) {
  const GraphWorld world = Make(GetParam(), 0.3, 1);
  EXPECT_EQ(world.graph.ids.size(), 200u);
  EXPECT_EQ(world.graph.edges.size(), 299u);
  std::size_t num_wrong = 0;
  for (std::size_t i = 0; i < world.graph.edges.size(); ++i) {
    const PoseEdge& edge = world.graph.edges[i];
    const Rigid3 truth = Inverse(world.true_world_from_pose[edge.from]) *
                         world.true_world_from_pose[edge.to];
    const double error =
        (truth.translation - edge.from_from_to.translation).norm();
    if (world.is_wrong[i]) {
      ++num_wrong;
      EXPECT_GT(error, 0.3);
      EXPECT_FALSE(edge.IsOdometry());
    } else {
      EXPECT_LT(error, 0.15);
      EXPECT_LT(AngleBetween(truth.rotation, edge.from_from_to.rotation), 0.04);
      EXPECT_LT(truth.translation.norm(), 1.6);
    }
  }
  EXPECT_EQ(num_wrong, 30u);
}

TEST_P(PoseGraphWorld, DependsOnTheSeedAlone) {
  const GraphWorld a = Make(GetParam(), 0.5, 3);
  const GraphWorld b = Make(GetParam(), 0.5, 3);
  const GraphWorld c = Make(GetParam(), 0.5, 4);
  EXPECT_EQ(a.graph.edges[250].from_from_to.translation,
            b.graph.edges[250].from_from_to.translation);
  EXPECT_NE(a.graph.edges[250].from_from_to.translation,
            c.graph.edges[250].from_from_to.translation);
}

// Without noise the true poses have zero cost, and the initial poses do not.
TEST_P(PoseGraphWorld, WithoutNoiseTheTruthIsTheAnswer) {
  GraphWorld world = Make(GetParam(), 0.0, 5);
  for (PoseEdge& edge : world.graph.edges) {
    edge.from_from_to = Inverse(world.true_world_from_pose[edge.from]) *
                        world.true_world_from_pose[edge.to];
  }
  EXPECT_GT(
      LargestDifference(world.graph.world_from_pose, world.true_world_from_pose)
          .translation,
      1e-3);
  const auto summary = SolvePoseGraph(With(LoopLoss::kNone), &world.graph);
  ASSERT_TRUE(summary.is_usable) << summary.report;
  const auto difference = LargestDifference(world.graph.world_from_pose,
                                            world.true_world_from_pose);
  EXPECT_LT(difference.translation, 1e-7);
  EXPECT_LT(difference.rotation, 1e-8);
}

TEST_P(PoseGraphWorld, HalfOfTheLoopsWrongChangeNothing) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    GraphWorld world = Make(GetParam(), 0.5, seed);
    PoseGraph clean = WithoutWrongLoops(world);
    ASSERT_TRUE(SolvePoseGraph(With(LoopLoss::kNone), &clean).is_usable);

    PoseGraph plain = world.graph;
    ASSERT_TRUE(SolvePoseGraph(With(LoopLoss::kNone), &plain).is_usable);
    EXPECT_GT(LargestDifference(plain.world_from_pose, clean.world_from_pose)
                  .translation,
              1.0);

    const auto summary = SolvePoseGraph(With(LoopLoss::kGnc), &world.graph);
    ASSERT_TRUE(summary.is_usable) << summary.report;
    const auto difference =
        LargestDifference(world.graph.world_from_pose, clean.world_from_pose);
    EXPECT_LT(difference.translation, 1e-6) << "seed " << seed;
    EXPECT_LT(difference.rotation, 1e-6) << "seed " << seed;
    for (std::size_t i = 0; i < summary.weights.size(); ++i) {
      EXPECT_EQ(summary.weights[i], world.is_wrong[i] ? 0.0 : 1.0)
          << "seed " << seed << ", edge " << i;
    }
  }
}

TEST_P(PoseGraphWorld, AnswerDoesNotDependOnTheOrderOfLoops) {
  GraphWorld world = Make(GetParam(), 0.5, 7);
  PoseGraph turned = world.graph;
  std::reverse(turned.edges.begin(), turned.edges.end());
  ASSERT_TRUE(SolvePoseGraph(With(LoopLoss::kGnc), &world.graph).is_usable);
  ASSERT_TRUE(SolvePoseGraph(With(LoopLoss::kGnc), &turned).is_usable);
  EXPECT_LT(
      LargestDifference(world.graph.world_from_pose, turned.world_from_pose)
          .translation,
      1e-6);
}

// The solution equals plain least squares with these weights.
TEST_P(PoseGraphWorld, WeightsOfALossMakeItsAnswer) {
  for (const LoopLoss loss :
       {LoopLoss::kHuber, LoopLoss::kCauchy, LoopLoss::kTukey}) {
    GraphWorld world = Make(GetParam(), 0.1, 3);
    const auto summary = SolvePoseGraph(With(loss), &world.graph);
    ASSERT_TRUE(summary.is_usable) << summary.report;
    PoseGraph weighted = world.graph;
    weighted.edges.clear();
    std::size_t num_doubted = 0;
    for (std::size_t i = 0; i < summary.weights.size(); ++i) {
      const double weight = summary.weights[i];
      ASSERT_THAT(weight, AllOf(Ge(0.0), Le(1.0))) << "edge " << i;
      EXPECT_TRUE(weight == 1.0 || !world.graph.edges[i].IsOdometry()) << i;
      if (weight < 0.5) ++num_doubted;
      if (weight == 0.0) continue;
      weighted.edges.push_back(world.graph.edges[i]);
      weighted.edges.back().information *= weight;
    }
    EXPECT_GE(num_doubted, 5u);
    EXPECT_EQ(weighted.edges.size() < world.graph.edges.size(),
              loss == LoopLoss::kTukey);
    ASSERT_TRUE(SolvePoseGraph(With(LoopLoss::kNone), &weighted).is_usable);
    const auto difference = LargestDifference(world.graph.world_from_pose,
                                              weighted.world_from_pose);
    EXPECT_LT(difference.translation, 1e-5);
    EXPECT_LT(difference.rotation, 1e-5);
  }
}

// |r|^2 is e^T information e, with an information that is not diagonal.
TEST(PoseGraphProblemTest, ResidualsAreWhitened) {
  for (const int dimension : {2, 3}) {
    const int n = dimension == 2 ? 3 : 6;
    PoseGraph graph;
    graph.dimension = dimension;
    graph.ids = {0, 1};
    const Eigen::Vector3d t = dimension == 2 ? Eigen::Vector3d(0.3, -0.2, 0.0)
                                             : Eigen::Vector3d(0.3, -0.2, 0.5);
    graph.world_from_pose = {{}, {RotationZ(0.01), t}};
    PoseEdge edge;
    edge.to = 1;
    Eigen::MatrixXd a = Eigen::MatrixXd::Identity(n, n);
    a.triangularView<Eigen::StrictlyLower>().setConstant(0.7);
    edge.information = a * a.transpose();
    graph.edges = {edge};
    PoseGraphProblem problem(graph, With(LoopLoss::kNone));
    double cost = 0.0;
    problem.problem().Evaluate({}, &cost, nullptr, nullptr, nullptr);
    Eigen::VectorXd error = Eigen::VectorXd::Zero(n);
    error.head(dimension) = t.head(dimension);
    error[n - 1] = dimension == 2 ? 0.01 : 2.0 * std::sin(0.005);
    EXPECT_NEAR(2.0 * cost, error.dot(edge.information * error), 1e-12);
  }
}

// An edge of rank k has k residuals, with |r|^2 = e^T information e.
TEST(PoseGraphProblemTest, AnEdgeMayMeasureSomeFreedomsOnly) {
  for (const int dimension : {2, 3}) {
    const int n = dimension == 2 ? 3 : 6;
    for (int rank = 1; rank <= n; ++rank) {
      PoseGraph graph;
      graph.dimension = dimension;
      graph.ids = {0, 1};
      const Eigen::Vector3d t = dimension == 2
                                    ? Eigen::Vector3d(0.3, -0.2, 0.0)
                                    : Eigen::Vector3d(0.3, -0.2, 0.5);
      graph.world_from_pose = {{}, {RotationZ(0.01), t}};
      PoseEdge edge;
      edge.to = 1;
      Eigen::MatrixXd a = Eigen::MatrixXd::Identity(n, n);
      a.triangularView<Eigen::StrictlyLower>().setConstant(0.7);
      a.row(0) *= 1e3;  // Another unit.
      a = a.leftCols(rank).eval();
      edge.information = a * a.transpose();
      graph.edges = {edge};
      PoseGraphProblem problem(graph, With(LoopLoss::kNone));
      std::vector<double> residuals;
      problem.problem().Evaluate({}, nullptr, &residuals, nullptr, nullptr);
      EXPECT_EQ(residuals.size(), static_cast<std::size_t>(rank));
      Eigen::VectorXd error = Eigen::VectorXd::Zero(n);
      error.head(dimension) = t.head(dimension);
      error[n - 1] = dimension == 2 ? 0.01 : 2.0 * std::sin(0.005);
      const double expected = error.dot(edge.information * error);
      EXPECT_NEAR(
          Eigen::Map<Eigen::VectorXd>(residuals.data(), rank).squaredNorm(),
          expected,
          1e-9 * expected);
    }
  }
}

// Loops that measure the position alone, half of them outliers.
TEST_P(PoseGraphWorld, LoopsWithoutARotationAreSolved) {
  GraphWorld world = Make(GetParam(), 0.5, 1);
  const int n = world.graph.dimension;
  for (PoseEdge& edge : world.graph.edges) {
    if (edge.IsOdometry()) continue;
    edge.information.bottomRows(edge.information.rows() - n).setZero();
    edge.information.rightCols(edge.information.cols() - n).setZero();
  }
  ASSERT_TRUE(SolvePoseGraph(With(LoopLoss::kGnc), &world.graph).is_usable);
  const auto difference = LargestDifference(world.graph.world_from_pose,
                                            world.true_world_from_pose);
  EXPECT_LT(difference.translation, 0.5);
}

// The cost of one edge whose ends are rotated by `yaw`, with an information
// that couples x and the rotation, so that the sign of the rotation error
// matters.
double CostOfTurnedEdge(int dimension, double yaw) {
  const int n = dimension == 2 ? 3 : 6;
  PoseGraph graph;
  graph.dimension = dimension;
  graph.ids = {0, 1};
  const Rigid3 world_from_start{RotationZ(yaw), Eigen::Vector3d::Zero()};
  graph.world_from_pose = {
      world_from_start, world_from_start * Rigid3{RotationZ(0.3), {1, 0, 0}}};
  PoseEdge edge;
  edge.to = 1;
  edge.from_from_to = {RotationZ(0.29), {0.98, 0.0, 0.0}};
  edge.information = Eigen::MatrixXd::Identity(n, n);
  edge.information(0, n - 1) = edge.information(n - 1, 0) = 0.9;
  graph.edges = {edge};
  PoseGraphProblem problem(graph, With(LoopLoss::kNone));
  double cost = 0.0;
  problem.problem().Evaluate({}, &cost, nullptr, nullptr, nullptr);
  return cost;
}

TEST(PoseGraphProblemTest, HalfTurnsAreNoJump) {
  for (const int dimension : {2, 3}) {
    // The error of x is 0.02, that of the rotation 0.01. From 4.1 on, the
    // quaternions of the two ends have opposite signs.
    const double expected = 0.5 * (4e-4 + 1e-4 + 2.0 * 0.9 * 2e-4);
    for (const double yaw : {0.0, 1.0, 3.0, -3.1, M_PI - 0.15, 4.1}) {
      EXPECT_NEAR(CostOfTurnedEdge(dimension, yaw), expected, 1e-8)
          << dimension << ", yaw " << yaw;
    }
  }
}

TEST(PoseGraphProblemTest, InfiniteCostIsNoSolution) {
  for (const LoopLoss loss : {LoopLoss::kNone, LoopLoss::kGnc}) {
    for (const bool are_fixed : {false, true}) {
      PoseGraph graph;
      graph.dimension = 2;
      graph.ids = {0, 1};
      graph.world_from_pose.resize(2);
      graph.world_from_pose[0].translation.x() = 1e300;
      graph.edges.resize(1);
      graph.edges[0].from = 0;
      graph.edges[0].to = 1;
      graph.edges[0].information = Eigen::Matrix3d::Identity();
      if (are_fixed) graph.fixed = {0, 1};
      EXPECT_FALSE(SolvePoseGraph(With(loss), &graph).is_usable);
      EXPECT_EQ(graph.world_from_pose[0].translation.x(), 1e300);
    }
  }
}

TEST(PoseGraphWorldOptions, ErrorNamesTheFieldThatIsOutOfRange) {
  const auto expect_error = [](const GraphWorldOptions& options,
                               const char* what) {
    std::string error;
    EXPECT_FALSE(MakeGraphWorld(options, &error).has_value()) << what;
    EXPECT_THAT(error, HasSubstr(what));
  };
  expect_error({.world = "flat"}, "world = flat");
  expect_error({.num_poses = 10}, "poses = 10");
  expect_error({.num_loops = -1}, "loops = -1");
  expect_error({.num_loops = 100000}, "pairs of poses for inlier loops");
  expect_error({.wrong_share = 1.5}, "wrong_share = 1.5");
  expect_error({.translation_sigma = 0.0}, "sigma_m = 0");
  expect_error({.rotation_sigma = -1.0}, "sigma_deg = -57");
}

TEST(FirstOfParts, GoesByWeightsAndFixedPoses) {
  PoseGraph graph;
  graph.world_from_pose.resize(5);
  const auto add = [&](std::size_t from, std::size_t to) {
    graph.edges.emplace_back();
    graph.edges.back().from = from;
    graph.edges.back().to = to;
  };
  add(3, 4);
  add(1, 2);
  add(0, 1);
  add(4, 0);
  EXPECT_THAT(FirstOfParts(graph, {1.0, 1.0, 1.0, 0.1}), ElementsAre(0u));
  EXPECT_THAT(FirstOfParts(graph, {1.0, 1.0, 1.0, 0.0}), ElementsAre(0u, 3u));
  EXPECT_THAT(FirstOfParts(graph, {0.0, 1.0, 0.0, 0.0}),
              ElementsAre(0u, 1u, 3u, 4u));
  graph.fixed = {4, 2};
  EXPECT_THAT(FirstOfParts(graph, {0.0, 1.0, 0.0, 0.0}),
              ElementsAre(0u, 1u, 3u));
}

}  // namespace
}  // namespace quatro::pose_graph_test
