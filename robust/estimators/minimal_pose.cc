// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/estimators/minimal_pose.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <sstream>

#include "solvers/closed_form/rotation.h"
#include "solvers/closed_form/yaw_translation.h"

namespace quatro {
namespace {

bool LengthsAgree(double a, double b, const MinimalPoseOptions& options) {
  if (options.edge_test == EdgeTest::kRatio) {
    const double s = options.edge_similarity;
    return s * a <= b && s * b <= a;
  }
  return std::abs(a - b) <= 2.0 * options.noise_bound;
}

bool EdgeAgrees(const Eigen::Vector3d& a,
                const Eigen::Vector3d& b,
                const MinimalPoseOptions& options) {
  if (options.edge_test == EdgeTest::kNone) return true;
  if (!LengthsAgree(a.norm(), b.norm(), options)) return false;
  if (options.sample == MinimalSample::kThreePoints) return true;
  const double planar = a.head<2>().norm();
  return LengthsAgree(planar, b.head<2>().norm(), options) &&
         std::abs(a.z() - b.z()) <=
             2.0 * options.noise_bound + planar * std::sin(options.max_tilt);
}

std::optional<Rigid3> FromPointAndNormal(const Eigen::Vector3d& p,
                                         const Eigen::Vector3d& q,
                                         const Eigen::Vector3d& n,
                                         const Eigen::Vector3d& m,
                                         const MinimalPoseOptions& options) {
  const Eigen::Vector2d n_xy = n.head<2>();
  const Eigen::Vector2d m_xy = m.head<2>();
  if (!(std::min(n_xy.norm(), m_xy.norm()) >= options.min_normal_xy) ||
      !(std::abs(n.z() - m.z()) <= options.max_normal_z_difference)) {
    return std::nullopt;
  }
  const double yaw =
      std::atan2(n_xy.x() * m_xy.y() - n_xy.y() * m_xy.x(), n_xy.dot(m_xy));
  Rigid3 pose{RotationZ(yaw), Eigen::Vector3d::Zero()};
  pose.translation = q - pose.rotation * p;
  return pose;
}

}  // namespace

int SampleSize(MinimalSample sample) {
  if (sample == MinimalSample::kThreePoints) return 3;
  return sample == MinimalSample::kTwoPoints ? 2 : 1;
}

bool MinimalPoseOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  if (!(noise_bound > 0.0 && std::isfinite(noise_bound))) {
    problem << "noise_bound = " << noise_bound << ", must be > 0 and finite";
  } else if (!(edge_similarity > 0.0 && edge_similarity <= 1.0)) {
    problem << "edge_similarity = " << edge_similarity << ", must be in (0, 1]";
  } else if (!(max_tilt >= 0.0 && max_tilt <= M_PI / 2)) {
    problem << "max_tilt = " << max_tilt << ", must be in [0, pi/2]";
  } else if (!(min_normal_xy > 0.0 && min_normal_xy <= 1.0)) {
    problem << "min_normal_xy = " << min_normal_xy << ", must be in (0, 1]";
  } else if (!(max_normal_z_difference >= 0.0)) {
    problem << "max_normal_z_difference = " << max_normal_z_difference
            << ", must be >= 0";
  }
  *error = problem.str();
  return error->empty();
}

std::array<Eigen::Index, 3> DrawSample(MinimalSample sample,
                                       Eigen::Index n,
                                       Random* random) {
  const auto below = [&](Eigen::Index k) {
    return static_cast<Eigen::Index>(
        random->Below(static_cast<std::uint64_t>(k)));
  };
  // Draws ranks among the columns that are left, and skips those already taken.
  std::array<Eigen::Index, 3> columns = {below(n), -1, -1};
  if (sample == MinimalSample::kPointAndNormal) return columns;
  columns[1] = below(n - 1);
  columns[1] += columns[1] >= columns[0];
  if (sample == MinimalSample::kTwoPoints) return columns;
  const auto [low, high] = std::minmax(columns[0], columns[1]);
  columns[2] = below(n - 2);
  columns[2] += columns[2] >= low;
  columns[2] += columns[2] >= high;
  return columns;
}

std::optional<Rigid3> EstimateMinimalPose(
    const PointsRef& source,
    const PointsRef& target,
    const MatchedNormals* normals,
    const std::array<Eigen::Index, 3>& columns,
    const MinimalPoseOptions& options) {
  if (options.sample == MinimalSample::kPointAndNormal) {
    const Eigen::Index i = columns[0];
    return FromPointAndNormal(source.col(i),
                              target.col(i),
                              normals->source.col(i),
                              normals->target.col(i),
                              options);
  }
  const int size = SampleSize(options.sample);
  Points p(3, size);
  Points q(3, size);
  for (int k = 0; k < size; ++k) {
    p.col(k) = source.col(columns[static_cast<std::size_t>(k)]);
    q.col(k) = target.col(columns[static_cast<std::size_t>(k)]);
    for (int j = 0; j < k; ++j) {
      if (!EdgeAgrees(p.col(k) - p.col(j), q.col(k) - q.col(j), options)) {
        return std::nullopt;
      }
    }
  }
  if (options.sample == MinimalSample::kThreePoints) {
    const auto rigid = EstimateRigid(p, q, Weights::Ones(3));
    if (!rigid) return std::nullopt;
    return rigid->target_from_source;
  }
  const auto yaw = EstimateYawTranslation(p, q, Weights::Ones(2));
  if (!yaw) return std::nullopt;
  return yaw->target_from_source;
}

}  // namespace quatro
