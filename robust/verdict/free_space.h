// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Free space contradicted: a surface of one scan stands where a beam of the
// other passed.
//
// A range image holds, for each direction from its sensor, how far it saw:
//
//   free(c) = min { |p - sensor| : p blocks c },                            (1)
//
// over cells of equal solid angle, sin(elevation) by azimuth, the latter as
// the diamond angle (x and y by |x| + |y|), which needs no trigonometry. The
// points are voxel means and stand for surfaces as wide as a voxel: p blocks
// all cells within half a voxel's diagonal of it and about 1 deg more. The one
// degree keeps edges and slanted surfaces from being contradicted, but lends no
// sight: a cell is known only if a point is within the half diagonal or in the
// cell, so that the gaps between beams stay unknown, not free.
//
// A point q is contradicted if its cell is known and
//
//   |q - sensor| < free(c) - margin - 0.9 deg |q - sensor|.                 (2)
//
// What is behind something seen is hidden, not contradicted.

#ifndef QUATRO_ROBUST_VERDICT_FREE_SPACE_H_
#define QUATRO_ROBUST_VERDICT_FREE_SPACE_H_

#include <Eigen/Core>
#include <vector>

#include "features/base/types.h"

namespace quatro {

// How far the sensor saw in each direction.
class RangeImage {
 public:
  // `points` and `sensor` in one frame, `voxel_size` of the points [m].
  RangeImage(const PointsRef& points,
             const Eigen::Vector3d& sensor,
             double voxel_size);

  // What the sensor says of a place.
  enum class Sight {
    kUnknown,  // No beam went there, or the sensor stood there itself.
    kFree,     // Equation (2): the sensor saw farther.
    kNotFree,  // At what was seen, or behind.
  };
  // `point` in the frame of the image; `margin` [m].
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
  double min_range_;         // Nearer than that nothing was seen [m].
  std::vector<float> free_;  // Equation (1) [m]; infinite where unblocked.
  std::vector<char> is_known_;
};

}  // namespace quatro

#endif  // QUATRO_ROBUST_VERDICT_FREE_SPACE_H_
