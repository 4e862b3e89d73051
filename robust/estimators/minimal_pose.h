// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A pose from as few matches as hold one, and quick tests of whether it is
// worth computing.
//
//   kThreePoints     R, t in SE(3) from three matches, least squares;
//   kTwoPoints       R_z(yaw), t from two matches, least squares;
//   kPointAndNormal  R_z(yaw), t from one match and the surface normals n, m at
//                    its ends:  yaw = angle(m_xy) - angle(n_xy),
//                               t = q - R_z(yaw) p.
//
// If p_i, q_i and p_j, q_j are right up to b each, then
//
//   | |q_i - q_j| - |p_i - p_j| | <= 2 b,                                  (1)
//
// and samples that break (1) can be dropped before any pose is computed. The
// test of Open3D is a ratio instead,
//
//   s |p_i - p_j| <= |q_i - q_j|  and  s |q_i - q_j| <= |p_i - p_j|,       (2)
//
// which drops short sides that are right and keeps long ones that can't be. On
// real scans the first is a gain, for short sides hold no rotation, and so is
// the second, for bounds are guesses; (1) drops more and takes less time.
// Yaw-only samples must pass for their planar lengths as well, and in height up
// to a tilt (robust/graph/consistency_graph.h).

#ifndef QUATRO_ROBUST_ESTIMATORS_MINIMAL_POSE_H_
#define QUATRO_ROBUST_ESTIMATORS_MINIMAL_POSE_H_

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>

#include "features/base/random.h"
#include "features/base/rigid3.h"
#include "features/base/types.h"

namespace quatro {

// What a pose is made from.
enum class MinimalSample { kThreePoints, kTwoPoints, kPointAndNormal };

// Matches in a sample: 3, 2 or 1.
int SampleSize(MinimalSample sample);

// What a sample must pass before a pose is made from it.
enum class EdgeTest {
  kNone,
  kBound,  // (1)
  kRatio,  // (2)
};

// The sample and its test.
struct MinimalPoseOptions {
  double noise_bound = 0.3;  // b [m]
  MinimalSample sample = MinimalSample::kThreePoints;
  EdgeTest edge_test = EdgeTest::kRatio;
  double edge_similarity = 0.9;  // s in (2), in (0, 1]; Open3D's default.

  // Of yaw-only samples: what roll and pitch may do to heights [rad].
  double max_tilt = 0.035;

  // For kPointAndNormal: normals that are steeper than this have no heading;
  // those whose z components differ by more are no match.
  double min_normal_xy = 0.5;
  double max_normal_z_difference = 0.2;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// Unit normals at the matched points, column by column, oriented alike in both
// clouds (EstimateNormals() turns them towards the sensor).
struct MatchedNormals {
  Points source;
  Points target;
};

// As many different columns of n as the sample takes, n no fewer, drawn from
// `random`; the others are -1.
std::array<Eigen::Index, 3> DrawSample(MinimalSample sample,
                                       Eigen::Index n,
                                       Random* random);

// Nullopt if the sample fails its test or holds no pose. `normals` are needed
// for kPointAndNormal alone.
std::optional<Rigid3> EstimateMinimalPose(
    const PointsRef& source,
    const PointsRef& target,
    const MatchedNormals* normals,
    const std::array<Eigen::Index, 3>& columns,
    const MinimalPoseOptions& options);

}  // namespace quatro

#endif  // QUATRO_ROBUST_ESTIMATORS_MINIMAL_POSE_H_
