// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/surface_share.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <vector>

namespace quatro {
namespace {

constexpr Eigen::Index kMaxSamples = 2000;
constexpr std::size_t kMinNeighbors = 5;
constexpr double kMinWidth = 0.1;  // lambda_2 / lambda_1.

bool IsSurface(const Points& points, const std::vector<Neighbor>& neighbors) {
  if (neighbors.size() < kMinNeighbors) return false;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Neighbor& neighbor : neighbors) mean += points.col(neighbor.index);
  mean /= static_cast<double>(neighbors.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Neighbor& neighbor : neighbors) {
    const Eigen::Vector3d offset = points.col(neighbor.index) - mean;
    scatter += offset * offset.transpose();
  }
  const Eigen::Vector3d lambda = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(
                                     scatter, Eigen::EigenvaluesOnly)
                                     .eigenvalues();
  return lambda[1] > kMinWidth * lambda[2];
}

}  // namespace

double SurfaceShare(const KdTree& tree, double radius) {
  const Points& points = tree.points();
  const Eigen::Index step = std::max<Eigen::Index>(
      1, (points.cols() + kMaxSamples - 1) / kMaxSamples);
  int num_samples = 0;
  int num_surfaces = 0;
  for (Eigen::Index i = 0; i < points.cols(); i += step) {
    ++num_samples;
    num_surfaces +=
        IsSurface(points, tree.WithinRadius(points.col(i), radius)) ? 1 : 0;
  }
  return num_samples > 0 ? static_cast<double>(num_surfaces) / num_samples
                         : 0.0;
}

}  // namespace quatro
