// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/verdict/contact_covariance.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace quatro {
namespace {

constexpr std::size_t kMinContacts = 50;
constexpr double kPatchSize = 10.0;  // [voxel sizes]

// Equation (4).
constexpr double kSandwichFactor = 4.0;
constexpr double kStepFactor = 2.2;

// The least standard deviation [voxel sizes], so that no direction is certain.
constexpr double kMinDeviation = 1e-3;

// The least pivot of the scaled H, relative to its trace.
constexpr double kMinPivot = 1e-9;

struct SurfaceContact {
  Eigen::Vector3d point;   // x_i, in the target [m].
  Eigen::Vector3d normal;  // n_i, in the target.
  double residual;         // r_i [m]
};

std::vector<SurfaceContact> FindSurfaceContacts(
    const DescribedCloud& source,
    const DescribedCloud& target,
    const Rigid3& target_from_source,
    const MutualContacts& contacts) {
  const Points& p = source.points();
  const Points& q = target.points();
  std::vector<SurfaceContact> found;
  found.reserve(contacts.of_source.size() + contacts.of_target.size());
  // The point of the source, that of the target, and the one that was met.
  const auto add = [&](Eigen::Index i, Eigen::Index j, bool meets_target) {
    const Eigen::Vector3d source_normal =
        target_from_source.rotation * source.normals.col(i);
    const Eigen::Vector3d target_normal = target.normals.col(j);
    if (!AreNormalsAligned(source_normal, target_normal)) return;
    const Eigen::Vector3d moved =
        target_from_source * Eigen::Vector3d(p.col(i));
    const Eigen::Vector3d& n = meets_target ? target_normal : source_normal;
    found.push_back({meets_target ? moved : Eigen::Vector3d(q.col(j)),
                     n,
                     n.dot(moved - q.col(j))});
  };
  for (std::size_t i = 0; i < contacts.of_source.size(); ++i) {
    if (contacts.of_source[i] == kNoContact) continue;
    add(static_cast<Eigen::Index>(i), contacts.of_source[i], true);
  }
  for (std::size_t j = 0; j < contacts.of_target.size(); ++j) {
    if (contacts.of_target[j] == kNoContact) continue;
    add(contacts.of_target[j], static_cast<Eigen::Index>(j), false);
  }
  return found;
}

// The mean, summed from differences to keep the digits of large coordinates.
Eigen::Vector3d MeanOf(const std::vector<SurfaceContact>& contacts) {
  const Eigen::Vector3d& origin = contacts.front().point;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const SurfaceContact& contact : contacts) sum += contact.point - origin;
  return origin + sum / static_cast<double>(contacts.size());
}

double MedianResidual(const std::vector<SurfaceContact>& contacts) {
  std::vector<double> residuals;
  residuals.reserve(contacts.size());
  for (const SurfaceContact& contact : contacts) {
    residuals.push_back(std::abs(contact.residual));
  }
  const auto middle =
      residuals.begin() + static_cast<std::ptrdiff_t>(residuals.size() / 2);
  std::nth_element(residuals.begin(), middle, residuals.end());
  return *middle;
}

// The patch of a point relative to c, as 21 bits on each axis.
std::uint64_t PatchOf(const Eigen::Vector3d& offset, double patch_size) {
  std::uint64_t key = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double cell = std::floor(offset[axis] / patch_size) + (1 << 20);
    key = key << 21 | static_cast<std::uint64_t>(std::clamp(
                          cell, 0.0, static_cast<double>((1 << 21) - 1)));
  }
  return key;
}

}  // namespace

std::optional<ContactCovariance> MeasureContactCovariance(
    const DescribedCloud& source,
    const DescribedCloud& target,
    const Rigid3& target_from_source,
    const MutualContacts& contacts,
    double voxel_size) {
  const std::vector<SurfaceContact> surface =
      FindSurfaceContacts(source, target, target_from_source, contacts);
  if (surface.size() < kMinContacts) return std::nullopt;
  ContactCovariance result;
  result.center = MeanOf(surface);
  const double scale = std::max(2.0 * 1.4826 * MedianResidual(surface),
                                kMinDeviation * voxel_size);

  Matrix6 information = Matrix6::Zero();
  Vector6 gradient = Vector6::Zero();
  double squared_extent = 0.0;
  std::unordered_map<std::uint64_t, Vector6> patches;
  for (const SurfaceContact& contact : surface) {
    const Eigen::Vector3d x = contact.point - result.center;
    Vector6 a;
    a << x.cross(contact.normal), contact.normal;
    const double ratio = contact.residual / scale;
    const double weight = 1.0 / (1.0 + ratio * ratio);
    information += weight * a * a.transpose();
    const Vector6 pull = weight * contact.residual * a;
    gradient += pull;
    auto [patch, is_new] = patches.try_emplace(
        PatchOf(x, kPatchSize * voxel_size), Vector6::Zero());
    patch->second += pull;
    squared_extent += x.squaredNorm();
  }
  Matrix6 squared_pulls = Matrix6::Zero();
  for (const auto& [key, pull] : patches) {
    squared_pulls += pull * pull.transpose();
  }

  // Scaled to a rotation by extent, so that all of H has one unit.
  result.extent =
      std::sqrt(squared_extent / static_cast<double>(surface.size()));
  if (!(result.extent > 0.0)) return std::nullopt;
  Vector6 units;
  units << Eigen::Vector3d::Constant(1.0 / result.extent),
      Eigen::Vector3d::Ones();
  const Matrix6 scaled = units.asDiagonal() * information * units.asDiagonal();
  const Eigen::LDLT<Matrix6> ldlt(scaled);
  if (!(ldlt.vectorD().minCoeff() > kMinPivot * scaled.trace())) {
    return std::nullopt;
  }
  const Matrix6 inverse =
      units.asDiagonal() * ldlt.solve(Matrix6::Identity()) * units.asDiagonal();
  result.step = -inverse * gradient;
  const double floor = kMinDeviation * voxel_size;
  Matrix6 covariance = kSandwichFactor * inverse * squared_pulls * inverse +
                       kStepFactor * result.step * result.step.transpose();
  covariance.diagonal() += (floor * units).cwiseAbs2();
  result.covariance_at_center = 0.5 * (covariance + covariance.transpose());
  return result;
}

}  // namespace quatro
