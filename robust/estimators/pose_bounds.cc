// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/estimators/pose_bounds.h"

#include <algorithm>
#include <sstream>

namespace quatro {
namespace {

constexpr double kAngleTolerance = 0.01;  // [rad]

// How far a pose is from the guess.
struct Step {
  double translation;  // [m]
  YawAndTilt rotation;
};

Step StepFromGuess(const PoseBounds& bounds, const Rigid3& pose) {
  return {
      (pose.translation - bounds.guess.translation).norm(),
      Decompose(pose.rotation * bounds.guess.rotation.transpose(), bounds.up)};
}

long Degrees(double angle) { return std::lround(angle * 180.0 / M_PI); }

}  // namespace

YawAndTilt Decompose(const Eigen::Matrix3d& rotation,
                     const Eigen::Vector3d& up) {
  Eigen::Quaterniond q(rotation);
  if (q.w() < 0.0) q.coeffs() *= -1.0;
  const double along = q.vec().dot(up);
  return {2.0 * std::atan2(along, q.w()),
          2.0 * std::atan2((q.vec() - along * up).norm(),
                           std::hypot(along, q.w()))};
}

bool PoseBounds::IsValid(std::string* error) const {
  std::ostringstream problem;
  const Eigen::Matrix3d& rotation = guess.rotation;
  if (!guess.translation.allFinite() || !rotation.allFinite()) {
    problem << "bounds.guess has a number that is not finite, must be a rigid "
               "motion target_from_source";
  } else if (!rotation.isUnitary(1e-6) || rotation.determinant() < 0.0) {
    problem << "bounds.guess has no rotation in its first three columns, must "
               "be orthonormal to 1e-6 with determinant 1";
  } else if (!(max_translation >= 0.0)) {
    problem << "bounds.max_translation = " << max_translation
            << ", must be >= 0; infinity for none";
  } else if (!(max_yaw >= 0.0 && max_yaw <= M_PI)) {
    problem << "bounds.max_yaw = " << max_yaw << ", must be in [0, pi]";
  } else if (!(max_tilt >= 0.0 && max_tilt <= M_PI)) {
    problem << "bounds.max_tilt = " << max_tilt << ", must be in [0, pi]";
  } else if (!(std::abs(up.norm() - 1.0) <= 1e-6)) {
    problem << "bounds.up = (" << up.transpose() << "), must be a unit vector";
  }
  *error = problem.str();
  return error->empty();
}

bool PoseBounds::Contain(const Rigid3& target_from_source,
                         double noise_bound) const {
  if (!IsActive()) return true;
  const Step step = StepFromGuess(*this, target_from_source);
  return step.translation <= max_translation + noise_bound &&
         std::abs(step.rotation.yaw) <= max_yaw + kAngleTolerance &&
         step.rotation.tilt <= max_tilt + kAngleTolerance;
}

double PoseBounds::DistanceToArc(const Eigen::Vector3d& source,
                                 const Eigen::Vector3d& target) const {
  const Eigen::Vector3d turned = guess.rotation * source;
  const Eigen::Vector3d seen = target - guess.translation;
  const double height = (seen - turned).dot(up);
  const Eigen::Vector3d from = turned - turned.dot(up) * up;
  const Eigen::Vector3d to = seen - seen.dot(up) * up;
  const double angle =
      std::abs(std::atan2(from.cross(to).dot(up), from.dot(to)));
  const double beyond = std::max(0.0, angle - max_yaw);
  const double radius = from.norm();
  return Eigen::Vector3d(to.norm() - radius * std::cos(beyond),
                         radius * std::sin(beyond),
                         height)
      .norm();
}

bool PoseBounds::CanBeInlier(const Eigen::Vector3d& source,
                             const Eigen::Vector3d& target,
                             double noise_bound) const {
  if (!IsActive()) return true;
  return DistanceToArc(source, target) <=
         max_translation + std::sqrt(3.0) * noise_bound +
             2.0 * std::sin(0.5 * max_tilt) * source.norm();
}

std::vector<Eigen::Index> PoseBounds::PossibleInliers(
    const PointsRef& source,
    const PointsRef& target,
    double noise_bound) const {
  std::vector<Eigen::Index> columns;
  for (Eigen::Index i = 0; i < source.cols(); ++i) {
    if (CanBeInlier(source.col(i), target.col(i), noise_bound)) {
      columns.push_back(i);
    }
  }
  return columns;
}

std::string PoseBounds::Describe(const Rigid3& target_from_source) const {
  const Step step = StepFromGuess(*this, target_from_source);
  std::ostringstream text;
  text.precision(3);
  text << step.translation << " m, " << Degrees(std::abs(step.rotation.yaw))
       << " deg of yaw and " << Degrees(step.rotation.tilt)
       << " deg of tilt from the guess; the bounds allow " << max_translation
       << " m, " << Degrees(max_yaw) << " deg and " << Degrees(max_tilt)
       << " deg";
  return text.str();
}

}  // namespace quatro
