// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Quatro on slopes: roll and pitch from an INS, so that a turn about the
// vertical is all that is left to find,
//
//   target_from_source = level_from_target^-1 R_z(yaw) level_from_source.  (1)
//
// Matches and clouds are rotated into the level frames, once
// (robust/registration/level.h); the estimator finds yaw and translation there,
// and (1) takes its answer back. There are three modes:
//
//   relative  level_from_source = R_y R_x of the INS' rotation from source to
//             target = R_z R_y R_x, level_from_target = I. The paper's; it
//             needs the difference of the INS' yaws to be right, too.
//   leveled   each cloud by its own roll and pitch. The yaws are not used.
//   fused     leveled, then all of the pose on the inliers with the INS as a
//             prior (solvers/ceres/ins_refinement.h), which takes out of the
//             answer what the INS is off by, as far as the matches know better.
//
// An INS that knows the rotation from source to target alone: give AttitudeOf()
// that as the source's attitude and zeros as the target's. Relative and leveled
// are then the same.

#ifndef QUATRO_ROBUST_REGISTRATION_INS_H_
#define QUATRO_ROBUST_REGISTRATION_INS_H_

#include <Eigen/Core>
#include <string>

#include "features/base/types.h"
#include "robust/estimators/pose_summary.h"
#include "solvers/closed_form/gravity.h"

namespace quatro {

// What is made of the INS.
enum class InsMode { kNone, kRelative, kLeveled, kFused };

// The INS' attitudes, and how far they are trusted.
struct InsOptions {
  InsMode mode = InsMode::kNone;  // kNone: of all this, `up` alone counts.

  // World from body, both in one world; its z is up.
  Attitude source_attitude;
  Attitude target_attitude;

  // For InsMode::kFused. Of each roll and pitch, the source's and the target's
  // independent of each other [rad]: the tilt between the clouds is off by
  // sqrt(2) times as much. Where one knows the deviation of that tilt instead,
  // this is 1 / sqrt(2) of it.
  double attitude_std = 0.0087;

  // For InsMode::kFused. Of a right match on each axis [m]; 0: a third of the
  // noise bound. Only its ratio to attitude_std counts. Errors of real matches
  // are not independent, so that many of them may say less than (1) of
  // solvers/ceres/ins_refinement.h makes of it.
  double match_std = 0.0;

  // What is up in a cloud whose roll and pitch are zero, a unit vector. The
  // body's axes are the cloud's turned by RotationBetween(up, z).
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;

  // True if the INS and the axis have no say: mode is kNone and up is z.
  bool IsPlain() const;
};

// Rotations that turn what is up into z; for InsMode::kRelative, up in the
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

// Those of the mode.
LevelFrames MakeLevelFrames(const InsOptions& ins);

// Any solver on matches in level frames, with z up. Sets the standard deviation
// of the assumed vertical, and for InsMode::kFused refines the pose with the
// INS as a prior; the pose before that is then the unpolished one. An estimator
// of the full rotation gains by kFused alone. `noise_bound` is the solver's
// [m].
PoseSummary SolveLevel(const PointsRef& source,
                       const PointsRef& target,
                       const PoseSolver& solver,
                       double noise_bound,
                       const InsOptions& ins);

}  // namespace quatro

#endif  // QUATRO_ROBUST_REGISTRATION_INS_H_
