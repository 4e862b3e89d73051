// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/registration/registration.h"

#include <utility>

#include "robust/verdict/evidence.h"
#include "robust/verdict/summary_covariance.h"

namespace quatro {
namespace {

DescribedCloud AsSurface(const DescribedCloud& cloud, const Eigen::Vector3d& up) {
  return {
      cloud.sensor.place, *cloud.tree, cloud.normals, cloud.sensor.is_scan, up};
}

// What the clouds say of the pose; what they do not hold goes into the summary.
std::optional<GeometricEvidence> WeighGeometry(
    const MatchedClouds& clouds,
    const RegistrationOptions& options,
    RegistrationSummary* summary) {
  const Rigid3& pose = *summary->solution.target_from_source;
  const LevelFrames frames = MakeLevelFrames(options.ins);
  const DescribedCloud source =
      AsSurface(clouds.source, frames.level_from_source.row(2).transpose());
  const DescribedCloud target =
      AsSurface(clouds.target, frames.level_from_target.row(2).transpose());
  EvidenceOptions evidence;
  evidence.voxel_size = options.front_end.voxel_size;
  SurfaceObservabilityOptions hold = options.surface_observability;
  hold.max_distance = evidence.MaxDistance();
  const MutualContacts contacts = FindMutualContacts(
      source, target, pose, hold.max_distance, options.num_threads);
  summary->surface_observability = MeasureSurfaceObservability(
      source, target, pose, contacts, hold, options.num_threads);
  if (summary->surface_observability) {
    auto& unobservable = summary->solution.covariance->unobservable;
    unobservable.insert(unobservable.end(),
                        summary->surface_observability->unobservable.begin(),
                        summary->surface_observability->unobservable.end());
  }
  return MeasureGeometricEvidence(
      source, target, pose, contacts, evidence, options.num_threads);
}

}  // namespace

bool RegistrationOptions::IsValid(std::string* error) const {
  if (num_threads < 0) {
    *error = "num_threads = " + std::to_string(num_threads) + ", must be >= 0";
    return false;
  }
  return front_end.IsValid(error) && quatro.IsValid(error) &&
         ins.IsValid(error) && verdict.IsValid(error) &&
         covariance.IsValid(error) && surface_observability.IsValid(error) &&
         refinement.IsValid(error);
}

MatchedClouds MatchClouds(const PointCloud& source,
                          const PointCloud& target,
                          const RegistrationOptions& options) {
  MatchedClouds clouds;
  if (!options.IsValid(&clouds.error)) return clouds;
  const LevelFrames frames = MakeLevelFrames(options.ins);
  return MatchClouds(source,
                     target,
                     frames.level_from_source.row(2).transpose(),
                     frames.level_from_target.row(2).transpose(),
                     options.front_end,
                     options.seed,
                     options.num_threads,
                     options.progress);
}

RegistrationSummary Register(const PointCloud& source,
                             const PointCloud& target,
                             const RegistrationOptions& options) {
  return RegisterMatched(MatchClouds(source, target, options), options);
}

RegistrationSummary RegisterMatched(const MatchedClouds& clouds,
                                    const RegistrationOptions& options) {
  RegistrationSummary summary;
  summary.error = clouds.error;
  if (!summary.error.empty() || !options.IsValid(&summary.error)) {
    return summary;
  }
  summary.matched_source = clouds.matched_source;
  summary.matched_target = clouds.matched_target;
  summary.num_source_voxels = clouds.source.points().cols();
  summary.num_target_voxels = clouds.target.points().cols();
  summary.num_mutual_matches = clouds.num_mutual_matches;
  summary.stage_times = clouds.stage_times;
  for (const StageTime& time : clouds.stage_times) {
    summary.total_seconds += time.seconds;
  }

  Stopwatch total;
  Stopwatch stopwatch;
  const auto finish_stage = [&](const char* stage) {
    summary.stage_times.push_back({stage, stopwatch.Lap()});
    if (options.progress) options.progress(summary.stage_times.back());
  };

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
    summary.refinement = Refine({*clouds.source.tree, clouds.source.normals},
                                {*clouds.target.tree, clouds.target.normals},
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
    geometry = WeighGeometry(clouds, options, &summary);
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
  summary.total_seconds += total.Lap();
  return summary;
}

}  // namespace quatro
