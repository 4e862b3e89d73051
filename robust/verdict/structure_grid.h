// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The structure of a cloud as a grid of bits, which measures its overlap with
// another cloud at thousands of poses.
//
// A cell has one bit for each of seven sectors of the normals' azimuth, which
// divide 180 deg. A bit is set if a structure point with such a normal is
// within max_distance of the cell's center. An additional bit is set within the
// sensor's useful range. The grid approximates robust/verdict/overlap.h with
// sampled points and rounding to cells, in 1/100 of the time.

#ifndef QUATRO_ROBUST_VERDICT_STRUCTURE_GRID_H_
#define QUATRO_ROBUST_VERDICT_STRUCTURE_GRID_H_

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "features/base/rigid3.h"
#include "features/base/types.h"
#include "features/base/zeroed_allocator.h"
#include "robust/verdict/overlap.h"

namespace quatro {

// A sample of the structure points of a cloud, with normals.
struct StructureSample {
  Points points;  // [m]
  Points normals;
};

// Samples at most `num_wanted` structure points, evenly over the order of the
// cloud.
StructureSample SampleStructure(const DescribedCloud& cloud,
                                Eigen::Index num_wanted);

// A rotated sample, to be evaluated at many shifts.
struct TurnedSample {
  Eigen::Matrix3Xf points;            // In cells, from the grid's corner.
  std::vector<std::uint8_t> sectors;  // Bits that match each normal.
};

// Points of a sample in useful range, and those that overlap.
struct OverlapCount {
  int num_in_range = 0;
  int num_overlapping = 0;

  // The share of points in range that overlap; 0 if none is in range.
  double Share() const {
    return num_in_range == 0
               ? 0.0
               : static_cast<double>(num_overlapping) / num_in_range;
  }
};

// The grid of the structure of one scan.
class StructureGrid {
 public:
  // Makes a grid of all structure within useful range. `max_distance` is in
  // [m].
  StructureGrid(const DescribedCloud& cloud, double max_distance);

  // Transforms a sample of the other scan into the grid.
  TurnedSample Turn(const StructureSample& sample,
                    const Rigid3& grid_from_sample) const;

  // Counts the points of a sample that is moved by `shift` [m].
  OverlapCount Count(const TurnedSample& sample,
                     const Eigen::Vector3d& shift) const;

 private:
  Eigen::Vector3d sensor_;
  double max_range_;
  double cell_size_;                  // [m]
  Eigen::Vector3d low_;               // The grid's corner, from the sensor [m].
  Eigen::Array3i size_;               // Number of cells on each axis.
  ZeroedVector<std::uint8_t> cells_;  // z fastest.
};

}  // namespace quatro

#endif  // QUATRO_ROBUST_VERDICT_STRUCTURE_GRID_H_
