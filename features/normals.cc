// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/normals.h"

#include <Eigen/Eigenvalues>

#include "features/parallel.h"

namespace quatro {
namespace {

// Second eigenvalue over the largest, below which the points are on a line.
constexpr double kMinPlanarity = 1e-6;

}  // namespace

Points EstimateNormals(const PointsRef& points,
                       const Neighborhoods& neighborhoods,
                       double radius,
                       const Eigen::Vector3d& viewpoint,
                       int num_threads) {
  Points normals = Points::Zero(3, points.cols());
  const auto limit = static_cast<float>(radius * radius);
  const auto estimate = [&](Eigen::Index i) {
    // Moments about the point itself, so that large coordinates cancel.
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
    int count = 0;
    const auto row = static_cast<std::size_t>(i);
    const auto row_end =
        static_cast<std::size_t>(neighborhoods.row_begin[row + 1]);
    for (auto k = static_cast<std::size_t>(neighborhoods.row_begin[row]);
         k < row_end;
         ++k) {
      if (neighborhoods.squared_distance[k] > limit) continue;
      const Eigen::Vector3d offset =
          points.col(neighborhoods.index[k]) - points.col(i);
      sum += offset;
      squares.noalias() += offset * offset.transpose();
      ++count;
    }
    if (count < 3) return;
    const Eigen::Matrix3d scatter = squares - sum * sum.transpose() / count;
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
                for (Eigen::Index i = begin; i < end; ++i) estimate(i);
              });
  return normals;
}

}  // namespace quatro
