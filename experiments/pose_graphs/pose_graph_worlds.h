// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Pose graphs with known answers, by seed.
//
//   manhattan  a walk of 1 m steps on a grid of streets 5 m apart, in the
//              plane; loops between poses within 1.5 m of each other
//   sphere     a spiral of 1 m steps on a sphere, in space; loops between
//              neighbours on turns that follow each other
//
// Measurements are normal about the truth. A wrong loop is between two poses
// drawn at random and says that they are within 1 m of each other, at any
// heading, and is more than 0.4 m from the truth.

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
  int num_loops = 200;       // Right and wrong together.
  double wrong_share = 0.5;  // Of the loops.

  // Wrong loops join poses that are this many steps apart at most; 0: any.
  int max_wrong_steps = 0;

  double translation_sigma = 0.02;  // [m], on each axis.
  double rotation_sigma = 0.005;    // [rad], about each axis.
  std::uint64_t seed = 0;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

struct GraphWorld {
  PoseGraph graph;  // Poses by the odometry alone; the first is fixed.
  std::vector<Rigid3> true_world_from_pose;
  std::vector<bool> is_wrong;  // By edge.
};

// Nullopt if the options are not valid, or the walk has fewer pairs of poses
// for right loops than are asked for; *error says so.
std::optional<GraphWorld> MakeGraphWorld(const GraphWorldOptions& options,
                                         std::string* error);

// The same graph without the wrong loops, poses as they are.
PoseGraph WithoutWrongLoops(const GraphWorld& world);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_POSE_GRAPHS_POSE_GRAPH_WORLDS_H_
