// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/odometry/aloam/line_plane_alignment.h"

#include <ceres/ceres.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <sstream>

namespace quatro {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

// The smallest eigenvalue of H over the largest, at a pose.
double Conditioning(const std::vector<SurfaceMatch>& lines,
                    const std::vector<SurfaceMatch>& planes,
                    const Rigid3& pose) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  double squares = 0.0;
  const auto n = static_cast<double>(lines.size() + planes.size());
  for (const auto* matches : {&lines, &planes}) {
    for (const SurfaceMatch& match : *matches) middle += match.source / n;
  }
  for (const auto* matches : {&lines, &planes}) {
    for (const SurfaceMatch& match : *matches) {
      squares += (match.source - middle).squaredNorm() / n;
    }
  }
  const double length = std::sqrt(squares);
  if (!(length > 0.0)) return 0.0;

  Matrix6 hessian = Matrix6::Zero();
  const auto add = [&](const SurfaceMatch& match,
                       const Eigen::Vector3d& direction) {
    const Eigen::Vector3d arm = pose.rotation * (match.source - middle);
    Eigen::Matrix<double, 6, 1> gradient;
    gradient << arm.cross(direction) / length, direction;
    hessian += gradient * gradient.transpose();
  };
  for (const SurfaceMatch& match : planes) add(match, match.direction);
  for (const SurfaceMatch& match : lines) {
    const Eigen::Vector3d u = match.direction.unitOrthogonal();
    add(match, u);
    add(match, match.direction.cross(u));
  }
  const auto values =
      Eigen::SelfAdjointEigenSolver<Matrix6>(hessian, Eigen::EigenvaluesOnly)
          .eigenvalues();
  return values[5] > 0.0 ? values[0] / values[5] : 0.0;
}

}  // namespace

bool LinePlaneOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  if (!(huber_width > 0.0 && std::isfinite(huber_width))) {
    problem << "huber_width = " << huber_width << ", must be > 0 and finite";
  } else if (max_num_iterations < 1) {
    problem << "max_num_iterations = " << max_num_iterations
            << ", must be >= 1";
  } else if (!(min_conditioning >= 0.0 && min_conditioning < 1.0)) {
    problem << "min_conditioning = " << min_conditioning
            << ", must be in [0, 1)";
  }
  *error = problem.str();
  return error->empty();
}

LinePlaneSummary AlignToLinesAndPlanes(const std::vector<SurfaceMatch>& lines,
                                       const std::vector<SurfaceMatch>& planes,
                                       const Rigid3& initial_target_from_source,
                                       const LinePlaneOptions& options) {
  LinePlaneSummary summary;
  if (!options.IsValid(&summary.message)) return summary;
  if (2 * lines.size() + planes.size() < 6) {
    summary.message = std::to_string(lines.size()) + " lines and " +
                      std::to_string(planes.size()) +
                      " planes are too few for a pose";
    return summary;
  }
  summary.conditioning =
      Conditioning(lines, planes, initial_target_from_source);
  if (!(summary.conditioning >= options.min_conditioning &&
        summary.conditioning > 0.0)) {
    std::ostringstream text;
    text << "the matches do not constrain all six degrees of freedom "
            "(conditioning "
         << summary.conditioning << ")";
    summary.message = text.str();
    return summary;
  }

  Eigen::Quaterniond rotation(initial_target_from_source.rotation);
  Eigen::Vector3d translation = initial_target_from_source.translation;
  ceres::Problem problem;
  problem.AddParameterBlock(
      rotation.coeffs().data(), Turn::kSize, new Turn::Manifold);
  const auto add = [&](ceres::CostFunction* cost) {
    problem.AddResidualBlock(cost,
                             new ceres::HuberLoss(options.huber_width),
                             rotation.coeffs().data(),
                             translation.data());
  };
  for (const SurfaceMatch& match : lines) {
    add(new LineResidual::CostFunction(new LineResidual{match}));
  }
  for (const SurfaceMatch& match : planes) {
    add(new PlaneResidual::CostFunction(new PlaneResidual{match}));
  }
  ceres::Solver::Options ceres_options;
  // Thousands of residuals, but only six degrees of freedom.
  ceres_options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  ceres_options.max_num_iterations = options.max_num_iterations;
  ceres_options.num_threads = 1;
  ceres_options.logging_type = ceres::SILENT;
  ceres::Solver::Summary solved;
  ceres::Solve(ceres_options, &problem, &solved);
  if (!solved.IsSolutionUsable() || !translation.allFinite() ||
      !rotation.coeffs().allFinite()) {
    summary.message = "Ceres: " + solved.message;
    return summary;
  }
  summary.target_from_source =
      Rigid3{rotation.normalized().toRotationMatrix(), translation};
  // Ceres minimizes half the sum of squares.
  summary.cost = 2.0 * solved.final_cost;
  summary.message = "aligned";
  return summary;
}

}  // namespace quatro
