// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Open3D's ICP and G-ICP on the same points, to compare with and as oracles of
// tests. Built with -DQUATRO_WITH_OPEN3D=ON alone.
//
// The same problem as ours (solvers/local/icp.h, gicp.h) but for how it stops:
// once neither the share of points that correspond nor their mean distance
// changes by more than 1e-6 of itself. It does not tell whether it did. Normals
// of G-ICP are its own, of 20 neighbours.

#ifndef QUATRO_EXPERIMENTS_PEERS_OPEN3D_ICP_H_
#define QUATRO_EXPERIMENTS_PEERS_OPEN3D_ICP_H_

#include "features/base/rigid3.h"
#include "features/base/types.h"
#include "robust/registration/refinement.h"
#include "solvers/local/local_alignment.h"

namespace quatro {

// Of the options takes the method, kIcp or kGicp, epsilon, the distance of
// correspondents and the number of iterations. An answer is kNotConverged. Of
// the summary sets the pose, the number of inliers, termination and message.
AlignmentSummary AlignByOpen3d(const Points& source,
                               const Points& target,
                               const Rigid3& initial_target_from_source,
                               const RefinementOptions& options);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PEERS_OPEN3D_ICP_H_
