// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Pose graphs as text in the format of g2o, a line each of
//
//   VERTEX_SE2 id x y yaw
//   EDGE_SE2 from to x y yaw  I11 I12 I13 I22 I23 I33
//   VERTEX_SE3:QUAT id x y z qx qy qz qw
//   EDGE_SE3:QUAT from to x y z qx qy qz qw  I11 I12 ... I16 I22 ... I66
//   FIX id
//
// in any order, the information by its upper triangle. Empty lines and those
// that start with # are passed over. The information of EDGE_SE3:QUAT is taken
// over the rotation vector [rad], as GTSAM and Ceres' example do; g2o itself
// takes it over half of that.

#ifndef QUATRO_EXPERIMENTS_POSE_GRAPHS_G2O_H_
#define QUATRO_EXPERIMENTS_POSE_GRAPHS_G2O_H_

#include <optional>
#include <string>

#include "experiments/pose_graphs/pose_graph.h"

namespace quatro {

// Nullopt, with file, line and reason in *error, for any other line, a number
// that is not finite, a quaternion farther than 1e-3 from unit length, an
// information that is not positive definite, an id that is used twice or not at
// all, a file with both dimensions or without poses.
std::optional<PoseGraph> ReadG2o(const std::string& path, std::string* error);

// Every number of the information, and of translations, comes back bit for bit.
std::string FormatG2o(const PoseGraph& graph);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_POSE_GRAPHS_G2O_H_
