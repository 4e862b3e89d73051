// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/surface_share.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <utility>
#include <vector>

#include "features/cells.h"

namespace quatro {
namespace {

constexpr Eigen::Index kMaxSamples = 2000;
constexpr int kMinNeighbors = 5;
constexpr double kMinWidth = 0.1;  // lambda_2 / lambda_1.

// Whether the points within `radius` of `center`, all among those of `near`,
// are on a surface.
bool IsSurface(const Points& points,
               const std::vector<std::int32_t>& near,
               const Eigen::Vector3d& center,
               double radius) {
  int num = 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (const std::int32_t i : near) {
    const Eigen::Vector3d offset = points.col(i) - center;
    if (offset.squaredNorm() > radius * radius) continue;
    ++num;
    sum += offset;
    squares += offset * offset.transpose();
  }
  if (num < kMinNeighbors) return false;
  // The scatter in units of the radius has no extreme scale.
  const Eigen::Matrix3d scatter =
      (squares - sum * sum.transpose() / num) / (radius * radius);
  const Eigen::Vector3d lambda =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>()
          .computeDirect(scatter, Eigen::EigenvaluesOnly)
          .eigenvalues();
  return lambda[1] > kMinWidth * lambda[2];
}

}  // namespace

double SurfaceShare(const Points& points, double radius) {
  const auto cells = Cells::Make(points, radius);
  if (!cells || points.cols() == 0) return 0.0;
  const Eigen::Index step = std::max<Eigen::Index>(
      1, (points.cols() + kMaxSamples - 1) / kMaxSamples);
  std::vector<std::pair<Cells::Key, Eigen::Index>> samples;
  for (Eigen::Index i = 0; i < points.cols(); i += step) {
    samples.emplace_back(*cells->KeyOf(points.col(i)), i);
  }
  std::sort(samples.begin(), samples.end());

  Cells::Walk walk(*cells);
  std::vector<std::int32_t> near;
  int num_surfaces = 0;
  for (const auto& [key, i] : samples) {
    walk.FindNear(key, &near);
    num_surfaces += IsSurface(points, near, points.col(i), radius) ? 1 : 0;
  }
  return static_cast<double>(num_surfaces) /
         static_cast<double>(samples.size());
}

}  // namespace quatro
