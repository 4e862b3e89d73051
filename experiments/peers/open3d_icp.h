// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Open3D's ICP and G-ICP on the same points, for comparison and as test
// oracles. Built only with -DQUATRO_WITH_OPEN3D=ON.
//
// The problem is the same as ours (solvers/local/icp.h, gicp.h), but the
// stopping criterion differs: Open3D stops once neither the share of
// correspondences nor their root mean square distance [m] changes by more than
// 1e-6. It does not report whether it converged. Its G-ICP computes its own
// normals from 20 neighbors.

#ifndef QUATRO_EXPERIMENTS_PEERS_OPEN3D_ICP_H_
#define QUATRO_EXPERIMENTS_PEERS_OPEN3D_ICP_H_

#include "features/base/rigid3.h"
#include "features/base/types.h"
#include "robust/registration/refinement.h"
#include "solvers/local/local_alignment.h"

namespace quatro {

// Uses these options: method (kIcp or kGicp), epsilon, correspondence distance
// and number of iterations. Sets pose, number of inliers, termination and
// message of the summary. If there is a pose, the termination is always
// kNotConverged.
AlignmentSummary AlignByOpen3d(const Points& source,
                               const Points& target,
                               const Rigid3& initial_target_from_source,
                               const RefinementOptions& options);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PEERS_OPEN3D_ICP_H_
