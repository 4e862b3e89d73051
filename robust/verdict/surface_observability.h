// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// What the surfaces that two aligned scans share hold of the pose. A surface
// point x with unit normal n holds a motion (w, u) of the target about c by
// what it moves along the normal,
//
//   A = 1/N sum_i a_i a_i^T,   a_i = ( (x_i - c) x n_i ; n_i ).            (1)
//
// All N points of either scan that are met in the other count, each half for
// its own: the nearest point there is within max_distance, and its normal,
// which is n_i, within 37 deg (|cos| > 0.8). c is their mean. A is in the
// target frame, rotation first. What a direction has of it, a rotation's over
// the mean squared distance from its axis, is its part: 1 for a motion along
// the normals everywhere, 0 for one along the surfaces.
//
// In a corridor nothing stands across: walls, floor and ceiling fit wherever
// along it. Matches may seem to hold what the surfaces do not.

#ifndef QUATRO_ROBUST_VERDICT_SURFACE_OBSERVABILITY_H_
#define QUATRO_ROBUST_VERDICT_SURFACE_OBSERVABILITY_H_

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "features/base/rigid3.h"
#include "robust/verdict/contact.h"
#include "robust/verdict/overlap.h"
#include "solvers/ceres/observability.h"

namespace quatro {

// From where on a direction counts as held.
struct SurfaceObservabilityOptions {
  double max_distance = 0.5;  // [m]

  // A direction with less of (1), each point's part in [0, 1], is not held.
  double min_part = 0.01;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// What surfaces hold, direction by direction.
struct SurfaceObservability {
  // (1): rotations in m^2, the rest of 1.
  Matrix6 information = Matrix6::Zero();
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  // c, in the target [m].
  // Mean of (x_i - c) (x_i - c)^T [m^2].
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  Eigen::Index num_overlapping = 0;  // Of both scans.
  Eigen::Index num_structure = 0;    // Of those, more than 45 deg from level.

  // Of the points that stand, the level direction d along which fewest normals
  // lie, and its share  sum (n.d)^2 / sum (n_x^2 + n_y^2)  in [0, 1/2]: 0 in a
  // corridor, 1/2 where all directions are alike.
  Eigen::Vector3d weakest_level_axis = Eigen::Vector3d::Zero();
  double weakest_level_share = 0.0;

  std::vector<UnobservableDirection> unobservable;
};

// Nullopt if fewer than 50 points are met. With source and target swapped it is
// the same, moved. Vertical is z in the target.
std::optional<SurfaceObservability> MeasureSurfaceObservability(
    const SurfaceCloud& source,
    const SurfaceCloud& target,
    const Rigid3& target_from_source,
    const SurfaceObservabilityOptions& options,
    int num_threads);

// The same with the contacts at the pose at hand, within options.max_distance.
std::optional<SurfaceObservability> MeasureSurfaceObservability(
    const SurfaceCloud& source,
    const SurfaceCloud& target,
    const Rigid3& target_from_source,
    const MutualContacts& contacts,
    const SurfaceObservabilityOptions& options,
    int num_threads);

}  // namespace quatro

#endif  // QUATRO_ROBUST_VERDICT_SURFACE_OBSERVABILITY_H_
