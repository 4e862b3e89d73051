// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/registration.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "features/fpfh.h"
#include "features/kd_tree.h"
#include "features/matching.h"
#include "features/normals.h"
#include "features/voxel_grid.h"
#include "robust/overlap.h"

namespace quatro {
namespace {

// Where the sensor stood: at the origin of a scan. A cloud that does not reach
// around its origin is in the coordinates of a map; there, above its middle.
Eigen::Vector3d AssumedSensor(const Points& points) {
  const Eigen::Vector3d low = points.rowwise().minCoeff();
  const Eigen::Vector3d high = points.rowwise().maxCoeff();
  const Eigen::Vector3d margin = 0.5 * (high - low);
  if ((low - margin).maxCoeff() <= 0.0 && (high + margin).minCoeff() >= 0.0) {
    return Eigen::Vector3d::Zero();
  }
  const Eigen::Vector3d middle = 0.5 * (low + high);
  return {middle.x(), middle.y(), high.z()};
}

struct DescribedCloud {
  Eigen::Vector3d sensor;
  KdTree tree;
  Points normals;
  Fpfh fpfh;
};

DescribedCloud Describe(const Points& points,
                        const FrontEndOptions& options,
                        int num_threads) {
  const Eigen::Vector3d sensor = AssumedSensor(points);
  KdTree tree(points);
  const Neighborhoods neighborhoods =
      FindNeighborhoods(tree, options.fpfh_radius, num_threads);
  Points normals = EstimateNormals(
      points, neighborhoods, options.normal_radius, sensor, num_threads);
  Fpfh fpfh = ComputeFpfh(points, normals, neighborhoods, num_threads);
  return {sensor, std::move(tree), std::move(normals), std::move(fpfh)};
}

}  // namespace

bool FrontEndOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  if (!(voxel_size > 0.0 && std::isfinite(voxel_size))) {
    problem << "voxel_size = " << voxel_size << ", must be > 0 and finite";
  } else if (!(normal_radius > 0.0 && std::isfinite(normal_radius))) {
    problem << "normal_radius = " << normal_radius
            << ", must be > 0 and finite";
  } else if (!(fpfh_radius >= normal_radius && std::isfinite(fpfh_radius))) {
    problem << "fpfh_radius = " << fpfh_radius
            << ", must be >= normal_radius = " << normal_radius;
  } else {
    return tuple.IsValid(error);
  }
  *error = problem.str();
  return false;
}

bool RegistrationOptions::IsValid(std::string* error) const {
  if (num_threads < 0) {
    *error = "num_threads = " + std::to_string(num_threads) + ", must be >= 0";
    return false;
  }
  return front_end.IsValid(error) && quatro.IsValid(error) &&
         refinement.IsValid(error) && verdict.IsValid(error);
}

RegistrationSummary Register(const PointCloud& source,
                             const PointCloud& target,
                             const RegistrationOptions& options) {
  RegistrationSummary summary;
  if (!options.IsValid(&summary.error)) return summary;
  if (source.points.cols() == 0 || target.points.cols() == 0) {
    summary.error = source.points.cols() == 0 ? "the source has no points"
                                              : "the target has no points";
    return summary;
  }

  Stopwatch total;
  Stopwatch stopwatch;
  const auto finish_stage = [&](const char* stage) {
    summary.stage_times.push_back({stage, stopwatch.Lap()});
    if (options.progress) options.progress(summary.stage_times.back());
  };

  const double voxel_size = options.front_end.voxel_size;
  const auto source_voxels =
      SampleVoxels(source.points, voxel_size, &summary.error);
  if (!source_voxels) {
    summary.error = "source: " + summary.error;
    return summary;
  }
  const auto target_voxels =
      SampleVoxels(target.points, voxel_size, &summary.error);
  if (!target_voxels) {
    summary.error = "target: " + summary.error;
    return summary;
  }
  summary.num_source_voxels = source_voxels->cols();
  summary.num_target_voxels = target_voxels->cols();
  finish_stage("voxels");

  const DescribedCloud source_cloud =
      Describe(*source_voxels, options.front_end, options.num_threads);
  const DescribedCloud target_cloud =
      Describe(*target_voxels, options.front_end, options.num_threads);
  finish_stage("features");

  std::vector<Match> matches = MatchMutualNearest(
      source_cloud.fpfh, target_cloud.fpfh, options.num_threads);
  summary.num_mutual_matches = static_cast<Eigen::Index>(matches.size());
  if (options.front_end.tuple_test) {
    TupleTestOptions tuple = options.front_end.tuple;
    tuple.seed = options.seed;
    matches = FilterByTupleTest(matches, *source_voxels, *target_voxels, tuple);
  }
  const auto num_matches = static_cast<Eigen::Index>(matches.size());
  summary.matched_source.resize(3, num_matches);
  summary.matched_target.resize(3, num_matches);
  for (Eigen::Index k = 0; k < num_matches; ++k) {
    const Match& match = matches[static_cast<std::size_t>(k)];
    summary.matched_source.col(k) = source_voxels->col(match.source);
    summary.matched_target.col(k) = target_voxels->col(match.target);
  }
  finish_stage("matching");

  QuatroOptions quatro = options.quatro;
  quatro.num_threads = options.num_threads;
  quatro.seed = options.seed;
  summary.solution =
      options.solver
          ? options.solver(summary.matched_source, summary.matched_target)
          : SolveQuatro(summary.matched_source, summary.matched_target, quatro);
  stopwatch.Lap();
  for (const StageTime& time : summary.solution.stage_times) {
    summary.stage_times.push_back(time);
    if (options.progress) options.progress(time);
  }
  if (options.refinement.method != RefinementMethod::kNone &&
      summary.solution.IsUsable()) {
    RefinementOptions refinement = options.refinement;
    refinement.alignment.num_threads = options.num_threads;
    summary.refinement = Refine({source_cloud.tree, source_cloud.normals},
                                {target_cloud.tree, target_cloud.normals},
                                summary.matched_source,
                                summary.matched_target,
                                quatro.noise_bound,
                                *summary.solution.target_from_source,
                                refinement);
    summary.solution.target_from_source =
        summary.refinement->target_from_source;
    finish_stage("refinement");
  }
  summary.verdict = JudgeSummary(summary.matched_source,
                                 summary.matched_target,
                                 summary.solution,
                                 quatro.noise_bound,
                                 options.verdict);
  if (summary.solution.IsUsable()) {
    // A voxel's mean may be off by about its size; two of them by more.
    AddOverlap(
        MeasureStructureOverlap(
            {source_cloud.sensor, source_cloud.tree, source_cloud.normals},
            {target_cloud.sensor, target_cloud.tree, target_cloud.normals},
            *summary.solution.target_from_source,
            5.0 / 3.0 * voxel_size,
            options.num_threads),
        options.verdict,
        &summary.verdict);
  }
  finish_stage("verdict");
  summary.total_seconds = total.Lap();
  return summary;
}

}  // namespace quatro
