// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Level frames from the scans themselves, for clouds whose vertical is unknown
// or is not the one stated. Two ways to find them; each is a proposal, and the
// verdict decides whether the pose found in it is registered:
//
//   by matches   T of a solver in SO(3) (TEASER++): R is the rotation between
//                the clouds, and with it
//                  level_from_source = level_from_target R,               (1)
//                so that only translation and a small yaw remain
//   by normals   z along the commonest normal of each cloud, as oriented toward
//                the sensor: outdoors that of the ground
//
// By matches works for any two clouds with enough inliers, by normals also far
// apart, where the yaw-only model is needed to find any consensus.

#ifndef QUATRO_ROBUST_REGISTRATION_GRAVITY_H_
#define QUATRO_ROBUST_REGISTRATION_GRAVITY_H_

#include <Eigen/Core>
#include <optional>

#include "features/described_cloud.h"
#include "robust/estimators/pose_summary.h"
#include "robust/registration/front_end.h"
#include "robust/registration/ins.h"

namespace quatro {

// The commonest direction u of the normals: that with the most n_i within 10
// deg, then the mean of these. A unit vector; nullopt with fewer than 50
// normals.
std::optional<Eigen::Vector3d> FindCommonNormal(const DescribedCloud& cloud);

// By matches: z is the commonest normal of both clouds under R. Returns nullopt
// if the solver finds no pose, or there is no such normal.
std::optional<LevelFrames> LevelByMatches(const MatchedClouds& clouds,
                                          const PoseSolver& solver);

// By normals. Returns nullopt if either cloud has no common one.
std::optional<LevelFrames> LevelByNormals(const MatchedClouds& clouds);

}  // namespace quatro

#endif  // QUATRO_ROBUST_REGISTRATION_GRAVITY_H_
