// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/verdict/surface_observability.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <sstream>

#include "features/base/parallel.h"
#include "robust/verdict/structure.h"

namespace quatro {
namespace {

constexpr Eigen::Index kMinOverlapping = 50;

// The points of a that overlap b, and the normals of b there, both in b.
struct OverlappingPoints {
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3d> normals;
};

OverlappingPoints FindOverlapping(const DescribedCloud& a,
                                  const DescribedCloud& b,
                                  const Rigid3& b_from_a,
                                  const Contacts& contacts) {
  const Points& points = a.points();
  OverlappingPoints result;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const std::int32_t nearest = contacts[static_cast<std::size_t>(i)];
    if (nearest == kNoContact) continue;
    const Eigen::Vector3d normal = b.normals.col(nearest);
    if (!AreNormalsAligned(b_from_a.rotation * a.normals.col(i), normal))
      continue;
    result.points.push_back(b_from_a * Eigen::Vector3d(points.col(i)));
    result.normals.push_back(normal);
  }
  return result;
}

// Sums over the overlapping points of one scan, for (1), the scatter and the
// weakest level axis.
struct Sums {
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  Matrix6 information = Matrix6::Zero();
  Eigen::Matrix2d level = Eigen::Matrix2d::Zero();
  Eigen::Index num_structure = 0;
};

Sums SumUp(const OverlappingPoints& met, const Eigen::Vector3d& center) {
  Sums sums;
  for (std::size_t i = 0; i < met.points.size(); ++i) {
    const Eigen::Vector3d x = met.points[i] - center;
    const Eigen::Vector3d& n = met.normals[i];
    Vector6 a;
    a << x.cross(n), n;
    sums.information += a * a.transpose();
    sums.scatter += x * x.transpose();
    if (std::abs(n.z()) > kMaxVertical) continue;
    ++sums.num_structure;
    sums.level += n.head<2>() * n.head<2>().transpose();
  }
  return sums;
}

// The part of a direction, in [0, 1].
double Part(const DirectionInformation& direction,
            const SurfaceObservability& result) {
  if (direction.freedom == Freedom::kTranslation) return direction.information;
  const Eigen::Vector3d& w = direction.axis;
  const double squared_distance =
      result.scatter.trace() - w.dot(result.scatter * w) +
      w.cross(direction.point - result.center).squaredNorm();
  return squared_distance > 0.0 ? direction.information / squared_distance
                                : 0.0;
}

void NameUnobservable(const SurfaceObservabilityOptions& options,
                      SurfaceObservability* result) {
  for (const DirectionInformation& direction : SplitInformation(
           result->information, result->center, options.min_part)) {
    if (Part(direction, *result) >= options.min_part) continue;
    result->unobservable.push_back({direction.freedom,
                                    UnobservableReason::kNoSurface,
                                    direction.axis,
                                    direction.point,
                                    {}});
  }
}

}  // namespace

bool SurfaceObservabilityOptions::IsValid(std::string* error) const {
  if (min_part >= 0.0 && min_part < 1.0) return true;
  std::ostringstream problem;
  problem << "surface_observability.min_part = " << min_part
          << ", must be in [0, 1)";
  *error = problem.str();
  return false;
}

std::optional<SurfaceObservability> MeasureSurfaceObservability(
    const DescribedCloud& source,
    const DescribedCloud& target,
    const Rigid3& target_from_source,
    const MutualContacts& contacts,
    const SurfaceObservabilityOptions& options,
    int num_threads) {
  OverlappingPoints of_source, of_target;
  ParallelDo(
      num_threads,
      [&] {
        of_source = FindOverlapping(
            source, target, target_from_source, contacts.of_source);
      },
      [&] {
        of_target = FindOverlapping(
            target, source, Inverse(target_from_source), contacts.of_target);
      });
  SurfaceObservability result;
  result.num_overlapping = static_cast<Eigen::Index>(of_source.points.size() +
                                                     of_target.points.size());
  if (result.num_overlapping < kMinOverlapping) return std::nullopt;
  for (Eigen::Vector3d& point : of_target.points) {
    point = target_from_source * point;
  }
  for (Eigen::Vector3d& normal : of_target.normals) {
    normal = target_from_source.rotation * normal;
  }

  // Sums differences from one point, to keep the digits of coordinates far from
  // the origin.
  const auto n = static_cast<double>(result.num_overlapping);
  const Eigen::Vector3d origin = of_source.points.empty()
                                     ? of_target.points.front()
                                     : of_source.points.front();
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& point : of_source.points) mean += point - origin;
  for (const auto& point : of_target.points) mean += point - origin;
  result.center = origin + mean / n;
  Sums source_sums, target_sums;
  ParallelDo(
      num_threads,
      [&] { source_sums = SumUp(of_source, result.center); },
      [&] { target_sums = SumUp(of_target, result.center); });
  result.information = (source_sums.information + target_sums.information) / n;
  result.scatter = (source_sums.scatter + target_sums.scatter) / n;
  result.num_structure = source_sums.num_structure + target_sums.num_structure;
  if (result.num_structure > 0) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> level(
        source_sums.level + target_sums.level);
    result.weakest_level_axis.head<2>() = level.eigenvectors().col(0);
    result.weakest_level_share =
        std::max(0.0, level.eigenvalues()[0]) / level.eigenvalues().sum();
  }
  NameUnobservable(options, &result);
  return result;
}

}  // namespace quatro
