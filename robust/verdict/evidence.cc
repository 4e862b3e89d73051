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

namespace quatro {
namespace {

// Sums over the overlapping points of both clouds, in the target's frame.
struct OverlapSums {
  std::vector<double> residuals;  // [m]
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  std::vector<Eigen::Vector3d> points;
};

void AddOverlap(const std::vector<StructurePoint>& structure,
                const DescribedCloud& a,
                const DescribedCloud& b,
                const Rigid3& b_from_a,
                const Rigid3& target_from_a,
                OverlapSums* sums) {
  for (const StructurePoint& point : structure) {
    if (!point.is_overlapping) continue;
    const Eigen::Vector3d p = a.points().col(point.index);
    const Eigen::Vector3d from_nearest =
        b_from_a * p - b.points().col(point.nearest);
    sums->residuals.push_back(
        std::abs(b.normals.col(point.nearest).dot(from_nearest)));
    const Eigen::Vector3d normal =
        target_from_a.rotation * a.normals.col(point.index);
    sums->information += normal.head<2>() * normal.head<2>().transpose();
    sums->points.push_back(target_from_a * p);
  }
}

// The quantile `share` of the values; 0 if there are none.
double Quantile(double share, std::vector<double>* values) {
  if (values->empty()) return 0.0;
  const auto at =
      values->begin() + static_cast<std::ptrdiff_t>(
                            share * static_cast<double>(values->size() - 1));
  std::nth_element(values->begin(), at, values->end());
  return *at;
}

// The middle between the 2 % and 98 % quantiles along a direction. The mean is
// near the sensors, where most points are, but a hall is symmetric about its
// middle.
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

std::optional<RangeImage> ImageOf(const DescribedCloud& cloud,
                                  double voxel_size) {
  if (!cloud.is_scan) return std::nullopt;
  return RangeImage(cloud.points(), cloud.sensor, voxel_size);
}

// Counts the structure of a that overlaps b, and the structure of a in space
// that b saw to be free.
void AddFreeSpace(const std::vector<StructurePoint>& structure,
                  const DescribedCloud& a,
                  const std::optional<RangeImage>& b,
                  const Rigid3& b_from_a,
                  double margin,
                  FreeSpace* sum) {
  if (!b) return;
  for (const StructurePoint& point : structure) {
    sum->num_overlapping += point.is_overlapping;
    if (point.is_near) continue;
    sum->num_contradicted +=
        b->At(b_from_a * Eigen::Vector3d(a.points().col(point.index)),
              margin) == RangeImage::Sight::kFree;
  }
}

// The structure of both clouds at one pose.
struct MutualStructure {
  std::vector<StructurePoint> of_source;
  std::vector<StructurePoint> of_target;
};

class EvidenceMeasurement {
 public:
  EvidenceMeasurement(const DescribedCloud& source,
                      const DescribedCloud& target,
                      double voxel_size,
                      const EvidenceOptions& options,
                      int num_threads)
      : source_(source),
        target_(target),
        voxel_size_(voxel_size),
        max_distance_(options.MaxDistance(voxel_size)),
        options_(options),
        num_threads_(num_threads) {}

  std::optional<GeometricEvidence> At(const Rigid3& target_from_source,
                                      const MutualContacts& contacts) {
    const MutualStructure structure = Find(target_from_source, contacts);
    const auto source_share = OverlapShare(structure.of_source);
    const auto target_share = OverlapShare(structure.of_target);
    if (!source_share || !target_share) return std::nullopt;

    GeometricEvidence evidence;
    evidence.structure_overlap = std::min(*source_share, *target_share);
    ParallelDo(
        num_threads_,
        [&] { source_image_ = ImageOf(source_, voxel_size_); },
        [&] { target_image_ = ImageOf(target_, voxel_size_); });
    evidence.free_space = FreeSpaceOf(structure, target_from_source);
    const Eigen::Vector3d middle =
        SetWeakestDirection(structure, target_from_source, &evidence);
    evidence.rival = FindGeometricRival(source_,
                                        target_,
                                        target_from_source,
                                        middle,
                                        evidence.weakest_direction,
                                        max_distance_,
                                        voxel_size_,
                                        options_.rival,
                                        num_threads_);
    const Rigid3& rival = evidence.rival.rival_target_from_source;
    evidence.rival_free_space = FreeSpaceOf(FindAnew(rival), rival);
    return evidence;
  }

