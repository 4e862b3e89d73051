// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "solvers/closed_form/rotation.h"

#include <glog/logging.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>

#include "solvers/closed_form/centroid.h"

namespace quatro {
namespace {

// The least eigenvalue of (3) counts as zero below this fraction of sum_i w_i
// |s_i| |t_i|. At this fraction the rounding of M alone, 1e-16 of that sum,
// could rotate the estimate by 1e-4 rad.
constexpr double kMinCurvature = 1e-12;

struct RotationOfM {
  Eigen::Matrix3d target_from_source;
  double least_curvature = 0.0;
};

// Equation (2).
RotationOfM RotationBySvd(const Eigen::Matrix3d& M) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(
      M, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Matrix3d& U = svd.matrixU();
  const Eigen::Matrix3d& V = svd.matrixV();
  const double sign = U.determinant() * V.determinant() < 0.0 ? -1.0 : 1.0;
  const Eigen::Vector3d& d = svd.singularValues();
  return {U * Eigen::Vector3d(1.0, 1.0, sign).asDiagonal() * V.transpose(),
          2.0 * (d[1] + sign * d[2])};
}

// `floor` [m^2] is the curvature that rounding of the points can cause.
std::optional<RotationEstimate> Estimate(const PointsRef& source,
                                         const PointsRef& target,
                                         const WeightsRef& weights,
                                         double floor) {
  CHECK_EQ(source.cols(), target.cols());
  CHECK_EQ(source.cols(), weights.size());

  Eigen::Matrix3d M = Eigen::Matrix3d::Zero();
  double scale = 0.0;
  for (Eigen::Index i = 0; i < source.cols(); ++i) {
    M += weights[i] * target.col(i) * source.col(i).transpose();
    scale += weights[i] * source.col(i).norm() * target.col(i).norm();
  }
  if (!M.allFinite()) return std::nullopt;

  const auto [R, least_curvature] = RotationBySvd(M);
  if (!(least_curvature > std::max(kMinCurvature * scale, floor))) {
    return std::nullopt;
  }

  RotationEstimate rotation;
  rotation.target_from_source = R;
  const Eigen::Matrix3d B = M * R.transpose();
  rotation.curvature =
      2.0 * B.trace() * Eigen::Matrix3d::Identity() - (B + B.transpose());
  // Summed from residuals, because the expanded form of (1) would cancel.
  rotation.cost =
      (target - R * source).colwise().squaredNorm().transpose().dot(weights);
  return rotation;
}

}  // namespace

std::optional<RotationEstimate> EstimateRotation(const PointsRef& source,
                                                 const PointsRef& target,
                                                 const WeightsRef& weights) {
  return Estimate(source, target, weights, /*floor=*/0.0);
}

std::optional<RigidEstimate> EstimateRigid(const PointsRef& source,
                                           const PointsRef& target,
                                           const WeightsRef& weights) {
  CHECK_EQ(source.cols(), target.cols());
  CHECK_EQ(source.cols(), weights.size());
  const double total_weight = weights.sum();
  if (!(total_weight > 0.0)) return std::nullopt;

  const CenteredPoints p = Center(source, weights);
  const CenteredPoints q = Center(target, weights);
  const double floor = RoundingOfMoments(p, q, weights);
  const auto rotation = Estimate(p.points, q.points, weights, floor);
  if (!rotation) return std::nullopt;

  const Eigen::Matrix3d& R = rotation->target_from_source;
  RigidEstimate rigid;
  rigid.target_from_source = {R, q.centroid - R * p.centroid};
  rigid.cost = rotation->cost;
  rigid.curvature.topLeftCorner<3, 3>() = rotation->curvature;
  rigid.curvature.bottomRightCorner<3, 3>() =
      2.0 * total_weight * Eigen::Matrix3d::Identity();
  return rigid;
}

}  // namespace quatro
