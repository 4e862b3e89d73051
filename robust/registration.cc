// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/registration.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "features/fpfh.h"
#include "features/kd_tree.h"
#include "features/matching.h"
#include "features/normals.h"
#include "features/voxel_grid.h"
#include "robust/evidence.h"
#include "robust/summary_covariance.h"

namespace quatro {
namespace {

// Where the sensor stood: at the origin of a scan. A cloud that does not reach
// around its origin is in the coordinates of a map; there, above its middle,
// from where it need not have been seen.
struct AssumedSensor {
  AssumedSensor(const Points& points, const Eigen::Vector3d& up) {
    const Eigen::Vector3d low = points.rowwise().minCoeff();
    const Eigen::Vector3d high = points.rowwise().maxCoeff();
    const Eigen::Vector3d margin = 0.5 * (high - low);
    is_scan =
        (low - margin).maxCoeff() <= 0.0 && (high + margin).minCoeff() >= 0.0;
    if (is_scan) return;
    const Eigen::Vector3d middle = 0.5 * (low + high);
    place =
        middle + up * (up.transpose() * (points.colwise() - middle)).maxCoeff();
  }

  bool is_scan = true;
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  // [m]
};

struct DescribedCloud {
  Eigen::Vector3d up;
  AssumedSensor sensor;
  KdTree tree;
  Points normals;
  Fpfh fpfh;
};

SurfaceCloud AsSurface(const DescribedCloud& cloud) {
  return {cloud.sensor.place,
          cloud.tree,
          cloud.normals,
          cloud.sensor.is_scan,
          cloud.up};
}

DescribedCloud Describe(const Points& points,
                        const Eigen::Vector3d& up,
                        const FrontEndOptions& options,
                        int num_threads) {
  const AssumedSensor sensor(points, up);
  KdTree tree(points);
  const Neighborhoods neighborhoods =
      FindNeighborhoods(tree, options.fpfh_radius, num_threads);
  Points normals = EstimateNormals(
      points, neighborhoods, options.normal_radius, sensor.place, num_threads);
  Fpfh fpfh = options.describe
                  ? options.describe(points, normals, options.fpfh_radius)
                  : ComputeFpfh(points, normals, neighborhoods, num_threads);
  CHECK_EQ(fpfh.cols(), points.cols());
  return {up, sensor, std::move(tree), std::move(normals), std::move(fpfh)};
}

// What the clouds say of the pose; what they do not hold goes into the summary.
std::optional<GeometricEvidence> WeighGeometry(
    const DescribedCloud& source,
    const DescribedCloud& target,
    const RegistrationOptions& options,
    RegistrationSummary* summary) {
  const Rigid3& pose = *summary->solution.target_from_source;
  EvidenceOptions evidence;
  evidence.voxel_size = options.front_end.voxel_size;
  StructureHoldOptions hold = options.structure_hold;
  hold.max_distance = evidence.max_distance_in_voxels * evidence.voxel_size;
  summary->structure_hold = MeasureStructureHold(
      AsSurface(source), AsSurface(target), pose, hold, options.num_threads);
  if (summary->structure_hold) {
    auto& unheld = summary->solution.covariance->unheld;
    unheld.insert(unheld.end(),
                  summary->structure_hold->unheld.begin(),
                  summary->structure_hold->unheld.end());
  }
  return MeasureGeometricEvidence(AsSurface(source),
                                  AsSurface(target),
                                  pose,
                                  evidence,
                                  options.num_threads);
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
         ins.IsValid(error) && verdict.IsValid(error) &&
         covariance.IsValid(error) && structure_hold.IsValid(error) &&
         refinement.IsValid(error);
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

  const LevelFrames frames = MakeLevelFrames(options.ins);
  const DescribedCloud source_cloud =
      Describe(*source_voxels,
               frames.level_from_source.row(2).transpose(),
               options.front_end,
               options.num_threads);
  const DescribedCloud target_cloud =
      Describe(*target_voxels,
               frames.level_from_target.row(2).transpose(),
               options.front_end,
               options.num_threads);
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
  const PoseSolver solve_quatro = [&](const PointsRef& p, const PointsRef& q) {
    return SolveQuatro(p, q, quatro);
  };
  summary.solution =
      SolveWithIns(summary.matched_source,
                   summary.matched_target,
                   options.solver ? options.solver : solve_quatro,
                   quatro.noise_bound,
                   options.ins);
  AddCovariance(summary.matched_source,
                summary.matched_target,
                quatro.noise_bound,
                options.covariance,
                &summary.solution);
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
  std::optional<GeometricEvidence> geometry;
  if (summary.solution.IsUsable()) {
    geometry = WeighGeometry(source_cloud, target_cloud, options, &summary);
    finish_stage("evidence");
  }
  VerdictOptions verdict = options.verdict;
  verdict.rival.seed = options.seed;
  verdict.rival.num_threads = options.num_threads;
  verdict.rival.up_in_target = options.ins.up;
  summary.verdict = Judge(summary.matched_source,
                          summary.matched_target,
                          summary.solution,
                          quatro.noise_bound,
                          geometry,
                          verdict);
  finish_stage("verdict");
  summary.total_seconds = total.Lap();
  return summary;
}

}  // namespace quatro
