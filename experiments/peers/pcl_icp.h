// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// PCL's ICP and G-ICP on the same points, to compare with and as oracles of
// tests. Built with -DQUATRO_WITH_PCL=ON alone.
//
// PCL keeps points in single precision: they are given about the target's mean.
// It stops on steps of its transform, 1e-3 m and 1e-4 rad as ours by default.
// Its G-ICP minimizes by BFGS, and takes covariances of 20 neighbours.

#ifndef QUATRO_EXPERIMENTS_PEERS_PCL_ICP_H_
#define QUATRO_EXPERIMENTS_PEERS_PCL_ICP_H_

#include "features/base/rigid3.h"
#include "features/base/types.h"
#include "robust/registration/refinement.h"
#include "solvers/local/local_alignment.h"

namespace quatro {

// Of the options takes the method, kIcp or kGicp, the distance of
// correspondents, tolerances and the number of iterations. Of the summary sets
// the pose, the number of inliers, termination and message.
AlignmentSummary AlignByPcl(const Points& source,
                            const Points& target,
                            const Rigid3& initial_target_from_source,
                            const RefinementOptions& options);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PEERS_PCL_ICP_H_
