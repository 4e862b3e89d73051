// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Generalized ICP, plane to plane: solvers/local/local_alignment.h with
//
//   q_i = the target's point nearest to R p_i + t,
//   W_i = (C_i + R B_i R^T)^-1,                                            (1)
//
// where B_i and C_i are the covariances of the surfaces at p_i and q_i
// (solvers/local/plane_alignment.h).
//
// A kernel of width c takes effect at a distance of sqrt(2) c [m] along the
// surfaces. A distance across them counts 1 / sqrt(epsilon) times as much.
//
// Source: Segal, Haehnel and Thrun, "Generalized-ICP", RSS 2009.

#ifndef QUATRO_SOLVERS_LOCAL_GICP_H_
#define QUATRO_SOLVERS_LOCAL_GICP_H_

#include <Eigen/Core>
#include <memory>

#include "features/base/rigid3.h"
#include "features/base/types.h"
#include "features/described_cloud.h"
#include "solvers/local/local_alignment.h"
#include "solvers/local/plane_alignment.h"

namespace quatro {

// Options are those of solvers/local/plane_alignment.h.
using GicpOptions = PlaneAlignmentOptions;

// Both clouds must outlive the terms, and each point needs a normal, which may
// be zero. The distance is in meters.
std::unique_ptr<AlignmentTerms> MakeGicpTerms(
    const DescribedCloud& source,
    const DescribedCloud& target,
    double max_correspondence_distance,
    double epsilon);

// Aligns the source with the target, starting at the given pose.
AlignmentSummary SolveGicp(const DescribedCloud& source,
                           const DescribedCloud& target,
                           const Rigid3& initial_target_from_source,
                           const GicpOptions& options);

// Builds trees and normals of both clouds, then aligns them.
AlignmentSummary SolveGicp(const Points& source,
                           const Points& target,
                           const Rigid3& initial_target_from_source,
                           const GicpOptions& options);

}  // namespace quatro

#endif  // QUATRO_SOLVERS_LOCAL_GICP_H_
