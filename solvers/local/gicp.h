// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Generalized ICP, plane to plane: solvers/local/local_alignment.h with
//
//   q_i = the target's point nearest to R p_i + t,
//   W_i = (C_i + R B_i R^T)^-1,   B, C = I - (1 - epsilon) n n^T,           (1)
//
// B belongs to p_i and C to q_i; n are the unit normals of the surfaces there.
// The variance is epsilon across the surface and 1 along it. If the neighbors
// of a point show no plane, it has no normal, and its covariance is I.
//
// The width of a kernel is sqrt(2) times a distance [m] along surfaces. An
// error across them counts 1 / sqrt(epsilon) times as much.
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

// Options of the iteration and of the plane model.
struct GicpOptions {
  LocalAlignmentOptions alignment;
  double epsilon = 1e-3;   // In (0, 1).
  int num_neighbors = 20;  // For normals, if none are given.

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// All arguments must outlive the terms.
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

// Builds trees and normals, then aligns.
AlignmentSummary SolveGicp(const Points& source,
                           const Points& target,
                           const Rigid3& initial_target_from_source,
                           const GicpOptions& options);

// The direction of least variance of the `num_neighbors` points nearest to each
// point, including itself.
Points EstimateNearestNormals(const KdTree& tree,
                              int num_neighbors,
                              int num_threads);

// Builds trees and normals of both clouds, then returns the result of `solve`.
AlignmentSummary SolveWithNormals(
    const Points& source,
    const Points& target,
    const LocalAlignmentOptions& options,
    int num_neighbors,
    const std::function<AlignmentSummary(const DescribedCloud& source,
                                         const DescribedCloud& target)>& solve);

// The covariance B or C of (1).
inline Eigen::Matrix3d SurfaceCovariance(const Eigen::Vector3d& normal,
                                         double epsilon) {
  return Eigen::Matrix3d::Identity() -
         (1.0 - epsilon) * normal * normal.transpose();
}

}  // namespace quatro

#endif  // QUATRO_SOLVERS_LOCAL_GICP_H_
