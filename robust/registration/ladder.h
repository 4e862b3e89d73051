// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The ladder: further attempts if the estimator's pose is not registered.
//
//   rung 0  the estimator on the matches that passed the tuple test
//   rung 1  poses searched in all mutual matches
//           (robust/registration/pose_search.h)
//   rung 2  as rung 1, with coarser voxels and descriptors of larger radii
//   rung 3  as rung 1, with the matches of a second round (features/matching.h)
//
// Each rung takes its best candidate and, if that is not registered, the one
// that fits the geometry best, and runs the estimator on the inliers of the
// candidate. So the yaw comes from GNC with its certificate. Ten inliers
// determine a pose less accurately than the surfaces do, so the pose is then
// aligned with the clouds by VG-ICP in SE(3). If the structure of the scans
// fits the candidate better than this pose, the candidate is kept. The clouds
// are matched again near the pose (features/guided_matching.h), for the
// covariance and the verdict; all later stages are as usual. The ladder ends
// with the first pose that is registered; otherwise the pose with the highest
// probability is the answer.
//
// If few matches are inliers, the estimator finds no tilt between the scans, or
// an inaccurate one, and its pose may be registered although it is off by that
// tilt. Therefore such a pose is aligned with the clouds by VG-ICP, unless an
// INS gives the tilt or a refinement was accepted. If the aligned pose has a
// better geometric score, it becomes the candidate of rung 0, and its verdict
// counts.

#ifndef QUATRO_ROBUST_REGISTRATION_LADDER_H_
#define QUATRO_ROBUST_REGISTRATION_LADDER_H_

#include <vector>

#include "features/matching.h"
#include "robust/registration/front_end.h"
#include "robust/registration/level_registration.h"
#include "robust/registration/summary.h"

namespace quatro {

// `summary` is that of rung 0 on `matched_source` and `matched_target`, and is
// replaced if a better pose is found. The problem must have clouds.
// `mutual_matches` are all mutual matches of the front end. Returns the matches
// of the pose if it is from a higher rung, else none.
MatchedPoints Climb(const PointsRef& matched_source,
                    const PointsRef& matched_target,
                    const std::vector<Match>& mutual_matches,
                    const LevelProblem& problem,
                    RegistrationSummary* summary);

}  // namespace quatro

#endif  // QUATRO_ROBUST_REGISTRATION_LADDER_H_
