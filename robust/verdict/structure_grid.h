// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The structure of a cloud as a grid of bits, to measure its overlap with
// another at thousands of poses.
//
// A cell holds one bit per sector of the normals' azimuth, a seventh of half a
// turn each, set if a structure point with such a normal is within max_distance
// of its middle, and one bit for being within the sensor's useful range. So it
// is robust/verdict/overlap.h with sampled points, rounded to cells, in 1/100
// of the time.

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

// Every n-th structure point of a cloud with its normal.
struct StructureSample {
  Points points;  // [m]
  Points normals;
};

// At most `num_wanted`, evenly along the cloud.
StructureSample SampleStructure(const DescribedCloud& cloud,
                                Eigen::Index num_wanted);

// A sample turned, ready to be shifted.
struct TurnedSample {
  Eigen::Matrix3Xf points;            // [m], from the grid's sensor.
  std::vector<std::uint8_t> sectors;  // That its normals agree with.
};

// Points of a sample that could be met, and those that are.
struct OverlapCount {
  int num_in_range = 0;
  int num_overlapping = 0;

  // Met of those in range; 0 if there are none.
  double Share() const {
    return num_in_range == 0
               ? 0.0
               : static_cast<double>(num_overlapping) / num_in_range;
  }
};

// The structure of one scan, to lay the other's over it.
class StructureGrid {
 public:
  // Of all structure within useful range. `max_distance` [m].
  StructureGrid(const DescribedCloud& cloud, double max_distance);

  // Of the other scan, as it lies in the grid but for a shift.
  TurnedSample Turn(const StructureSample& sample,
                    const Rigid3& grid_from_sample) const;

  // Of a sample moved on by `shift` [m].
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
