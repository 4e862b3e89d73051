// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// PCL's ICP and G-ICP on the same points, for comparison and as test oracles.
// Built only with -DQUATRO_WITH_PCL=ON.
//
// PCL uses single precision, so points are passed relative to the target's
// mean. Like ours, it stops when its pose changes by less than the tolerances,
// by default 1e-3 m and 1e-4 rad. Its G-ICP minimizes with BFGS and computes
// covariances from 20 neighbors.

#ifndef QUATRO_EXPERIMENTS_PEERS_PCL_ICP_H_
#define QUATRO_EXPERIMENTS_PEERS_PCL_ICP_H_

#include "features/base/rigid3.h"
#include "features/base/types.h"
#include "robust/registration/refinement.h"
#include "solvers/local/local_alignment.h"

namespace quatro {

// Uses these options: method (kIcp or kGicp), correspondence distance,
// tolerances and number of iterations. Sets pose, number of inliers,
// termination and message of the summary.
AlignmentSummary AlignByPcl(const Points& source,
                            const Points& target,
                            const Rigid3& initial_target_from_source,
                            const RefinementOptions& options);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PEERS_PCL_ICP_H_
