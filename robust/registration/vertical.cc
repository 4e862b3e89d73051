// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/registration/vertical.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace quatro {
namespace {

constexpr double kScale = 0.1;  // s of (1).
constexpr double kMaxCosine = 0.5;
constexpr int kNumIterations = 15;
constexpr Eigen::Index kMaxNormals = 4000;
constexpr int kMinNormals = 50;

// The middle eigenvalue of the weighted mean of n n^T must be at least this, or
// the normals have one direction, and any perpendicular direction may be the
// vertical.
constexpr double kMinSpread = 0.02;

}  // namespace

std::optional<Eigen::Vector3d> EstimateVertical(const DescribedCloud& cloud,
                                                const Eigen::Vector3d& guess) {
  const Eigen::Index n = cloud.normals.cols();
  const Eigen::Index step = std::max<Eigen::Index>(1, n / kMaxNormals);
  Eigen::Vector3d up = guess;
  for (int iteration = 0; iteration < kNumIterations; ++iteration) {
    Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
    double sum = 0.0;
    int num = 0;
    for (Eigen::Index i = 0; i < n; i += step) {
      const Eigen::Vector3d normal = cloud.normals.col(i);
      const double cosine = normal.dot(up);
      if (normal.isZero(0.0) || std::abs(cosine) >= kMaxCosine) continue;
      const double weight = 1.0 / (1.0 + cosine * cosine / (kScale * kScale));
      scatter += weight * normal * normal.transpose();
      sum += weight;
      ++num;
    }
    if (num < kMinNormals) return std::nullopt;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter / sum);
    if (solver.eigenvalues()[1] < kMinSpread) return std::nullopt;
    const Eigen::Vector3d last = up;
    up = solver.eigenvectors().col(0);
    if (up.dot(last) < 0.0) up = -up;
    if ((up - last).norm() < 1e-6) break;
  }
  return up;
}

}  // namespace quatro
