// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/registration/alignment_check.h"

#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <sstream>
#include <utility>

#include "features/voxel_grid.h"
#include "robust/verdict/contact.h"
#include "robust/verdict/evidence.h"
#include "robust/verdict/surface_observability.h"
#include "solvers/local/gicp.h"

namespace quatro {
namespace {

constexpr int kNumNormalNeighbors = 20;
constexpr double kMaxRatio = 0.5;

// G-ICP pairs points up to this distance [voxel sizes].
constexpr double kMaxPairDistance = 3.0;

// The largest deviation of the rotation from an orthonormal matrix.
constexpr double kMaxRotationError = 1e-6;

std::optional<DescribedCloud> DescribeVoxels(
    const char* name,
    const PointCloud& cloud,
    const AlignmentCheckOptions& options,
    std::string* error) {
  if (cloud.points.cols() == 0) {
    *error = std::string("the ") + name + " has no points";
    return std::nullopt;
  }
  auto voxels = SampleVoxels(cloud.points, options.voxel_size, error);
  if (!voxels) {
    *error = std::string(name) + ": " + *error;
    return std::nullopt;
  }
  DescribedCloud described;
  described.tree = std::make_shared<const KdTree>(std::move(*voxels));
  described.normals = EstimateNearestNormals(
      *described.tree, kNumNormalNeighbors, options.num_threads);
  return described;
}

// D / D_0 of (1). Sets the motion in *check.
double RatioOf(const SurfaceObservability& surfaces,
               const Rigid3& pose,
               const AlignmentCheckOptions& options,
               AlignmentCheck* check) {
  const Eigen::AngleAxisd turn(check->nearest.rotation *
                               pose.rotation.transpose());
  const Eigen::Vector3d& c = surfaces.center;
  Vector6 motion;
  motion << turn.angle() * turn.axis(),
      c - pose * (Inverse(check->nearest) * c);
  check->moved_rotation = motion.head<3>().norm();
  check->moved_translation = motion.tail<3>().norm();
  const Matrix6& A = surfaces.information;
  const double r = options.rotation;
  const double t = options.translation;
  return std::sqrt(3.0 * motion.dot(A * motion) /
                   (r * r * A.topLeftCorner<3, 3>().trace() +
                    t * t * A.bottomRightCorner<3, 3>().trace()));
}

}  // namespace

bool AlignmentCheckOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  const auto check = [&](const char* name, double value) {
    if (!problem.str().empty() || (value > 0.0 && std::isfinite(value))) return;
    problem << name << " = " << value << ", must be > 0 and finite";
  };
  check("translation", translation);
  check("rotation", rotation);
  check("voxel_size", voxel_size);
  if (problem.str().empty() && num_threads < 0) {
    problem << "num_threads = " << num_threads << ", must be >= 0";
  }
  *error = problem.str();
  return error->empty();
}

AlignmentCheck CheckAlignment(const PointCloud& source,
                              const PointCloud& target,
                              const Rigid3& target_from_source,
                              const AlignmentCheckOptions& options) {
  AlignmentCheck check;
  if (!options.IsValid(&check.error)) return check;
  if (!target_from_source.translation.allFinite() ||
      !target_from_source.rotation.isUnitary(kMaxRotationError)) {
    check.error = "the pose is not a finite rotation and translation";
    return check;
  }
  const auto a = DescribeVoxels("source", source, options, &check.error);
  if (!a) return check;
  const auto b = DescribeVoxels("target", target, options, &check.error);
  if (!b) return check;

  GicpOptions gicp;
  gicp.alignment.num_threads = options.num_threads;
  gicp.alignment.max_correspondence_distance =
      kMaxPairDistance * options.voxel_size;
  gicp.alignment.min_conditioning = 0.0;
  const AlignmentSummary aligned = SolveGicp(*a, *b, target_from_source, gicp);
  check.message = "the surfaces do not overlap enough";
  if (!aligned.IsUsable()) return check;
  check.nearest = *aligned.target_from_source;
  const auto surfaces = MeasureSurfaceObservability(
      *a,
      *b,
      check.nearest,
      FindMutualContacts(*a,
                         *b,
                         check.nearest,
                         EvidenceOptions().MaxDistance(options.voxel_size),
                         options.num_threads),
      SurfaceObservabilityOptions(),
      options.num_threads);
  if (!surfaces) return check;
  check.num_contacts = surfaces->num_overlapping;
  check.ratio = RatioOf(*surfaces, target_from_source, options, &check);
  check.is_aligned = check.ratio < kMaxRatio;
  char text[160];
  std::snprintf(text,
                sizeof(text),
                "%s: the surfaces fit best %.3f m and %.2f deg from this pose, "
                "%.2f times the tolerance",
                check.is_aligned ? "aligned" : "not aligned",
                check.moved_translation,
                check.moved_rotation * 180.0 / M_PI,
                check.ratio);
  check.message = text;
  return check;
}

}  // namespace quatro
