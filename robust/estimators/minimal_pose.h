// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A pose from a minimal number of matches, and fast tests that reject most
// samples with an outlier.
//
//   kThreePoints     R, t in SE(3) from three matches, least squares;
//   kTwoPoints       R_z(yaw), t from two matches, least squares;
//   kPointAndNormal  R_z(yaw), t from one match and the surface normals n, m at
//                    its ends:  yaw = angle(m_xy) - angle(n_xy),
//                               t = q - R_z(yaw) p.
//
// If the matches i and j are inliers with errors of at most b each, then
//
//   | |q_i - q_j| - |p_i - p_j| | <= 2 b,                                  (1)
//
// and samples that violate (1) are rejected before a pose is computed. Open3D
// tests a ratio instead,
//
//   s |p_i - p_j| <= |q_i - q_j|  and  s |q_i - q_j| <= |p_i - p_j|,       (2)
//
// which rejects some short sides of inliers and accepts some long sides that
// (1) rejects. On real scans, both help: short sides constrain the rotation
// poorly, and noise bounds are guesses. (1) rejects more samples and takes less
// time. Yaw-only samples must also pass the test with their planar lengths, and
// a test of their heights up to a tilt (robust/graph/consistency_test.h).

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

// The sample from which a pose is computed.
enum class MinimalSample { kThreePoints, kTwoPoints, kPointAndNormal };

// The number of matches in a sample: 3, 2 or 1.
int SampleSize(MinimalSample sample);

// The test that a sample must pass before a pose is computed from it.
enum class EdgeTest {
  kNone,
  kBound,  // (1)
  kRatio,  // (2)
};

// The sample and its tests.
struct MinimalPoseOptions {
  double noise_bound = 0.3;  // b, a radius [m].
  MinimalSample sample = MinimalSample::kThreePoints;
  EdgeTest edge_test = EdgeTest::kRatio;
  double edge_similarity = 0.9;  // s of (2), in (0, 1]; Open3D's default.

  // For yaw-only samples: the largest tilt between the scans, which changes
  // heights [rad].
  double max_tilt = 0.035;

  // For kPointAndNormal: a sample is rejected if the horizontal part of a
  // normal is shorter than min_normal_xy, because its azimuth is uncertain, or
  // if the z components of the normals differ by more than
  // max_normal_z_difference.
  double min_normal_xy = 0.5;
  double max_normal_z_difference = 0.2;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// Unit normals at the matched points, column by column, with the same
// orientation in both clouds (EstimateNormals() orients them toward the
// sensor).
struct MatchedNormals {
  Points source;
  Points target;
};

// Draws as many distinct columns in [0, n) as the sample needs; n must not be
// smaller than that. The remaining entries are -1.
std::array<Eigen::Index, 3> DrawSample(MinimalSample sample,
                                       Eigen::Index n,
                                       Random* random);

// The pose of the matches in `columns` [m]. Returns nullopt if the sample fails
// its tests or does not determine a pose. Only kPointAndNormal needs `normals`.
std::optional<Rigid3> EstimateMinimalPose(
    const PointsRef& source,
    const PointsRef& target,
    const MatchedNormals* normals,
    const std::array<Eigen::Index, 3>& columns,
    const MinimalPoseOptions& options);

}  // namespace quatro

#endif  // QUATRO_ROBUST_ESTIMATORS_MINIMAL_POSE_H_