 private:
  MutualStructure Find(const Rigid3& target_from_source,
                       const MutualContacts& contacts) const {
    MutualStructure structure;
    ParallelDo(
        num_threads_,
        [&] {
          structure.of_source = FindStructure(
              source_, target_, target_from_source, contacts.of_source);
        },
        [&] {
          structure.of_target = FindStructure(target_,
                                              source_,
                                              Inverse(target_from_source),
                                              contacts.of_target);
        });
    return structure;
  }

  // Like Find(), but finds the contacts, too.
  MutualStructure FindAnew(const Rigid3& target_from_source) const {
    const int num_threads_each = std::max(1, NumThreadsToUse(num_threads_) / 2);
    MutualStructure structure;
    ParallelDo(
        num_threads_,
        [&] {
          structure.of_source = FindStructure(source_,
                                              target_,
                                              target_from_source,
                                              max_distance_,
                                              num_threads_each);
        },
        [&] {
          structure.of_target = FindStructure(target_,
                                              source_,
                                              Inverse(target_from_source),
                                              max_distance_,
                                              num_threads_each);
        });
    return structure;
  }

  FreeSpace FreeSpaceOf(const MutualStructure& structure,
                        const Rigid3& target_from_source) const {
    FreeSpace sum;
    AddFreeSpace(structure.of_source,
                 source_,
                 target_image_,
                 target_from_source,
                 max_distance_,
                 &sum);
    AddFreeSpace(structure.of_target,
                 target_,
                 source_image_,
                 Inverse(target_from_source),
                 max_distance_,
                 &sum);
    return sum;
  }

  // Sets the residual and the results of (1). Returns the middle of the
  // overlapping points.
  Eigen::Vector3d SetWeakestDirection(const MutualStructure& structure,
                                      const Rigid3& target_from_source,
                                      GeometricEvidence* evidence) const {
    OverlapSums sums;
    AddOverlap(structure.of_source,
               source_,
               target_,
               target_from_source,
               target_from_source,
               &sums);
    AddOverlap(structure.of_target,
               target_,
               source_,
               Inverse(target_from_source),
               Rigid3(),
               &sums);
    evidence->median_residual = Quantile(0.5, &sums.residuals) / voxel_size_;
    const auto num_overlapping =
        static_cast<double>(std::max<std::size_t>(1, sums.residuals.size()));
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(
        sums.information / num_overlapping);
    evidence->weakest_share = std::max(0.0, solver.eigenvalues()[0]);
    const Eigen::Vector2d eigenvector = solver.eigenvectors().col(0);
    Eigen::Index largest = 0;
    eigenvector.cwiseAbs().maxCoeff(&largest);
    evidence->weakest_direction.head<2>() =
        eigenvector[largest] < 0.0 ? -eigenvector : eigenvector;
    if (sums.points.empty()) return target_.sensor;
    const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d& weakest = evidence->weakest_direction;
    return MiddleAlong(weakest, sums.points) +
           MiddleAlong(up.cross(weakest), sums.points);
  }

  const DescribedCloud& source_;
  const DescribedCloud& target_;
  const double voxel_size_;
  const double max_distance_;
  const EvidenceOptions& options_;
  const int num_threads_;
  std::optional<RangeImage> source_image_;
  std::optional<RangeImage> target_image_;
};

}  // namespace

bool EvidenceOptions::IsValid(std::string* error) const {
  if (!(max_distance_in_voxels > 0.0 &&
        std::isfinite(max_distance_in_voxels))) {
    std::ostringstream problem;
    problem << "evidence.max_distance_in_voxels = " << max_distance_in_voxels
            << ", must be > 0 and finite";
    *error = problem.str();
    return false;
  }
  return rival.IsValid(error);
}

std::optional<GeometricEvidence> MeasureGeometricEvidence(
    const DescribedCloud& source,
    const DescribedCloud& target,
    const Rigid3& target_from_source,
    const MutualContacts& contacts,
    double voxel_size,
    const EvidenceOptions& options,
    int num_threads) {
  if (source.points().cols() == 0 || target.points().cols() == 0) {
    return std::nullopt;
  }
  EvidenceMeasurement measurement(
      source, target, voxel_size, options, num_threads);
  return measurement.At(target_from_source, contacts);
}

}  // namespace quatro
