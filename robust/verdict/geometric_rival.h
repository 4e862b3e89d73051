// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The geometric rival: the best other pose by the overlap of structure.
//
// In a corridor a pose can slide along the walls; in a hall with equal ends it
// can be rotated by 180 deg. There the geometry of the scans does not show
// which pose is correct, however many matches are inliers. Let o(X) be the
// overlap at pose X by robust/verdict/structure_grid.h, the smaller of both
// directions. Then
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
  // Shifts [voxel sizes]. Voxels of 0.3 m make them 2, 12 and 8 m.
  double min_shift = 20.0 / 3.0;
  double max_shift = 40.0;               // Without rotation.
  double max_turned_shift = 80.0 / 3.0;  // After a rotation.

  // A pose outside of them is no rival.
  PoseBounds bounds;

  // Structure points of each scan to look for the rival, and to compare it.
  Eigen::Index num_search_points = 300;
  Eigen::Index num_compared_points = 2000;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// The best other pose by overlap.
struct GeometricRival {
  double overlap = 0.0;             // o(X), in [0, 1].
  double rival_overlap = 0.0;       // o(rival); 0 without a rival.
  Rigid3 rival_target_from_source;  // X without a rival.

  // D in the target's frame: the rotation about the middle, then the shift.
  double yaw = 0.0;                                 // [rad], in [-pi, pi].
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();  // [m]
};

// `middle` is that of the overlapping structure. `direction` is the horizontal
// unit vector along which shifts are sampled most finely. Both are in the
// target's frame. Overlap is computed from structure in the useful range of the
// other sensor; a rival must have at least half as many such points as the pose
// in both scans. `max_distance` is that of the overlap and `voxel_size` that of
// the clouds, both in [m].
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
