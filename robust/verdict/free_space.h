// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Contradictions of free space: a surface of one scan lies where a beam of the
// other scan passed.
//
// A range image stores how far its sensor saw in each direction:
//
//   free(c) = min { |p - sensor| : p blocks c },                            (1)
//
// over cells of about equal solid angle, sin(elevation) by azimuth. For azimuth
// the diamond angle is used (x and y divided by |x| + |y|), which needs no
// trigonometry. The points are voxel means and represent surfaces as wide as a
// voxel: p blocks all cells within half a voxel's diagonal of it and about
// 1 deg more. The extra degree prevents contradictions at edges and slanted
// surfaces, but does not make cells known: a cell is known only if a point is
// within half the diagonal or in the cell. So the gaps between beams remain
// unknown, not free.
//
// A point q is contradicted if its cell is known and
//
//   |q - sensor| < free(c) - margin - 0.9 deg |q - sensor|.                 (2)
//
// A point behind the observed surface is hidden, not contradicted.

#ifndef QUATRO_ROBUST_VERDICT_FREE_SPACE_H_
#define QUATRO_ROBUST_VERDICT_FREE_SPACE_H_

#include <Eigen/Core>
#include <vector>

#include "features/base/types.h"

namespace quatro {

// The distance that the sensor saw in each direction.
class RangeImage {
 public:
  // `points` and `sensor` are in one frame; `voxel_size` is that of the points
  // [m].
  RangeImage(const PointsRef& points,
             const Eigen::Vector3d& sensor,
             double voxel_size);

  // The state of a place as observed by the sensor.
  enum class Sight {
    kUnknown,  // No beam went there, or it is nearer than every point.
    kFree,     // Equation (2): the sensor saw farther.
    kNotFree,  // At the observed surface, or behind it.
  };
  // `point` is in the frame of the constructor; `margin` is that of (2) [m].
  Sight At(const Eigen::Vector3d& point, double margin) const;

 private:
  struct Cell {
    int row;
    int column;
    double range;  // [m]
  };
  Cell CellOf(const Eigen::Vector3d& point) const;
  std::size_t At(int row, int column) const;

  Eigen::Vector3d sensor_;
  double min_range_;         // Smallest range of the points [m].
  std::vector<float> free_;  // Equation (1) [m]; infinite where unblocked.
  std::vector<char> is_known_;
};

}  // namespace quatro

#endif  // QUATRO_ROBUST_VERDICT_FREE_SPACE_H_
