// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>
#include <malloc.h>

#include <cstdio>
#include <string>

#include "experiments/pose_graphs/pose_graph_problem.h"
#include "experiments/pose_graphs/pose_graph_worlds.h"
#include "robust/gnc/weighted_problem.h"

namespace quatro::pose_graph_large_test {
namespace {

GraphWorld MakeLarge(int num_poses) {
  GraphWorldOptions options;
  options.num_poses = num_poses;
  options.num_loops = 2 * num_poses;
  options.max_wrong_steps = 100;  // Keeps the factors sparse.
  std::string error;
  auto world = MakeGraphWorld(options, &error);
  EXPECT_TRUE(world.has_value()) << error;
  return *world;
}

TEST(LargePoseGraph, TimeIsThatOfTheInnerSolves) {
  GraphWorld world = MakeLarge(10000);
  PoseGraphOptions options;
  options.gnc.max_num_iterations = 3;  // All iterations are alike.
  options.solver.max_num_iterations = 2;
  const auto summary = SolvePoseGraph(options, &world.graph);
  ASSERT_TRUE(summary.is_usable) << summary.report;
  EXPECT_EQ(summary.gnc.inner.size(), 5u);  // With the last solve.
  const double ratio = summary.gnc.total_seconds / summary.gnc.solver_seconds;
  std::printf(
      "%.2f s, %.3f of the inner solves\n", summary.gnc.total_seconds, ratio);
  EXPECT_LT(ratio, 1.3);
}

// Bytes in use by the weighted twin of a graph, per residual block.
double TwinBytesPerBlock(int num_poses) {
  GraphWorld world = MakeLarge(num_poses);
  PoseGraphProblem problem(world.graph, PoseGraphOptions());
  const std::size_t before = mallinfo2().uordblks + mallinfo2().hblkhd;
  const WeightedProblem twin(problem.problem(), problem.ids(), {}, nullptr);
  const std::size_t after = mallinfo2().uordblks + mallinfo2().hblkhd;
  return static_cast<double>(after - before) /
         static_cast<double>(problem.ids().size());
}

TEST(LargePoseGraph, MemoryGrowsWithTheResidualBlocks) {
  const double small = TwinBytesPerBlock(2500);
  const double large = TwinBytesPerBlock(10000);
  std::printf("%.0f and %.0f bytes a block\n", small, large);
#if !defined(__SANITIZE_ADDRESS__)
  EXPECT_GT(small, 50.0);
  EXPECT_LT(large, 1.25 * small);
  EXPECT_LT(large, 2000.0);
#endif
}

}  // namespace
}  // namespace quatro::pose_graph_large_test
