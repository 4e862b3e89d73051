// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/normals.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "features/base/parallel.h"

namespace quatro {
namespace {

// The ratio of the second to the largest eigenvalue below which the points are
// on a line.
constexpr double kMinPlanarity = 1e-6;

// The scatter of the points in `near` about their mean. Computes moments about
// point i, so that large coordinates cancel.
Eigen::Matrix3d ScatterOf(const PointsRef& points,
                          Eigen::Index i,
                          std::span<const std::int32_t> near) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();   // xx, yy, zz
  Eigen::Vector3d products = Eigen::Vector3d::Zero();  // xy, yz, zx
  const Eigen::Vector3d center = points.col(i);
  for (const std::int32_t j : near) {
    const Eigen::Vector3d offset = points.col(j) - center;
    sum += offset;
    squares += offset.cwiseProduct(offset);
    products += offset.cwiseProduct(
        Eigen::Vector3d(offset.y(), offset.z(), offset.x()));
  }
  Eigen::Matrix3d scatter;
  scatter << squares[0], products[0], products[2],  //
      products[0], squares[1], products[1],         //
      products[2], products[1], squares[2];
  return scatter - sum * sum.transpose() / static_cast<double>(near.size());
}

}  // namespace

Points EstimateNormals(const PointsRef& points,
                       const Neighborhoods& neighborhoods,
                       double radius,
                       const Eigen::Vector3d& viewpoint,
                       int num_threads) {
  Points normals = Points::Zero(3, points.cols());
  const auto limit = static_cast<float>(radius * radius);
  const auto estimate = [&](Eigen::Index i, std::vector<std::int32_t>* near) {
    const Neighborhoods::Row& row = neighborhoods.row(i);
    // Avoids a branch, which would be unpredictable.
    near->resize(std::max(near->size(), row.size()));
    std::size_t count = 0;
    for (std::size_t k = 0; k < row.size(); ++k) {
      (*near)[count] = row.index[k];
      count += row.squared_distance[k] <= limit ? 1 : 0;
    }
    if (count < 3) return;
    const Eigen::Matrix3d scatter =
        ScatterOf(points, i, std::span(near->data(), count));
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    solver.computeDirect(scatter);
    if (!(solver.eigenvalues()[1] > kMinPlanarity * solver.eigenvalues()[2])) {
      return;
    }
    const Eigen::Vector3d normal = solver.eigenvectors().col(0).normalized();
    const bool is_away = normal.dot(viewpoint - points.col(i)) < 0.0;
    normals.col(i) = is_away ? -normal : normal;
  };
  ParallelFor(num_threads,
              points.cols(),
              256,
              [&](Eigen::Index begin, Eigen::Index end) {
                std::vector<std::int32_t> near;
                for (Eigen::Index i = begin; i < end; ++i) estimate(i, &near);
              });
  return normals;
}

}  // namespace quatro
