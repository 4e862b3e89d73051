// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/verdict/geometric_score.h"

#include <algorithm>

#include "features/base/parallel.h"

namespace quatro {
namespace {

constexpr Eigen::Index kNumPoints = 500;
constexpr double kFewInRange = 25.0;  // c of (1).

// Points of a sample in directions that the other scan observed, and how many
// of them are in free space.
struct SightCount {
  int num_free = 0;
  int num_known = 0;
};

void AddSights(const StructureSample& sample,
               const std::optional<RangeImage>& image,
               const Rigid3& image_from_sample,
               double margin,
               SightCount* count) {
  if (!image) return;
  for (const auto point : sample.points.colwise()) {
    const auto sight =
        image->At(image_from_sample * Eigen::Vector3d(point), margin);
    count->num_free += sight == RangeImage::Sight::kFree;
    count->num_known += sight != RangeImage::Sight::kUnknown;
  }
}

double OverlapOf(const StructureGrid& grid,
                 const StructureSample& sample,
                 const Rigid3& grid_from_sample) {
  const OverlapCount count =
      grid.Count(grid.Turn(sample, grid_from_sample), Eigen::Vector3d::Zero());
  return count.num_overlapping / (count.num_in_range + kFewInRange);
}

}  // namespace

GeometricScorer::GeometricScorer(const DescribedCloud& source,
                                 const DescribedCloud& target,
                                 double max_distance,
                                 double voxel_size,
                                 int num_threads)
    : max_distance_(max_distance) {
  const auto make = [&](const DescribedCloud& cloud,
                        std::optional<Scan>* scan) {
    scan->emplace(Scan{StructureGrid(cloud, max_distance),
                       SampleStructure(cloud, kNumPoints),
                       std::nullopt});
    if (cloud.is_scan) {
      (*scan)->image.emplace(cloud.points(), cloud.sensor, voxel_size);
    }
  };
  ParallelDo(
      num_threads,
      [&] { make(source, &source_); },
      [&] { make(target, &target_); });
}

GeometricScore GeometricScorer::At(const Rigid3& target_from_source) const {
  const Rigid3 source_from_target = Inverse(target_from_source);
  GeometricScore score;
  score.overlap =
      std::min(OverlapOf(target_->grid, source_->sample, target_from_source),
               OverlapOf(source_->grid, target_->sample, source_from_target));
  SightCount sights;
  AddSights(source_->sample,
            target_->image,
            target_from_source,
            max_distance_,
            &sights);
  AddSights(target_->sample,
            source_->image,
            source_from_target,
            max_distance_,
            &sights);
  if (sights.num_known > 0) {
    score.contradicted_share =
        static_cast<double>(sights.num_free) / sights.num_known;
  }
  return score;
}

}  // namespace quatro
