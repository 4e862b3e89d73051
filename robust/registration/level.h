// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Transforms between the frames of the clouds and level frames. Estimators and
// verdict work in level frames, with z up: clouds and matches are leveled once,
// and the summary is transformed back,
//
//   x_in_level = L x,   target_from_source = L_t^-1 T_level L_s,            (1)
//
// with rotations L_s of the source and L_t of the target (robust/registration/
// ins.h). If both are the identity, nothing is copied and nothing changes.

#ifndef QUATRO_ROBUST_REGISTRATION_LEVEL_H_
#define QUATRO_ROBUST_REGISTRATION_LEVEL_H_

#include "features/base/types.h"
#include "features/described_cloud.h"
#include "robust/estimators/pose_bounds.h"
#include "robust/registration/ins.h"
#include "robust/registration/summary.h"

namespace quatro {

// Rotates column by column, so that equal columns remain equal bit for bit. A
// product of matrices does not guarantee that.
Points Leveled(const Eigen::Matrix3d& level_from_cloud,
               const PointsRef& points);

// The cloud, its normals and its sensor in the level frame. Descriptors do not
// depend on the frame.
DescribedCloud Leveled(const Eigen::Matrix3d& level_from_cloud,
                       const DescribedCloud& cloud);

// The bounds on T_level. With an INS, its roll and pitch replace those of the
// guess, which need not be known.
PoseBounds Leveled(const LevelFrames& frames,
                   const InsOptions& ins,
                   const PoseBounds& bounds);

// Transforms everything in the summary except the matches back to the frames of
// the clouds by (1).
void TakeBack(const LevelFrames& frames, RegistrationSummary* summary);

}  // namespace quatro

#endif  // QUATRO_ROBUST_REGISTRATION_LEVEL_H_
