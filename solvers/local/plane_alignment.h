// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The plane model that G-ICP and VG-ICP share: the surface at a point has the
// covariance
//
//   I - (1 - epsilon) n n^T,                                               (1)
//
// where n is its unit normal. The variance is epsilon across the surface and 1
// along it. If a point has no normal, because its neighbors are too few or on
// one line, its covariance is I.

#ifndef QUATRO_SOLVERS_LOCAL_PLANE_ALIGNMENT_H_
#define QUATRO_SOLVERS_LOCAL_PLANE_ALIGNMENT_H_

#include <Eigen/Core>
#include <functional>
#include <string>

#include "features/base/types.h"
#include "features/described_cloud.h"
#include "solvers/local/local_alignment.h"

namespace quatro {

// Options of the iteration and of the plane model.
struct PlaneAlignmentOptions {
  LocalAlignmentOptions alignment;
  double epsilon = 1e-3;   // In (0, 1).
  int num_neighbors = 20;  // For normals, if none are given.

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// The covariance (1).
inline Eigen::Matrix3d SurfaceCovariance(const Eigen::Vector3d& normal,
                                         double epsilon) {
  return Eigen::Matrix3d::Identity() -
         (1.0 - epsilon) * normal * normal.transpose();
}

// The direction of least variance of the `num_neighbors` points nearest to each
// point, including itself. Zero if they are all on one line.
Points EstimateNearestNormals(const KdTree& tree,
                              int num_neighbors,
                              int num_threads);

// Builds trees and normals of both clouds, then returns the result of `solve`
// with the times of both added. Does not call `solve` if CanAlign() is false.
AlignmentSummary SolveWithNormals(
    const Points& source,
    const Points& target,
    const PlaneAlignmentOptions& options,
    const std::function<AlignmentSummary(const DescribedCloud& source,
                                         const DescribedCloud& target)>& solve);

}  // namespace quatro

#endif  // QUATRO_SOLVERS_LOCAL_PLANE_ALIGNMENT_H_
