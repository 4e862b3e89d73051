// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Quatro on slopes: an INS provides roll and pitch, and only a rotation about
// the vertical remains to be estimated,
//
//   target_from_source = level_from_target^-1 R_z(yaw) level_from_source.  (1)
//
// Matches and clouds are rotated into the level frames, once
// (robust/registration/level.h). The estimator finds yaw and translation there,
// and (1) transforms its pose back. There are three modes:
//
//   relative  level_from_source = R_y R_x of the INS' rotation from source to
//             target = R_z R_y R_x, level_from_target = I. This is the
//             paper's mode. The difference of the INS' yaws must be correct,
//             too.
//   leveled   Each cloud is leveled by its own roll and pitch. The yaws are not
//             used.
//   fused     As leveled; then the whole pose is refined on the inliers with
//             the INS as a prior (solvers/ceres/ins_refinement.h). This
//             corrects errors of the INS where the matches are more certain.
//
// If an INS knows only the rotation from source to target, use AttitudeOf() of
// it as the source's attitude and zeros as the target's. Relative and leveled
// are then the same.

#ifndef QUATRO_ROBUST_REGISTRATION_INS_H_
#define QUATRO_ROBUST_REGISTRATION_INS_H_

#include <Eigen/Core>
#include <string>

#include "features/base/types.h"
#include "robust/estimators/pose_summary.h"
#include "solvers/closed_form/gravity.h"

namespace quatro {

// How the INS is used.
enum class InsMode { kNone, kRelative, kLeveled, kFused };

// Where the vertical comes from (robust/registration/gravity.h).
enum class Gravity {
  kGiven,  // `up`, and the INS if there is one.
  kScans,  // As kGiven; if that pose is not registered, the scans themselves.
  kNone,   // The scans themselves; as kGiven only if they give no vertical.
};

// The attitudes from the INS, and their uncertainty.
struct InsOptions {
  InsMode mode = InsMode::kNone;  // kNone: only `up` has an effect.

  // World from body; both in the same world, whose z axis is up.
  Attitude source_attitude;
  Attitude target_attitude;

  // The standard deviation of each roll and each pitch [rad], for the
  // covariance and for InsMode::kFused. Errors of source and target are
  // independent, so the standard deviation of the tilt between the clouds is
  // sqrt(2) times as large.
  double attitude_std = 0.0087;

  // For InsMode::kFused: the standard deviation of an inlier on each axis [m];
  // 0 means a third of the noise bound. Only the ratio to attitude_std matters.
  // Errors of real matches are not independent, so many matches may contain
  // less information than (1) of solvers/ceres/ins_refinement.h assumes.
  double match_std = 0.0;

  // The upward direction in a cloud whose roll and pitch are zero, a unit
  // vector. RotationBetween(up, z) rotates the cloud's axes into the body's.
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();

  // With an INS, with bounds on the pose, without clouds, or for a method that
  // searches no other poses, kScans has no effect and kNone is an error. Local
  // registration ignores both.
  Gravity gravity = Gravity::kGiven;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;

  // True if the INS and the axis have no effect: mode is kNone and up is z.
  bool IsPlain() const;
};

// Rotations into frames whose z axis is up. For InsMode::kRelative, up in the
// target is `up`.
struct LevelFrames {
  Eigen::Matrix3d level_from_source;
  Eigen::Matrix3d level_from_target;

  // Whether the clouds are level as they are.
  bool AreIdentity() const {
    return level_from_source.isIdentity(0.0) &&
           level_from_target.isIdentity(0.0);
  }
};

// The level frames of a mode.
LevelFrames MakeLevelFrames(const InsOptions& ins);

// Runs any solver on matches in level frames, with z up. Sets the standard
// deviation of the assumed vertical, and for InsMode::kFused refines the pose
// with the INS as a prior; the pose before the refinement is then the
// unpolished one. Estimators of the full rotation benefit only from kFused.
// `noise_bound` is that of the solver [m].
PoseSummary SolveLevel(const PointsRef& source,
                       const PointsRef& target,
                       const PoseSolver& solver,
                       double noise_bound,
                       const InsOptions& ins);

}  // namespace quatro

#endif  // QUATRO_ROBUST_REGISTRATION_INS_H_
