// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/registration/gravity.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "features/base/degree.h"
#include "solvers/closed_form/gravity.h"

namespace quatro {
namespace {

constexpr Eigen::Index kMaxSampled = 4000;
constexpr Eigen::Index kMaxTried = 200;
constexpr Eigen::Index kMinSampled = 50;
const double kMinCosine = std::cos(10.0 * kDegree);

// At most kMaxSampled of the known normals, evenly over the cloud.
Points SampleNormals(const DescribedCloud& cloud) {
  std::vector<Eigen::Index> known;
  for (Eigen::Index i = 0; i < cloud.normals.cols(); ++i) {
    if (!cloud.normals.col(i).isZero(0.0)) known.push_back(i);
  }
  const auto num = static_cast<Eigen::Index>(known.size());
  const Eigen::Index num_kept = std::min(num, kMaxSampled);
  Points normals(3, num_kept);
  for (Eigen::Index k = 0; k < num_kept; ++k) {
    normals.col(k) =
        cloud.normals.col(known[static_cast<std::size_t>(k * num / num_kept)]);
  }
  return normals;
}

// The direction that has the most normals around it.
std::optional<Eigen::Vector3d> CommonDirection(const Points& normals) {
  const Eigen::Index n = normals.cols();
  if (n < kMinSampled) return std::nullopt;
  const Eigen::Index num_tried = std::min(n, kMaxTried);
  Eigen::Index most = 0;
  Eigen::Vector3d best = Eigen::Vector3d::UnitZ();
  for (Eigen::Index k = 0; k < num_tried; ++k) {
    const Eigen::Vector3d tried = normals.col(k * n / num_tried);
    const Eigen::Index num_near =
        ((tried.transpose() * normals).array() > kMinCosine).count();
    if (num_near <= most) continue;
    most = num_near;
    best = tried;
  }
  for (int iteration = 0; iteration < 3; ++iteration) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (Eigen::Index i = 0; i < n; ++i) {
      if (normals.col(i).dot(best) > kMinCosine) sum += normals.col(i);
    }
    if (sum.norm() > 0.0) best = sum.normalized();
  }
  return best;
}

}  // namespace

std::optional<Eigen::Vector3d> FindCommonNormal(const DescribedCloud& cloud) {
  return CommonDirection(SampleNormals(cloud));
}

std::optional<LevelFrames> LevelByMatches(const MatchedClouds& clouds,
                                          const PoseSolver& solver) {
  const PoseSummary solution =
      solver(clouds.matched_source, clouds.matched_target);
  if (!solution.IsUsable()) return std::nullopt;
  const Eigen::Matrix3d& rotation = solution.target_from_source->rotation;
  const Points source = rotation * SampleNormals(clouds.source);
  const Points target = SampleNormals(clouds.target);
  Points both(3, source.cols() + target.cols());
  both << source, target;
  const auto up = CommonDirection(both);
  if (!up) return std::nullopt;
  const Eigen::Matrix3d level_from_target =
      RotationBetween(*up, Eigen::Vector3d::UnitZ());
  return LevelFrames{level_from_target * rotation, level_from_target};
}

std::optional<LevelFrames> LevelByNormals(const MatchedClouds& clouds) {
  const auto source_up = FindCommonNormal(clouds.source);
  const auto target_up = FindCommonNormal(clouds.target);
  if (!source_up || !target_up) return std::nullopt;
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  return LevelFrames{RotationBetween(*source_up, z),
                     RotationBetween(*target_up, z)};
}

}  // namespace quatro
