// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Level frames from the scans themselves, for clouds whose vertical is unknown
// or stated incorrectly. There are two ways. Each gives a proposal, and the
// verdict decides whether the pose found with it is registered:
//
//   by matches   A solver of the full rotation (TEASER++) finds the rotation R
//                between the clouds. With
//                  level_from_source = level_from_target R,               (1)
//                only the translation and a small yaw remain.
//   by normals   z is the most common normal of each cloud, oriented toward the
//                sensor; outdoors it is the normal of the ground.
//
// Leveling by matches needs enough inliers. Leveling by normals also works for
// scans far apart, where only the yaw-only model finds a consensus.

#ifndef QUATRO_ROBUST_REGISTRATION_GRAVITY_H_
#define QUATRO_ROBUST_REGISTRATION_GRAVITY_H_

#include <Eigen/Core>
#include <optional>

#include "features/described_cloud.h"
#include "robust/estimators/pose_summary.h"
#include "robust/registration/front_end.h"
#include "robust/registration/ins.h"

namespace quatro {

// The most common direction of the normals, a unit vector: the normal with the
// most normals within 10 deg, then the mean of these. Returns nullopt if there
// are fewer than 50 normals.
std::optional<Eigen::Vector3d> FindCommonNormal(const DescribedCloud& cloud);

// By matches: z is the most common normal of both clouds, aligned by R. Returns
// nullopt if the solver finds no pose, or if there are fewer than 50 normals.
std::optional<LevelFrames> LevelByMatches(const MatchedClouds& clouds,
                                          const PoseSolver& solver);

// By normals. Returns nullopt if either cloud has fewer than 50 normals.
std::optional<LevelFrames> LevelByNormals(const MatchedClouds& clouds);

}  // namespace quatro

#endif  // QUATRO_ROBUST_REGISTRATION_GRAVITY_H_
