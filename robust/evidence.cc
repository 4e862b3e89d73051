// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/evidence.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

#include "robust/free_space.h"

namespace quatro {
namespace {

// Sums over the met points of both ways, in the target's frame.
struct MetSums {
  std::vector<double> residuals;  // [m]
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  Eigen::Vector3d points = Eigen::Vector3d::Zero();
};

void AddMet(const std::vector<StructurePoint>& structure,
            const SurfaceCloud& a,
            const SurfaceCloud& b,
            const Rigid3& b_from_a,
            const Rigid3& target_from_a,
            MetSums* sums) {
  for (const StructurePoint& point : structure) {
    if (!point.is_met) continue;
    const Eigen::Vector3d p = a.tree.points().col(point.index);
    const Eigen::Vector3d from_nearest =
        b_from_a * p - b.tree.points().col(point.nearest);
    sums->residuals.push_back(
        std::abs(b.normals.col(point.nearest).dot(from_nearest)));
    const Eigen::Vector3d normal =
        target_from_a.rotation * a.normals.col(point.index);
    sums->information += normal.head<2>() * normal.head<2>().transpose();
    sums->points += target_from_a * p;
  }
}

double Median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle =
      values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void AddFreeSpace(const std::vector<StructurePoint>& structure,
                  const SurfaceCloud& a,
                  const SurfaceCloud& b,
                  const Rigid3& b_from_a,
                  const EvidenceOptions& options,
                  GeometricEvidence* evidence) {
  if (!b.is_scan) return;
  const RangeImage image(b.tree.points(), b.sensor, options.voxel_size);
  const double margin = options.max_distance_in_voxels * options.voxel_size;
  for (const StructurePoint& point : structure) {
    evidence->num_met += point.is_met;
    if (point.is_near) continue;
    evidence->num_contradicted +=
        image.At(b_from_a * Eigen::Vector3d(a.tree.points().col(point.index)),
                 margin) == RangeImage::Sight::kFree;
  }
}

}  // namespace

bool EvidenceOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  if (!(voxel_size > 0.0 && std::isfinite(voxel_size))) {
    problem << "voxel_size = " << voxel_size << ", must be > 0 and finite";
  } else if (!(max_distance_in_voxels > 0.0 &&
               std::isfinite(max_distance_in_voxels))) {
    problem << "max_distance_in_voxels = " << max_distance_in_voxels
            << ", must be > 0 and finite";
  } else {
    return rival.IsValid(error);
  }
  *error = problem.str();
  return false;
}

std::optional<GeometricEvidence> MeasureGeometricEvidence(
    const SurfaceCloud& source,
    const SurfaceCloud& target,
    const Rigid3& target_from_source,
    const EvidenceOptions& options,
    int num_threads) {
  if (source.tree.points().cols() == 0 || target.tree.points().cols() == 0) {
    return std::nullopt;
  }
  const Rigid3 source_from_target = Inverse(target_from_source);
  const double max_distance =
      options.max_distance_in_voxels * options.voxel_size;
  const auto of_source = FindStructure(
      source, target, target_from_source, max_distance, num_threads);
  const auto of_target = FindStructure(
      target, source, source_from_target, max_distance, num_threads);
  const auto source_share = ShareMet(of_source);
  const auto target_share = ShareMet(of_target);
  if (!source_share || !target_share) return std::nullopt;

  GeometricEvidence evidence;
  evidence.structure_overlap = std::min(*source_share, *target_share);

  MetSums sums;
  AddMet(
      of_source, source, target, target_from_source, target_from_source, &sums);
  AddMet(of_target, target, source, source_from_target, Rigid3(), &sums);
  evidence.median_residual = Median(sums.residuals) / options.voxel_size;
  const auto num_met =
      static_cast<double>(std::max<std::size_t>(1, sums.residuals.size()));
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(sums.information /
                                                              num_met);
  evidence.weakest_share = std::max(0.0, solver.eigenvalues()[0]);
  const Eigen::Vector2d weakest = solver.eigenvectors().col(0);
  Eigen::Index largest = 0;
  weakest.cwiseAbs().maxCoeff(&largest);
  evidence.weakest_direction.head<2>() =
      weakest[largest] < 0.0 ? -weakest : weakest;

  AddFreeSpace(
      of_source, source, target, target_from_source, options, &evidence);
  AddFreeSpace(
      of_target, target, source, source_from_target, options, &evidence);
  const Eigen::Index num_tested = evidence.num_contradicted + evidence.num_met;
  if (num_tested > 0) {
    evidence.contradicted_share =
        static_cast<double>(evidence.num_contradicted) /
        static_cast<double>(num_tested);
  }

  const Eigen::Vector3d middle = sums.points / num_met;
  evidence.rival =
      FindRivalPose(source,
                    target,
                    target_from_source,
                    sums.residuals.empty() ? target.sensor : middle,
                    evidence.weakest_direction,
                    max_distance,
                    options.rival);
  return evidence;
}

}  // namespace quatro
