// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Voxelized generalized ICP: solvers/local/local_alignment.h with, for the N
// target points q_j in the voxel that contains R p_i + t,
//
//   q_i = mean q_j,   W_i = N (mean C_j + R B_i R^T)^-1,                    (1)
//
// where B_i and C_j are the covariances of the surfaces at p_i and q_j
// (solvers/local/plane_alignment.h). Each point takes one voxel lookup instead
// of a search for neighbors. Voxels are cubes anchored at the origin of the
// target. A point in an empty voxel has no correspondence.
//
// A term is weighted by the number of points in its voxel. So the kernel takes
// effect at the same distance as in G-ICP if its width is sqrt(N) times as
// large.
//
// Source: Koide, Yokozuka, Oishi and Banno, "Voxelized GICP for Fast and
// Accurate 3D Point Cloud Registration", ICRA 2021.

#ifndef QUATRO_SOLVERS_LOCAL_VGICP_H_
#define QUATRO_SOLVERS_LOCAL_VGICP_H_

#include <memory>
#include <string>

#include "features/base/rigid3.h"
#include "features/base/types.h"
#include "features/described_cloud.h"
#include "solvers/local/local_alignment.h"
#include "solvers/local/plane_alignment.h"

namespace quatro {

// Options of the iteration, the plane model and the voxels.
struct VgicpOptions : PlaneAlignmentOptions {
  double voxel_size = 1.0;  // [m]

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// The source must outlive the terms. The target must be less than 2^21 voxels
// wide.
std::unique_ptr<AlignmentTerms> MakeVgicpTerms(const DescribedCloud& source,
                                               const DescribedCloud& target,
                                               const VgicpOptions& options);

// Aligns the source with the target, starting at the given pose.
AlignmentSummary SolveVgicp(const DescribedCloud& source,
                            const DescribedCloud& target,
                            const Rigid3& initial_target_from_source,
                            const VgicpOptions& options);

// Builds trees and normals of both clouds, then aligns them.
AlignmentSummary SolveVgicp(const Points& source,
                            const Points& target,
                            const Rigid3& initial_target_from_source,
                            const VgicpOptions& options);

}  // namespace quatro

#endif  // QUATRO_SOLVERS_LOCAL_VGICP_H_
