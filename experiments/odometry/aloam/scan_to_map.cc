// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/odometry/aloam/scan_to_map.h"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace quatro {
namespace {

constexpr int kNumNeighbors = 5;
constexpr double kMinRatio = 3.0;
constexpr double kMaxPlaneDistance = 0.2;  // [m]

struct Spread {
  Eigen::Matrix<double, 3, kNumNeighbors> centered;
  Eigen::Vector3d mean;
  Eigen::Vector3d values;   // Ascending.
  Eigen::Matrix3d vectors;  // As columns.
};

std::optional<Spread> SpreadAround(const KdTree& map,
                                   const Eigen::Vector3d& query,
                                   double max_distance) {
  const auto nearest = map.Nearest(query, kNumNeighbors);
  if (nearest.size() < kNumNeighbors ||
      nearest.back().squared_distance > max_distance * max_distance) {
    return std::nullopt;
  }
  Spread spread;
  for (int i = 0; i < kNumNeighbors; ++i) {
    spread.centered.col(i) =
        map.points().col(nearest[static_cast<std::size_t>(i)].index);
  }
  spread.mean = spread.centered.rowwise().mean();
  spread.centered.colwise() -= spread.mean;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(
      spread.centered * spread.centered.transpose() / kNumNeighbors);
  spread.values = solver.eigenvalues();
  spread.vectors = solver.eigenvectors();
  return spread;
}

}  // namespace

std::optional<SurfaceMatch> FitLine(const KdTree& map,
                                    const Eigen::Vector3d& source,
                                    const Eigen::Vector3d& query,
                                    double max_distance) {
  const auto spread = SpreadAround(map, query, max_distance);
  if (!spread || !(spread->values[2] > kMinRatio * spread->values[1])) {
    return std::nullopt;
  }
  return SurfaceMatch{source, spread->mean, spread->vectors.col(2)};
}

std::optional<SurfaceMatch> FitPlane(const KdTree& map,
                                     const Eigen::Vector3d& source,
                                     const Eigen::Vector3d& query,
                                     double max_distance) {
  const auto spread = SpreadAround(map, query, max_distance);
  if (!spread || !(spread->values[1] > kMinRatio * spread->values[0])) {
    return std::nullopt;
  }
  const Eigen::Vector3d normal = spread->vectors.col(0);
  if ((normal.transpose() * spread->centered).cwiseAbs().maxCoeff() >
      kMaxPlaneDistance) {
    return std::nullopt;
  }
  return SurfaceMatch{source, spread->mean, normal};
}

}  // namespace quatro
