// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/verdict/evidence.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

#include "features/base/parallel.h"
#include "robust/verdict/free_space.h"
#include "solvers/closed_form/gravity.h"

namespace quatro {
namespace {

// Sums over the met points of both ways, in the target's frame.
struct OverlapSums {
  std::vector<double> residuals;  // [m]
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  std::vector<Eigen::Vector3d> points;
};

void AddOverlap(const std::vector<StructurePoint>& structure,
                const SurfaceCloud& a,
                const SurfaceCloud& b,
                const Rigid3& b_from_a,
                const Rigid3& target_from_a,
                OverlapSums* sums) {
  for (const StructurePoint& point : structure) {
    if (!point.is_overlapping) continue;
    const Eigen::Vector3d p = a.tree.points().col(point.index);
    const Eigen::Vector3d from_nearest =
        b_from_a * p - b.tree.points().col(point.nearest);
    sums->residuals.push_back(
        std::abs(b.normals.col(point.nearest).dot(from_nearest)));
    const Eigen::Vector3d normal =
        target_from_a.rotation * a.normals.col(point.index);
    sums->information += normal.head<2>() * normal.head<2>().transpose();
    sums->points.push_back(target_from_a * p);
  }
}

// `share` of them are smaller. 0 of none.
double Quantile(double share, std::vector<double>* values) {
  if (values->empty()) return 0.0;
  const auto at =
      values->begin() + static_cast<std::ptrdiff_t>(
                            share * static_cast<double>(values->size() - 1));
  std::nth_element(values->begin(), at, values->end());
  return *at;
}

// Halfway between the ends rather than the mean, which is near the sensors,
// where most points are: a hall is symmetric about its middle.
Eigen::Vector3d MiddleAlong(const Eigen::Vector3d& direction,
                            const std::vector<Eigen::Vector3d>& points) {
  std::vector<double> along;
  along.reserve(points.size());
  for (const Eigen::Vector3d& point : points) {
    along.push_back(direction.dot(point));
  }
  constexpr double kEnds = 0.02;
  const double low = Quantile(kEnds, &along);
  return 0.5 * (low + Quantile(1.0 - kEnds, &along)) * direction;
}

std::optional<RangeImage> ImageOf(const SurfaceCloud& cloud,
                                  double voxel_size) {
  if (!cloud.is_scan) return std::nullopt;
  return RangeImage(cloud.tree.points(), cloud.sensor, voxel_size);
}

// Of a's structure in what b saw.
void AddFreeSpace(const std::vector<StructurePoint>& structure,
                  const SurfaceCloud& a,
                  const std::optional<RangeImage>& b,
                  const Rigid3& b_from_a,
                  double margin,
                  FreeSpace* sum) {
  if (!b) return;
  for (const StructurePoint& point : structure) {
    sum->num_overlapping += point.is_overlapping;
    if (point.is_near) continue;
    sum->num_contradicted +=
        b->At(b_from_a * Eigen::Vector3d(a.tree.points().col(point.index)),
              margin) == RangeImage::Sight::kFree;
  }
}

// In a target frame whose z is up.
std::optional<GeometricEvidence> MeasureLevel(const SurfaceCloud& source,
                                              const SurfaceCloud& target,
                                              const Rigid3& target_from_source,
                                              const MutualContacts& contacts,
                                              const EvidenceOptions& options,
                                              int num_threads) {
  const Rigid3 level{RotationBetween(target.up, Eigen::Vector3d::UnitZ()),
                     Eigen::Vector3d::Zero()};
  const KdTree tree(level.Apply(target.tree.points()));
  const Points normals = level.rotation * target.normals;
  auto evidence = MeasureGeometricEvidence(
      source,
      {level * target.sensor, tree, normals, target.is_scan},
      level * target_from_source,
      contacts,
      options,
      num_threads);
  if (!evidence) return std::nullopt;
  const Rigid3 back = Inverse(level);
  evidence->weakest_direction = back.rotation * evidence->weakest_direction;
  evidence->rival.shift = back.rotation * evidence->rival.shift;
  evidence->rival.rival_target_from_source =
      back * evidence->rival.rival_target_from_source;
  return evidence;
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
  return MeasureGeometricEvidence(source,
                                  target,
                                  target_from_source,
                                  FindMutualContacts(source,
                                                     target,
                                                     target_from_source,
                                                     options.MaxDistance(),
                                                     num_threads),
                                  options,
                                  num_threads);
}

std::optional<GeometricEvidence> MeasureGeometricEvidence(
    const SurfaceCloud& source,
    const SurfaceCloud& target,
    const Rigid3& target_from_source,
    const MutualContacts& contacts,
    const EvidenceOptions& options,
    int num_threads) {
  if (target.up != Eigen::Vector3d::UnitZ()) {
    return MeasureLevel(
        source, target, target_from_source, contacts, options, num_threads);
  }
  if (source.tree.points().cols() == 0 || target.tree.points().cols() == 0) {
    return std::nullopt;
  }
  const Rigid3 source_from_target = Inverse(target_from_source);
  const double max_distance = options.MaxDistance();
  std::vector<StructurePoint> of_source, of_target;
  ParallelDo(
      num_threads,
      [&] {
        of_source = FindStructure(
            source, target, target_from_source, contacts.of_source);
      },
      [&] {
        of_target = FindStructure(
            target, source, source_from_target, contacts.of_target);
      });
  const auto source_share = OverlapShare(of_source);
  const auto target_share = OverlapShare(of_target);
  if (!source_share || !target_share) return std::nullopt;

  GeometricEvidence evidence;
  evidence.structure_overlap = std::min(*source_share, *target_share);

  OverlapSums sums;
  AddOverlap(
      of_source, source, target, target_from_source, target_from_source, &sums);
  AddOverlap(of_target, target, source, source_from_target, Rigid3(), &sums);
  evidence.median_residual =
      Quantile(0.5, &sums.residuals) / options.voxel_size;
  const auto num_overlapping =
      static_cast<double>(std::max<std::size_t>(1, sums.residuals.size()));
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(sums.information /
                                                              num_overlapping);
  evidence.weakest_share = std::max(0.0, solver.eigenvalues()[0]);
  const Eigen::Vector2d eigenvector = solver.eigenvectors().col(0);
  Eigen::Index largest = 0;
  eigenvector.cwiseAbs().maxCoeff(&largest);
  evidence.weakest_direction.head<2>() =
      eigenvector[largest] < 0.0 ? -eigenvector : eigenvector;

  std::optional<RangeImage> source_image;
  std::optional<RangeImage> target_image;
  ParallelDo(
      num_threads,
      [&] { source_image = ImageOf(source, options.voxel_size); },
      [&] { target_image = ImageOf(target, options.voxel_size); });
  AddFreeSpace(of_source,
               source,
               target_image,
               target_from_source,
               max_distance,
               &evidence.free_space);
  AddFreeSpace(of_target,
               target,
               source_image,
               source_from_target,
               max_distance,
               &evidence.free_space);

  Eigen::Vector3d middle = target.sensor;
  if (!sums.points.empty()) {
    const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d& weakest = evidence.weakest_direction;
    middle = MiddleAlong(weakest, sums.points) +
             MiddleAlong(up.cross(weakest), sums.points);
  }
  evidence.rival = FindGeometricRival(source,
                                      target,
                                      target_from_source,
                                      middle,
                                      evidence.weakest_direction,
                                      max_distance,
                                      options.rival,
                                      num_threads);
  const Rigid3& rival = evidence.rival.rival_target_from_source;
  const int num_threads_each = std::max(1, NumThreadsToUse(num_threads) / 2);
  ParallelDo(
      num_threads,
      [&] {
        of_source = FindStructure(
            source, target, rival, max_distance, num_threads_each);
      },
      [&] {
        of_target = FindStructure(
            target, source, Inverse(rival), max_distance, num_threads_each);
      });
  AddFreeSpace(of_source,
               source,
               target_image,
               rival,
               max_distance,
               &evidence.rival_free_space);
  AddFreeSpace(of_target,
               target,
               source_image,
               Inverse(rival),
               max_distance,
               &evidence.rival_free_space);
  return evidence;
}

}  // namespace quatro
