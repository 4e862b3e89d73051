// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The geometric rival: the other pose with the largest overlap of structure.
//
// In a corridor a pose can slide along the walls; in a hall with equal ends it
// can be rotated by 180 deg. There the geometry of the scans does not show
// which pose is correct, however many matches are inliers. Let o(X) be the
// overlap at pose X (robust/verdict/structure_grid.h), the smaller one of
// source in target and target in source. Then
//
//   rival = argmax { o(D X) : D moves the middle by > min_shift
//                             or rotates by > 10 deg },                     (1)
//
// where D is a horizontal shift by up to max_shift, or a rotation by 90, 180 or
// 270 deg about the middle of the overlapping structure, followed by a shift.
// The best candidates are refined in yaw, horizontally and in height. o(X) -
// o(rival) is near 0 if the pose is ambiguous.

#ifndef QUATRO_ROBUST_VERDICT_GEOMETRIC_RIVAL_H_
#define QUATRO_ROBUST_VERDICT_GEOMETRIC_RIVAL_H_

#include <Eigen/Core>
#include <string>

#include "features/base/rigid3.h"
#include "robust/estimators/pose_bounds.h"
#include "robust/verdict/overlap.h"

namespace quatro {

// The search for the rival.
struct GeometricRivalOptions {
  // Shifts [voxel sizes]: 2, 12 and 8 m for voxels of 0.3 m.
  double min_shift = 20.0 / 3.0;
  double max_shift = 40.0;               // Without rotation.
  double max_turned_shift = 80.0 / 3.0;  // After a rotation.

  // A pose outside of the bounds is not a rival.
  PoseBounds bounds;

  // The numbers of structure points of each scan, first for the search, then
  // for the comparison of the rival with the pose.
  Eigen::Index num_search_points = 300;
  Eigen::Index num_compared_points = 2000;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// The other pose with the largest overlap.
struct GeometricRival {
  double overlap = 0.0;             // o(X), in [0, 1].
  double rival_overlap = 0.0;       // o(rival); 0 without a rival.
  Rigid3 rival_target_from_source;  // X without a rival.

  // D in the target's frame: the rotation about the middle, then the shift.
  double yaw = 0.0;                                 // [rad], in [-pi, pi].
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();  // [m]
};

// `middle` is the middle of the overlapping structure. `direction` is the
// horizontal unit vector along which shifts are sampled most finely. Both are
// in the target's frame. Overlap is computed from structure in the useful range
// of the other sensor; a rival must have at least half as many such points as
// the pose in both scans. Points within `max_distance` overlap; `voxel_size` is
// that of the clouds, both in [m].
GeometricRival FindGeometricRival(const DescribedCloud& source,
                                  const DescribedCloud& target,
                                  const Rigid3& target_from_source,
                                  const Eigen::Vector3d& middle,
                                  const Eigen::Vector3d& direction,
                                  double max_distance,
                                  double voxel_size,
                                  const GeometricRivalOptions& options,
                                  int num_threads);

}  // namespace quatro

#endif  // QUATRO_ROBUST_VERDICT_GEOMETRIC_RIVAL_H_
