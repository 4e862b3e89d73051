// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Any solver within bounds on the pose (robust/estimators/pose_bounds.h):
//
//   matches -> matches that can be inliers within the bounds -> solver
//           -> the pose, if it is within the bounds
//
// The filter is necessary but not sufficient: the pose of matches that pass it
// may still be outside the bounds. Then the inliers of that pose are set aside,
// and the solver runs again on the other matches. This ends without a pose if
// the solver finds none, or if eight poses outside the bounds were set aside.

#ifndef QUATRO_ROBUST_ESTIMATORS_BOUND_SOLVER_H_
#define QUATRO_ROBUST_ESTIMATORS_BOUND_SOLVER_H_

#include "features/base/types.h"
#include "robust/estimators/pose_bounds.h"
#include "robust/estimators/pose_summary.h"

namespace quatro {

// Does nothing if the pose is within the bounds, or if there is none. Otherwise
// removes the pose. The termination is then kInsufficient, and the message says
// by how much the pose violates the bounds.
void RefuseOutside(const PoseBounds& bounds,
                   double noise_bound,
                   PoseSummary* summary);

// Returns a solver that runs `solver` on the matches that satisfy (2) of
// robust/estimators/pose_bounds.h, and sets aside poses that violate (1).
// Columns in its summary refer to all matches. Returns `solver` itself if the
// bounds are not active.
PoseSolver BoundSolver(PoseSolver solver,
                       const PoseBounds& bounds,
                       double noise_bound);

}  // namespace quatro

#endif  // QUATRO_ROBUST_ESTIMATORS_BOUND_SOLVER_H_
