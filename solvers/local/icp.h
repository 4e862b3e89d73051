// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// ICP, point to point: solvers/local/local_alignment.h with
//
//   q_i = the target's point nearest to R p_i + t,    W_i = I.
//
// The width of a kernel is a distance [m]. On smooth surfaces convergence is
// slow, because nearest points resist sliding along the surface. For this
// reason, a plane sliding along itself also counts as observable.
//
// Source: Besl and McKay, "A Method for Registration of 3-D Shapes", PAMI 1992.

#ifndef QUATRO_SOLVERS_LOCAL_ICP_H_
#define QUATRO_SOLVERS_LOCAL_ICP_H_

#include <memory>

#include "features/base/rigid3.h"
#include "features/base/types.h"
#include "features/kd_tree.h"
#include "solvers/local/local_alignment.h"

namespace quatro {

// Both clouds must outlive the terms, and their points must be finite. The
// distance is in meters.
std::unique_ptr<AlignmentTerms> MakeIcpTerms(
    const Points& source,
    const KdTree& target,
    double max_correspondence_distance);

// Aligns the source with the target, starting at the given pose.
AlignmentSummary SolveIcp(const Points& source,
                          const KdTree& target,
                          const Rigid3& initial_target_from_source,
                          const LocalAlignmentOptions& options);

// Builds the tree of the target, then aligns.
AlignmentSummary SolveIcp(const Points& source,
                          const Points& target,
                          const Rigid3& initial_target_from_source,
                          const LocalAlignmentOptions& options);

}  // namespace quatro

#endif  // QUATRO_SOLVERS_LOCAL_ICP_H_
