// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/odometry/suma/projective_icp.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <sstream>

namespace quatro {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

struct NormalEquations {
  Matrix6 hessian = Matrix6::Zero();
  Vector6 gradient = Vector6::Zero();
  Eigen::Index num_matches = 0;
  double squares = 0.0;    // Sum of r^2 [m^2].
  double distances = 0.0;  // Sum of distances from the sensor [m].
};

NormalEquations Linearize(const VertexMap& scan,
                          const VertexMap& model,
                          const Rigid3& pose,
                          const ProjectiveIcpOptions& options) {
  const double min_cosine = std::cos(options.max_angle);
  NormalEquations equations;
  for (Eigen::Index i = 0; i < scan.image.size(); ++i) {
    if (!scan.HasNormal(i)) continue;
    const Eigen::Vector3d p = pose * Eigen::Vector3d(scan.vertices.col(i));
    const Eigen::Index pixel = model.image.Project(p);
    if (pixel < 0 || !model.HasNormal(pixel)) continue;
    const Eigen::Vector3d n = model.normals.col(pixel);
    const Eigen::Vector3d e = p - model.vertices.col(pixel);
    if (e.squaredNorm() > options.max_distance * options.max_distance ||
        n.dot(pose.rotation * scan.normals.col(i)) < min_cosine) {
      continue;
    }
    const double r = n.dot(e);
    const double weight = std::abs(r) <= options.huber_width
                              ? 1.0
                              : options.huber_width / std::abs(r);
    Vector6 j;
    j << p.cross(n), n;
    equations.hessian += weight * j * j.transpose();
    equations.gradient += weight * r * j;
    equations.squares += r * r;
    equations.distances += p.norm();
    ++equations.num_matches;
  }
  return equations;
}

double Conditioning(const NormalEquations& equations) {
  Vector6 scale = Vector6::Ones();
  scale.head<3>() /=
      equations.distances / static_cast<double>(equations.num_matches);
  const Vector6 values =
      Eigen::SelfAdjointEigenSolver<Matrix6>(
          scale.asDiagonal() * equations.hessian * scale.asDiagonal(),
          Eigen::EigenvaluesOnly)
          .eigenvalues();
  return values[5] > 0.0 ? values[0] / values[5] : 0.0;
}

}  // namespace

bool ProjectiveIcpOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  if (!(max_distance > 0.0)) {
    problem << "max_distance = " << max_distance << ", must be > 0";
  } else if (!(max_angle > 0.0 && max_angle <= M_PI)) {
    problem << "max_angle = " << max_angle << ", must be in (0, pi]";
  } else if (!(huber_width > 0.0)) {
    problem << "huber_width = " << huber_width << ", must be > 0";
  } else if (max_num_iterations < 1) {
    problem << "max_num_iterations = " << max_num_iterations
            << ", must be >= 1";
  } else if (min_num_matches < 6) {
    problem << "min_num_matches = " << min_num_matches << ", must be >= 6";
  } else if (!(min_conditioning > 0.0 && min_conditioning < 1.0)) {
    problem << "min_conditioning = " << min_conditioning
            << ", must be in (0, 1)";
  } else if (!(translation_tolerance >= 0.0 && rotation_tolerance >= 0.0)) {
    problem << "translation_tolerance = " << translation_tolerance
            << ", rotation_tolerance = " << rotation_tolerance
            << ", must be >= 0";
  }
  *error = problem.str();
  return error->empty();
}

ProjectiveIcpSummary AlignProjectively(const VertexMap& scan,
                                       const VertexMap& model,
                                       const Rigid3& initial_model_from_scan,
                                       const ProjectiveIcpOptions& options) {
  ProjectiveIcpSummary summary;
  if (!options.IsValid(&summary.message)) return summary;
  Rigid3 pose = initial_model_from_scan;
  bool has_converged = false;
  while (!has_converged &&
         summary.num_iterations < options.max_num_iterations) {
    const NormalEquations equations = Linearize(scan, model, pose, options);
    ++summary.num_iterations;
    summary.num_matches = equations.num_matches;
    if (equations.num_matches < options.min_num_matches) {
      summary.message = std::to_string(equations.num_matches) +
                        " points have a match, must be at least " +
                        std::to_string(options.min_num_matches);
      return summary;
    }
    summary.rms = std::sqrt(equations.squares /
                            static_cast<double>(equations.num_matches));
    summary.conditioning = Conditioning(equations);
    if (!(summary.conditioning >= options.min_conditioning)) {
      std::ostringstream text;
      text << "the model does not constrain all six degrees of freedom "
              "(conditioning "
           << summary.conditioning << ")";
      summary.message = text.str();
      return summary;
    }
    // Equation (2).
    const Vector6 step = -equations.hessian.ldlt().solve(equations.gradient);
    const Eigen::Vector3d w = step.head<3>();
    const double angle = w.norm();
    const Rigid3 move{
        angle > 0.0 ? Eigen::AngleAxisd(angle, w / angle).toRotationMatrix()
                    : Eigen::Matrix3d(Eigen::Matrix3d::Identity()),
        step.tail<3>()};
    pose = move * pose;
    pose.rotation =
        Eigen::Quaterniond(pose.rotation).normalized().toRotationMatrix();
    has_converged = angle <= options.rotation_tolerance &&
                    step.tail<3>().norm() <= options.translation_tolerance;
  }
  summary.model_from_scan = pose;
  summary.message = has_converged ? "converged" : "not converged";
  return summary;
}

}  // namespace quatro
