// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Generalized ICP, plane to plane: solvers/local/local_alignment.h with
//
//   q_i = the target's point nearest to R p_i + t,
//   W_i = (C_i + R B_i R^T)^-1,   B, C = I - (1 - epsilon) n n^T,           (1)
//
// B of p_i and C of q_i, from the normals n of the surfaces there: known across
// the surface, epsilon, and not along it, 1. Where the points around show no
// plane there is no normal, and B or C is I.
//
// A kernel's width is a distance [m] along surfaces, sqrt(2) of it; across them
// an error counts 1 / sqrt(epsilon) times.
//
// Source: Segal, Haehnel and Thrun, "Generalized-ICP", RSS 2009.

#ifndef QUATRO_SOLVERS_LOCAL_GICP_H_
#define QUATRO_SOLVERS_LOCAL_GICP_H_

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <string>

#include "features/base/rigid3.h"
#include "features/base/types.h"
#include "features/described_cloud.h"
#include "solvers/local/local_alignment.h"

namespace quatro {

// The loop, and the shape of a plane.
struct GicpOptions {
  LocalAlignmentOptions alignment;
  double epsilon = 1e-3;   // In (0, 1).
  int num_neighbors = 20;  // For normals, where none are given.

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// All arguments must outlive the terms.
std::unique_ptr<AlignmentTerms> MakeGicpTerms(
    const DescribedCloud& source,
    const DescribedCloud& target,
    double max_correspondence_distance,
    double epsilon);

// Moves the source onto the target, from the given pose on.
AlignmentSummary SolveGicp(const DescribedCloud& source,
                           const DescribedCloud& target,
                           const Rigid3& initial_target_from_source,
                           const GicpOptions& options);

// The same without trees and normals at hand.
AlignmentSummary SolveGicp(const Points& source,
                           const Points& target,
                           const Rigid3& initial_target_from_source,
                           const GicpOptions& options);

// The direction of least spread of the `num_neighbors` points nearest to each,
// itself among them.
Points EstimateNearestNormals(const KdTree& tree,
                              int num_neighbors,
                              int num_threads);

// What `solve` makes of two clouds, once their trees and normals are made.
AlignmentSummary SolveWithNormals(
    const Points& source,
    const Points& target,
    const LocalAlignmentOptions& options,
    int num_neighbors,
    const std::function<AlignmentSummary(const DescribedCloud& source,
                                         const DescribedCloud& target)>& solve);

// B or C of (1).
inline Eigen::Matrix3d SurfaceCovariance(const Eigen::Vector3d& normal,
                                         double epsilon) {
  return Eigen::Matrix3d::Identity() -
         (1.0 - epsilon) * normal * normal.transpose();
}

}  // namespace quatro

#endif  // QUATRO_SOLVERS_LOCAL_GICP_H_
