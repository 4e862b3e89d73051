// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Generated pose graphs with known true poses, by seed.
//
//   manhattan  a walk of 1 m steps on a grid of streets 5 m apart, in the
//              plane; loops between poses within 1.5 m of each other
//   sphere     a spiral on a sphere, in space, with steps of about 1 m at the
//              equator; loops between neighbors on successive turns of the
//              spiral
//
// Measurements are the true values with normal noise. An outlier loop is
// between two randomly drawn poses. Its measurement places them within 1 m of
// each other, at any heading, and more than 0.4 m from their true relative
// position.

#ifndef QUATRO_EXPERIMENTS_POSE_GRAPHS_POSE_GRAPH_WORLDS_H_
#define QUATRO_EXPERIMENTS_POSE_GRAPHS_POSE_GRAPH_WORLDS_H_

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "experiments/pose_graphs/pose_graph.h"

namespace quatro {

struct GraphWorldOptions {
  std::string world = "manhattan";  // Or sphere.
  int num_poses = 400;
  int num_loops = 200;       // Inliers and outliers together.
  double wrong_share = 0.5;  // Share of outliers among loops.

  // Outlier loops join poses at most this many steps apart; 0: no limit.
  int max_wrong_steps = 0;

  double translation_sigma = 0.02;  // [m], on each axis.
  double rotation_sigma = 0.005;    // [rad], about each axis.
  std::uint64_t seed = 0;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

struct GraphWorld {
  PoseGraph graph;  // Poses from odometry; the first is fixed.
  std::vector<Rigid3> true_world_from_pose;
  std::vector<bool> is_wrong;  // Per edge: an outlier.
};

// Returns nullopt with *error set if the options are invalid, or if the walk
// has fewer pairs of poses for inlier loops than requested.
std::optional<GraphWorld> MakeGraphWorld(const GraphWorldOptions& options,
                                         std::string* error);

// The graph without the outlier loops, with unchanged poses.
PoseGraph WithoutWrongLoops(const GraphWorld& world);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_POSE_GRAPHS_POSE_GRAPH_WORLDS_H_
