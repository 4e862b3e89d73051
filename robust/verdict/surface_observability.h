// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Which directions of a pose the overlapping surfaces of two aligned scans
// constrain. A surface point x with unit normal n constrains a motion (w, u) of
// the target about c by the displacement along the normal,
//
//   A = 1/N sum_i a_i a_i^T,   a_i = ( (x_i - c) x n_i ; n_i ).            (1)
//
// The sum is over the N points of either scan that overlap: the other scan has
// a point within the contact distance, and its normal, which is n_i, is within
// 37 deg (|cos| > 0.8). c is the mean of the x_i. A is in the target frame,
// rotation first. The part of a direction is its information in A; for a
// rotation, it is divided by the mean squared distance of the points from the
// axis. It is 1 for a motion along the normals everywhere, and 0 for a motion
// along the surfaces.
//
// In a corridor no surface faces the axis: walls, floor and ceiling fit at any
// position along it, even if the matches seem to constrain that position.

#ifndef QUATRO_ROBUST_VERDICT_SURFACE_OBSERVABILITY_H_
#define QUATRO_ROBUST_VERDICT_SURFACE_OBSERVABILITY_H_

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "features/base/rigid3.h"
#include "robust/verdict/contact.h"
#include "solvers/ceres/observability.h"

namespace quatro {

// When a direction counts as observable.
struct SurfaceObservabilityOptions {
  // A direction with a smaller part of (1), in [0, 1], is unobservable.
  double min_part = 0.01;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// Which directions the surfaces constrain, and how well.
struct SurfaceObservability {
  // (1): rotations in m^2, translations without unit.
  Matrix6 information = Matrix6::Zero();
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  // c, in the target [m].
  // Mean of (x_i - c) (x_i - c)^T [m^2].
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  Eigen::Index num_overlapping = 0;  // Points of both scans.
  Eigen::Index num_structure = 0;    // Overlapping points that are structure.

  // The horizontal direction d that the normals of overlapping structure
  // constrain least, and its share  sum (n.d)^2 / sum (n_x^2 + n_y^2):  0 in a
  // corridor, 1/2 if all directions are constrained alike.
  Eigen::Vector3d weakest_level_axis = Eigen::Vector3d::Zero();
  double weakest_level_share = 0.0;

  std::vector<UnobservableDirection> unobservable;
};

// Both clouds are level: z is up. `contacts` are those at this pose. Returns
// nullopt if fewer than 50 points overlap. With source and target swapped, the
// result is the same in the frame of the other cloud.
std::optional<SurfaceObservability> MeasureSurfaceObservability(
    const DescribedCloud& source,
    const DescribedCloud& target,
    const Rigid3& target_from_source,
    const MutualContacts& contacts,
    const SurfaceObservabilityOptions& options,
    int num_threads);

}  // namespace quatro

#endif  // QUATRO_ROBUST_VERDICT_SURFACE_OBSERVABILITY_H_
