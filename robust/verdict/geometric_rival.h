// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Another pose under which the structure of two scans fits as well.
//
// In a corridor a pose can be slid along the walls, in a hall with equal ends
// it can be turned by half: the scans' own geometry does not tell which is
// right, however many matches agree. With the share met o(X) of
// robust/verdict/structure_grid.h, the smaller of both ways,
//
//   rival = argmax { o(D X) : D moves the middle by > min_shift
//                             or turns by > 10 deg },                       (1)
//
// where D is a shift along the ground by up to max_shift, or a turn by 90, 180
// or 270 deg about the middle of the structure that is met and then a shift;
// the best are refined in yaw, along the ground and in height. o(X) - o(rival)
// is near 0 if the pose is not distinct.

#ifndef QUATRO_ROBUST_VERDICT_GEOMETRIC_RIVAL_H_
#define QUATRO_ROBUST_VERDICT_GEOMETRIC_RIVAL_H_

#include <Eigen/Core>
#include <string>

#include "features/base/rigid3.h"
#include "robust/verdict/overlap.h"

namespace quatro {

// Where another pose is looked for.
struct GeometricRivalOptions {
  double min_shift = 2.0;         // [m]
  double max_shift = 12.0;        // [m], without a turn.
  double max_turned_shift = 8.0;  // [m], after one.

  // Structure points of each scan to look for the rival, and to compare it.
  Eigen::Index num_search_points = 300;
  Eigen::Index num_compared_points = 2000;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// The best other pose by geometry.
struct GeometricRival {
  double overlap = 0.0;        // o(X), in [0, 1].
  double rival_overlap = 0.0;  // o(rival); 0 if no rival shares enough space.
  Rigid3 rival_target_from_source;  // X itself if there is none.

  // D, in the target's frame: the turn about the middle, then the shift.
  double yaw = 0.0;                                 // [rad], in [-pi, pi].
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();  // [m]
};

// `middle` of the structure that is met and `direction`, horizontal and of
// length 1, along which to slide first, both in the target's frame. Shares are
// of structure in both sensors' useful ranges; a rival has at least half as
// much of it as the pose. `max_distance` as for the overlap [m].
GeometricRival FindGeometricRival(const DescribedCloud& source,
                                  const DescribedCloud& target,
                                  const Rigid3& target_from_source,
                                  const Eigen::Vector3d& middle,
                                  const Eigen::Vector3d& direction,
                                  double max_distance,
                                  const GeometricRivalOptions& options,
                                  int num_threads);

}  // namespace quatro

#endif  // QUATRO_ROBUST_VERDICT_GEOMETRIC_RIVAL_H_
