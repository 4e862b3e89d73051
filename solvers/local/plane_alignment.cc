// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "solvers/local/plane_alignment.h"

#include <limits>
#include <memory>
#include <sstream>

#include "features/base/stopwatch.h"
#include "features/normals.h"

namespace quatro {

bool PlaneAlignmentOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  if (!(epsilon > 0.0 && epsilon < 1.0)) {
    problem << "epsilon = " << epsilon << ", must be in (0, 1)";
  } else if (num_neighbors < 3) {
    problem << "num_neighbors = " << num_neighbors << ", must be >= 3";
  } else {
    return alignment.IsValid(error);
  }
  *error = problem.str();
  return false;
}

Points EstimateNearestNormals(const KdTree& tree,
                              int num_neighbors,
                              int num_threads) {
  return EstimateNormals(
      tree.points(),
      FindNearestNeighborhoods(tree, num_neighbors, num_threads),
      std::numeric_limits<double>::infinity(),
      Eigen::Vector3d::Zero(),
      num_threads);
}

AlignmentSummary SolveWithNormals(
    const Points& source,
    const Points& target,
    const PlaneAlignmentOptions& options,
    const std::function<AlignmentSummary(
        const DescribedCloud& source, const DescribedCloud& target)>& solve) {
  AlignmentSummary summary;
  if (!CanAlign(source, target, options.alignment, &summary)) return summary;
  Stopwatch stopwatch;
  DescribedCloud source_cloud, target_cloud;
  source_cloud.tree = std::make_shared<const KdTree>(source);
  target_cloud.tree = std::make_shared<const KdTree>(target);
  const double tree_seconds = stopwatch.Lap();
  for (DescribedCloud* cloud : {&source_cloud, &target_cloud}) {
    cloud->normals = EstimateNearestNormals(
        *cloud->tree, options.num_neighbors, options.alignment.num_threads);
  }
  const double normal_seconds = stopwatch.Lap();
  summary = solve(source_cloud, target_cloud);
  summary.stage_times.insert(
      summary.stage_times.begin(),
      {{"trees", tree_seconds}, {"normals", normal_seconds}});
  return summary;
}

}  // namespace quatro
