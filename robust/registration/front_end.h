// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The front end, which matches the points of two clouds:
//
//   clouds -> voxels -> normals, FPFH -> mutual nearest -> tuple test
//
// Source: Section III.A of the Quatro paper.

#ifndef QUATRO_ROBUST_REGISTRATION_FRONT_END_H_
#define QUATRO_ROBUST_REGISTRATION_FRONT_END_H_

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "features/base/stopwatch.h"
#include "features/base/types.h"
#include "features/described_cloud.h"
#include "features/fpfh.h"
#include "features/io/point_cloud.h"
#include "features/kd_tree.h"
#include "features/matching.h"
#include "features/tuple_test.h"

namespace quatro {

// Computes another descriptor: one column per point, zero if a point has none.
// `normals` are unit vectors, or zero where unknown; `radius` is in [m].
using CloudDescriber = std::function<Fpfh(
    const Points& points, const Points& normals, double radius)>;

// Sizes and radii.
struct FrontEndOptions {
  double voxel_size = 0.3;     // [m]
  double normal_radius = 0.9;  // [m]
  double fpfh_radius = 1.5;    // [m], normal_radius to 100 voxel_size.
  CloudDescriber describe;     // Replaces FPFH; gets fpfh_radius.
  bool tuple_test = true;
  TupleTestOptions tuple;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// Two described clouds and their matches.
struct MatchedClouds {
  // Why there are no matches: an option is out of range, or a cloud has no
  // points or is too wide. Empty otherwise.
  std::string error;

  DescribedCloud source;
  DescribedCloud target;

  // The matches: voxel means in their own frames, column by column.
  Points matched_source;  // [m]
  Points matched_target;  // [m]

  // All mutual matches of the voxel means, before the tuple test.
  std::vector<Match> mutual_matches;

  std::vector<StageTime> stage_times;
};

// Mutual matches between coarser voxels of two described clouds, without a
// tuple test. The sizes are those of `options`; the clouds' own normals are not
// used.
MatchedPoints MatchAgain(const DescribedCloud& source,
                         const DescribedCloud& target,
                         const FrontEndOptions& options,
                         int num_threads);

// The points of matches of the clouds, column by column.
MatchedPoints PointsOf(const std::vector<Match>& matches,
                       const Points& source,
                       const Points& target);

// `source_up` and `target_up` are the upward directions in the clouds, unit
// vectors. Options must be valid.
MatchedClouds MatchClouds(
    const PointCloud& source,
    const PointCloud& target,
    const Eigen::Vector3d& source_up,
    const Eigen::Vector3d& target_up,
    const FrontEndOptions& options,
    std::uint64_t seed,
    int num_threads,
    const std::function<void(const StageTime&)>& progress);

}  // namespace quatro

#endif  // QUATRO_ROBUST_REGISTRATION_FRONT_END_H_
