// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/pose_graphs/information.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>

namespace quatro {
namespace {

// Of the largest eigenvalue of the information scaled to a unit diagonal. An
// eigenvalue below is zero up to the rounding of the numbers in a file.
constexpr double kRounding = 1e-5;

}  // namespace

std::optional<Eigen::MatrixXd> RootOfInformation(
    const Eigen::MatrixXd& information) {
  const Eigen::LLT<Eigen::MatrixXd> cholesky(information);
  if (cholesky.info() == Eigen::Success) return cholesky.matrixU();

  // The scale of a freedom is the root of its diagonal element, so that meters
  // and radians are comparable. A freedom that is not measured has zeros only.
  const Eigen::Index n = information.rows();
  Eigen::VectorXd scale(n), inverse(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double diagonal = information(i, i);
    if (diagonal < 0.0 || (diagonal == 0.0 && !information.row(i).isZero(0))) {
      return std::nullopt;
    }
    scale[i] = std::sqrt(diagonal);
    inverse[i] = diagonal > 0.0 ? 1.0 / scale[i] : 0.0;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> scaled(
      inverse.asDiagonal() * information * inverse.asDiagonal());
  if (scaled.info() != Eigen::Success) return std::nullopt;
  const Eigen::VectorXd& eigenvalues = scaled.eigenvalues();  // Increasing.
  const double rounding = kRounding * eigenvalues[n - 1];
  if (!(eigenvalues[n - 1] > 0.0) || eigenvalues[0] < -rounding) {
    return std::nullopt;
  }
  const Eigen::Index rank = (eigenvalues.array() > rounding).count();
  const Eigen::VectorXd roots = eigenvalues.tail(rank).cwiseSqrt();
  return roots.asDiagonal() *
         scaled.eigenvectors().rightCols(rank).transpose() * scale.asDiagonal();
}

}  // namespace quatro
