// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "solvers/ceres/ins_refinement.h"

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "solvers/ceres/ceres_residuals.h"

namespace quatro {
namespace {

// The ratio of the least to the largest eigenvalue of the rotation's curvature
// below which an axis is unobservable.
constexpr double kMinCurvatureRatio = 1e-12;

struct VerticalResidual {
  using CostFunction =
      ceres::AutoDiffCostFunction<VerticalResidual, 3, Turn::kSize>;

  template <typename T>
  bool operator()(const T* r, T* residual) const {
    const Eigen::Vector3<T> turned =
        Turn::Rotate<T>(r, prior.up_in_source.cast<T>());
    for (int i = 0; i < 3; ++i) {
      residual[i] = (turned[i] - prior.up_in_target[i]) / prior.angle_std;
    }
    return true;
  }

  VerticalPrior prior;
};

// The second derivative of half of (1) for R -> exp([delta]x) R at a perfect
// fit, R u = v and q_i = R p_i + t.
Eigen::Matrix3d RotationCurvature(const PointsRef& centered_target,
                                  double noise_sigma,
                                  const VerticalPrior& prior) {
  const Eigen::Matrix3d scatter = centered_target *
                                  centered_target.transpose() /
                                  (noise_sigma * noise_sigma);
  const Eigen::Vector3d up = prior.up_in_target / prior.angle_std;
  return (scatter.trace() + up.squaredNorm()) * Eigen::Matrix3d::Identity() -
         scatter - up * up.transpose();
}

}  // namespace

double VerticalPrior::Cost(const Eigen::Matrix3d& target_from_source) const {
  return (target_from_source * up_in_source - up_in_target).squaredNorm() /
         (angle_std * angle_std);
}

std::optional<InsRefinement> RefineWithIns(
    const PointsRef& source,
    const PointsRef& target,
    double noise_sigma,
    const Rigid3& initial_target_from_source,
    const VerticalPrior& prior) {
  CHECK_EQ(source.cols(), target.cols());
  CHECK_GT(noise_sigma, 0.0);
  CHECK_GT(prior.angle_std, 0.0);
  if (source.cols() < 2 || !source.allFinite() || !target.allFinite()) {
    return std::nullopt;
  }
  const Eigen::Vector3d source_mean = source.rowwise().mean();
  const Eigen::Vector3d target_mean = target.rowwise().mean();
  const Points p = source.colwise() - source_mean;
  const Points q = target.colwise() - target_mean;
  // If either cloud is on one vertical line, the yaw is not observable.
  for (const Points& centered :
       {Points(initial_target_from_source.rotation * p), q}) {
    const Eigen::Vector3d curvature =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(
            RotationCurvature(centered, noise_sigma, prior))
            .eigenvalues();
    if (!(curvature[0] > kMinCurvatureRatio * curvature[2]))
      return std::nullopt;
  }

  Eigen::Quaterniond rotation(initial_target_from_source.rotation);
  Eigen::Vector3d shift =
      initial_target_from_source * source_mean - target_mean;
  ceres::Problem problem;
  problem.AddParameterBlock(
      rotation.coeffs().data(), Turn::kSize, new Turn::Manifold);
  for (Eigen::Index i = 0; i < p.cols(); ++i) {
    problem.AddResidualBlock(
        new PairResidual<Turn>::CostFunction(
            new PairResidual<Turn>{p.col(i), q.col(i), 1.0 / noise_sigma}),
        nullptr,
        rotation.coeffs().data(),
        shift.data());
  }
  problem.AddResidualBlock(
      new VerticalResidual::CostFunction(new VerticalResidual{prior}),
      nullptr,
      rotation.coeffs().data());

  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.function_tolerance = 1e-14;
  options.gradient_tolerance = 1e-14;
  options.parameter_tolerance = 1e-14;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable()) return std::nullopt;

  const Eigen::Matrix3d R = rotation.normalized().toRotationMatrix();
  return InsRefinement{{R, target_mean + shift - R * source_mean},
                       2.0 * summary.final_cost};
}

}  // namespace quatro
