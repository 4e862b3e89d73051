// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "solvers/ceres/observability.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>

namespace quatro {
namespace {

using Eigen3 = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>;

// Chooses the sign of the axis so that its coordinate of largest magnitude is
// positive.
Eigen::Vector3d WithSign(const Eigen::Vector3d& axis) {
  Eigen::Index largest = 0;
  axis.cwiseAbs().maxCoeff(&largest);
  return axis[largest] < 0.0 ? Eigen::Vector3d(-axis) : axis;
}

std::string Text(const Eigen::Vector3d& vector, int digits) {
  char text[128];
  // Rounds first, so that no coordinate reads -0.00.
  const double unit = std::pow(10.0, digits);
  const Eigen::Vector3d rounded =
      ((vector * unit).array().round() / unit + 0.0).matrix();
  std::snprintf(text,
                sizeof(text),
                "(%.*f, %.*f, %.*f)",
                digits,
                rounded.x(),
                digits,
                rounded.y(),
                digits,
                rounded.z());
  return text;
}

std::string Text(Freedom freedom, const std::optional<double>& std_dev) {
  if (!std_dev) return "unbounded";
  char text[64];
  const bool is_angle = freedom == Freedom::kRotation;
  std::snprintf(text,
                sizeof(text),
                "standard deviation %.3g %s",
                is_angle ? *std_dev * 180.0 / M_PI : *std_dev,
                is_angle ? "deg" : "m");
  return text;
}

}  // namespace

std::vector<DirectionInformation> SplitInformation(
    const Matrix6& information,
    const Eigen::Vector3d& center,
    double min_information) {
  const Eigen::Matrix3d A_ww = information.topLeftCorner<3, 3>();
  const Eigen::Matrix3d A_uw = information.bottomLeftCorner<3, 3>();
  const Eigen3 translations(information.bottomRightCorner<3, 3>());
  std::vector<DirectionInformation> directions;
  Eigen::Matrix3d u_from_w = Eigen::Matrix3d::Zero();  // -A_uu^+ A_uw
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d axis = translations.eigenvectors().col(i);
    const double eigenvalue = std::max(0.0, translations.eigenvalues()[i]);
    directions.push_back(
        {Freedom::kTranslation, WithSign(axis), center, eigenvalue});
    if (eigenvalue > 0.0 && eigenvalue >= min_information) {
      u_from_w -= axis * (axis.transpose() * A_uw) / eigenvalue;
    }
  }
  const Eigen::Matrix3d schur = A_ww + A_uw.transpose() * u_from_w;
  const Eigen3 rotations(0.5 * (schur + schur.transpose()));
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d w = WithSign(rotations.eigenvectors().col(i));
    const Eigen::Vector3d u = u_from_w * w;
    directions.push_back({Freedom::kRotation,
                          w,
                          center + w.cross(u),
                          std::max(0.0, rotations.eigenvalues()[i])});
  }
  return directions;
}

std::string UnobservableDirection::Describe() const {
  std::string text = freedom == Freedom::kTranslation
                         ? "position along the axis " + Text(axis, 2)
                         : "rotation about the axis " + Text(axis, 2) +
                               " through " + Text(point, 1);
  switch (reason) {
    case UnobservableReason::kNoData:
      return text + ": no inlier constrains it";
    case UnobservableReason::kWithinNoise:
      return text + ": it changes the inliers by less than their noise";
    case UnobservableReason::kUncertain:
      return text + ": " + Text(freedom, standard_deviation);
    case UnobservableReason::kAssumed:
      return text + ": not estimated, but assumed with " +
             Text(freedom, standard_deviation);
    case UnobservableReason::kNoSurface:
      break;
  }
  return text + ": no surface constrains it";
}

}  // namespace quatro
