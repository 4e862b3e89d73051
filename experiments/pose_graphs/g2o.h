// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Pose graphs as text in the format of g2o, with lines
//
//   VERTEX_SE2 id x y yaw
//   EDGE_SE2 from to x y yaw  I11 I12 I13 I22 I23 I33
//   VERTEX_SE3:QUAT id x y z qx qy qz qw
//   EDGE_SE3:QUAT from to x y z qx qy qz qw  I11 I12 ... I16 I22 ... I66
//   FIX id ...
//
// in any order, where I is the upper triangle of the information matrix. Empty
// lines and lines that start with # are ignored. The information of
// EDGE_SE3:QUAT refers to the rotation vector [rad], as in GTSAM and the
// example of Ceres; in g2o itself it refers to half of that.

#ifndef QUATRO_EXPERIMENTS_POSE_GRAPHS_G2O_H_
#define QUATRO_EXPERIMENTS_POSE_GRAPHS_G2O_H_

#include <optional>
#include <string>

#include "experiments/pose_graphs/pose_graph.h"

namespace quatro {

// Returns nullopt, with file, line and reason in *error, if a line has any
// other form, a number is not finite, a number of a pose is beyond 1e9, one of
// an information matrix is beyond 1e18, a quaternion is farther than 2 % from
// unit length, an information matrix is zero or not positive semi-definite, an
// id is used twice or undefined, or the file mixes both dimensions or has no
// poses.
// Quaternions are normalized.
std::optional<PoseGraph> ReadG2o(const std::string& path, std::string* error);

// Reading the text back recovers every number of the information and the
// translations bit for bit.
std::string FormatG2o(const PoseGraph& graph);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_POSE_GRAPHS_G2O_H_
