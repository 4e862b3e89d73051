// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Any solver within bounds on the pose (robust/estimators/pose_bounds.h):
//
//   matches -> those that can be inliers within the bounds -> solver
//           -> the pose, if the bounds contain it
//
// The filter is necessary, not sufficient: the pose of matches that pass it may
// still be outside of the bounds. Its inliers are then set aside, and the
// solver runs again on the other matches, until a pose is within the bounds,
// the solver finds none, or eight poses were set aside.

#ifndef QUATRO_ROBUST_ESTIMATORS_BOUND_SOLVER_H_
#define QUATRO_ROBUST_ESTIMATORS_BOUND_SOLVER_H_

#include "features/base/types.h"
#include "robust/estimators/pose_bounds.h"
#include "robust/estimators/pose_summary.h"

namespace quatro {

// Does nothing if the bounds contain the pose. Otherwise it removes the pose:
// its termination is kInsufficient, and its message says by how much the pose
// violates the bounds.
void RefuseOutside(const PoseBounds& bounds,
                   double noise_bound,
                   PoseSummary* summary);

// Returns a solver that runs `solver` on the matches that satisfy (2) and
// sets poses aside that violate (1). Columns in the summary refer to all
// matches. Returns `solver` itself if the bounds are not active.
PoseSolver BoundSolver(PoseSolver solver,
                       const PoseBounds& bounds,
                       double noise_bound);

}  // namespace quatro

#endif  // QUATRO_ROBUST_ESTIMATORS_BOUND_SOLVER_H_
