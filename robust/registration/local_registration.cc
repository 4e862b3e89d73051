// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/registration/local_registration.h"

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "features/base/stopwatch.h"
#include "features/described_cloud.h"
#include "features/voxel_grid.h"
#include "robust/estimators/bound_solver.h"
#include "robust/registration/refinement.h"
#include "solvers/local/gicp.h"

namespace quatro {
namespace {

constexpr int kNumNeighbors = 20;

std::optional<Points> Sample(const char* name,
                             const PointCloud& cloud,
                             double voxel_size,
                             std::string* error) {
  if (cloud.points.cols() == 0) {
    *error = std::string("the ") + name + " has no points";
    return std::nullopt;
  }
  auto voxels = SampleVoxels(cloud.points, voxel_size, error);
  if (!voxels) *error = std::string(name) + ": " + *error;
  return voxels;
}

PoseTermination TerminationOf(const AlignmentSummary& alignment) {
  switch (alignment.termination) {
    case AlignmentTermination::kInsufficient:
      return PoseTermination::kInsufficient;
    case AlignmentTermination::kDegenerate:
      return PoseTermination::kDegenerate;
    case AlignmentTermination::kConverged:
    case AlignmentTermination::kNotConverged:
      return PoseTermination::kSolved;
    case AlignmentTermination::kInvalidInput:
      break;
  }
  return PoseTermination::kInvalidInput;
}

Verdict JudgeAlignment(const AlignmentSummary& alignment) {
  Verdict verdict;
  verdict.reason = alignment.message;
  if (alignment.IsUsable()) {
    verdict.status = Status::kAmbiguous;
    verdict.reason +=
        " from the guess; without matches nothing tells whether it was near";
  } else if (alignment.termination == AlignmentTermination::kDegenerate) {
    verdict.status = Status::kDegenerate;
  }
  return verdict;
}

using FinishStage = std::function<void(const char* stage)>;

AlignmentSummary AlignVoxels(Points source,
                             Points target,
                             const Rigid3& initial_target_from_source,
                             const RefinementOptions& options,
                             const FinishStage& finish_stage) {
  const int num_threads = options.alignment.num_threads;
  const auto describe = [&](Points points) {
    DescribedCloud cloud;
    cloud.tree = std::make_shared<const KdTree>(std::move(points));
    if (options.method != RefinementMethod::kIcp) {
      cloud.normals =
          EstimateNearestNormals(*cloud.tree, kNumNeighbors, num_threads);
    }
    return cloud;
  };
  const DescribedCloud source_cloud = describe(std::move(source));
  const DescribedCloud target_cloud = describe(std::move(target));
  finish_stage("normals");
  return Align(source_cloud, target_cloud, initial_target_from_source, options);
}

// Uses `align`, or AlignVoxels() if it is empty.
RegistrationSummary RegisterBy(const PointCloud& source,
                               const PointCloud& target,
                               const Rigid3& initial_target_from_source,
                               const RegistrationOptions& options,
                               const CloudAligner& align) {
  RegistrationSummary summary;
  if (!options.IsValid(&summary.error)) return summary;
  if (options.refinement.method == RefinementMethod::kNone) {
    summary.error = "refinement.method is none, nothing to register by";
    return summary;
  }
  Stopwatch total;
  Stopwatch stopwatch;
  const FinishStage finish_stage = [&](const char* stage) {
    summary.stage_times.push_back({stage, stopwatch.Lap()});
    if (options.progress) options.progress(summary.stage_times.back());
  };
  const double voxel_size = options.front_end.voxel_size;
  auto source_voxels = Sample("source", source, voxel_size, &summary.error);
  if (!source_voxels) return summary;
  auto target_voxels = Sample("target", target, voxel_size, &summary.error);
  if (!target_voxels) return summary;
  summary.num_source_voxels = source_voxels->cols();
  summary.num_target_voxels = target_voxels->cols();
  finish_stage("voxels");

  const Eigen::Vector3d source_middle = source_voxels->rowwise().mean();
  RefinementOptions by = options.refinement;
  by.alignment.num_threads = options.num_threads;
  RefinementSummary refinement;
  refinement.method = by.method;
  refinement.alignment =
      align
          ? align(
                *source_voxels, *target_voxels, initial_target_from_source, by)
          : AlignVoxels(std::move(*source_voxels),
                        std::move(*target_voxels),
                        initial_target_from_source,
                        by,
                        finish_stage);
  const AlignmentSummary& alignment = refinement.alignment;
  if (alignment.termination == AlignmentTermination::kInvalidInput) {
    summary.error = alignment.message;
    return summary;
  }
  refinement.message = alignment.message;
  refinement.unrefined_target_from_source = initial_target_from_source;
  refinement.target_from_source = initial_target_from_source;
  summary.solution.termination = TerminationOf(alignment);
  summary.solution.message = alignment.message;
  summary.solution.num_needed = 3;
  if (alignment.IsUsable()) {
    summary.solution.target_from_source = alignment.target_from_source;
    refinement.is_accepted = true;
    refinement.target_from_source = *alignment.target_from_source;
    refinement.SetMoved(source_middle, *alignment.target_from_source);
  }
  summary.refinement = std::move(refinement);
  finish_stage("alignment");
  summary.verdict = JudgeAlignment(summary.refinement->alignment);
  PoseBounds bounds = options.bounds;
  bounds.up = options.ins.up;
  if (summary.solution.IsUsable() &&
      !bounds.Contain(*summary.solution.target_from_source, 0.0)) {
    RefuseOutside(bounds, 0.0, &summary.solution);
    summary.verdict.status = Status::kInsufficient;
    summary.verdict.reason = summary.solution.message;
  }
  summary.total_seconds = total.Lap();
  return summary;
}

}  // namespace

RegistrationSummary RegisterLocally(const PointCloud& source,
                                    const PointCloud& target,
                                    const Rigid3& initial_target_from_source,
                                    const RegistrationOptions& options) {
  return RegisterBy(
      source, target, initial_target_from_source, options, nullptr);
}

RegistrationSummary RegisterLocally(const PointCloud& source,
                                    const PointCloud& target,
                                    const Rigid3& initial_target_from_source,
                                    const RegistrationOptions& options,
                                    const CloudAligner& align) {
  return RegisterBy(source, target, initial_target_from_source, options, align);
}

}  // namespace quatro
