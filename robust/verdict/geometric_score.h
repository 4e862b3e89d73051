// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A quick score by which candidate poses of two scans are compared,
//
//   score(T) = min over both scans of  overlapping / (in range + c)
//              * (1 - contradicted share)^5,                               (1)
//
// from samples of the structure (robust/verdict/structure.h) of each scan. A
// point is in range and overlapping by robust/verdict/structure_grid.h; it is
// contradicted if the other scan saw free space there
// (robust/verdict/free_space.h). Along a periodic facade, a pose that is off by
// one period overlaps nearly as well as the correct one, and may differ only by
// a contradicted share of a tenth; hence the fifth power. The constant c lowers
// the score of poses that bring few points into range, where a large share may
// be chance.
//
// The score only orders candidates. The verdict decides whether the best one is
// correct. It measures overlap and free space on all points
// (robust/verdict/evidence.h).

#ifndef QUATRO_ROBUST_VERDICT_GEOMETRIC_SCORE_H_
#define QUATRO_ROBUST_VERDICT_GEOMETRIC_SCORE_H_

#include <Eigen/Core>
#include <cmath>
#include <optional>

#include "features/base/rigid3.h"
#include "features/described_cloud.h"
#include "robust/verdict/free_space.h"
#include "robust/verdict/structure_grid.h"

namespace quatro {

// The parts of (1), each in [0, 1].
struct GeometricScore {
  double overlap = 0.0;  // The first factor.

  // The share of points in free space, among the points in directions that the
  // other scan observed.
  double contradicted_share = 0.0;

  // (1)
  double value() const {
    return overlap * std::pow(1.0 - contradicted_share, 5.0);
  }
};

// Built once for a pair of scans. Each score then takes tens of microseconds.
class GeometricScorer {
 public:
  // Points within `max_distance` overlap; `voxel_size` is that of the clouds,
  // both in [m]. z is up.
  GeometricScorer(const DescribedCloud& source,
                  const DescribedCloud& target,
                  double max_distance,
                  double voxel_size,
                  int num_threads);

  // The score of a pose. Thread-safe.
  GeometricScore At(const Rigid3& target_from_source) const;

 private:
  // The structure and the range image of one scan.
  struct Scan {
    StructureGrid grid;
    StructureSample sample;
    std::optional<RangeImage> image;  // Only if the cloud is a scan.
  };

  double max_distance_;
  std::optional<Scan> source_;
  std::optional<Scan> target_;
};

}  // namespace quatro

#endif  // QUATRO_ROBUST_VERDICT_GEOMETRIC_SCORE_H_
