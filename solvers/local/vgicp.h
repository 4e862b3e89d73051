// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Voxelized generalized ICP: solvers/local/local_alignment.h with, of the N
// target points q_j in the voxel where R p_i + t is,
//
//   q_i = mean q_j,   W_i = N (mean C_j + R B_i R^T)^-1,                    (1)
//
// B and C as in solvers/local/gicp.h. No search for neighbors: one voxel is
// looked up a point. Voxels are cubes anchored at the origin of the target.
//
// A term counts as often as its voxel has points, so that a kernel's width is
// sqrt(N) times that of G-ICP.
//
// Source: Koide, Yokozuka, Oishi and Banno, "Voxelized GICP for Fast and
// Accurate 3D Point Cloud Registration", ICRA 2021.

#ifndef QUATRO_SOLVERS_LOCAL_VGICP_H_
#define QUATRO_SOLVERS_LOCAL_VGICP_H_

#include <memory>
#include <string>

#include "features/base/rigid3.h"
#include "features/base/types.h"
#include "solvers/local/gicp.h"
#include "solvers/local/local_alignment.h"

namespace quatro {

// The loop, the voxels, and the shape of a plane.
struct VgicpOptions {
  LocalAlignmentOptions alignment;
  double voxel_size = 1.0;  // [m]
  double epsilon = 1e-3;    // In (0, 1).
  int num_neighbors = 20;   // For normals, where none are given.

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// The source must outlive the terms. The target must be less than 2^21 voxels
// wide.
std::unique_ptr<AlignmentTerms> MakeVgicpTerms(const DescribedCloud& source,
                                               const DescribedCloud& target,
                                               const VgicpOptions& options);

// Moves the source onto the target, from the given pose on.
AlignmentSummary SolveVgicp(const DescribedCloud& source,
                            const DescribedCloud& target,
                            const Rigid3& initial_target_from_source,
                            const VgicpOptions& options);

// The same without trees and normals at hand.
AlignmentSummary SolveVgicp(const Points& source,
                            const Points& target,
                            const Rigid3& initial_target_from_source,
                            const VgicpOptions& options);

}  // namespace quatro

#endif  // QUATRO_SOLVERS_LOCAL_VGICP_H_
