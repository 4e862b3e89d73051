// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/estimators/crosscheck.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "features/base/rigid3.h"
#include "solvers/ceres/ceres_twins.h"
#include "solvers/closed_form/rotation.h"
#include "solvers/closed_form/yaw_translation.h"

namespace quatro {
namespace {

constexpr double kNoAnswer = std::numeric_limits<double>::infinity();

Eigen::Matrix3d TurnedAway(const Eigen::Matrix3d& rotation) {
  const Eigen::Vector3d axis = Eigen::Vector3d(1.0, 2.0, 3.0).normalized();
  return Eigen::AngleAxisd(kCrosscheckStart, axis).toRotationMatrix() *
         rotation;
}

// Translations are compared at the `centroid` of the source, so that a
// difference in rotation does not also count as one in translation.
void Add(const Rigid3& closed_form,
         const Rigid3& twin,
         bool is_usable,
         const Eigen::Vector3d& centroid,
         CrosscheckReport* report) {
  ++report->num_subproblems;
  report->max_rotation_difference =
      std::max(report->max_rotation_difference,
               is_usable ? AngleBetween(closed_form.rotation, twin.rotation)
                         : kNoAnswer);
  report->max_translation_difference =
      std::max(report->max_translation_difference,
               is_usable ? (closed_form * centroid - twin * centroid).norm()
                         : kNoAnswer);
}

}  // namespace

double CrosscheckDifference(const QuasiSo3& subproblem,
                            const WeightsRef& weights,
                            const YawEstimate& closed_form) {
  const auto twin =
      SolveYawByCeres(subproblem.source,
                      subproblem.target,
                      weights,
                      closed_form.target_from_source + kCrosscheckStart);
  if (!twin.is_usable) return kNoAnswer;
  return std::abs(std::remainder(
      twin.estimate.target_from_source - closed_form.target_from_source,
      2.0 * M_PI));
}

double CrosscheckDifference(const So3& subproblem,
                            const WeightsRef& weights,
                            const RotationEstimate& closed_form) {
  const auto twin =
      SolveRotationByCeres(subproblem.source,
                           subproblem.target,
                           weights,
                           TurnedAway(closed_form.target_from_source));
  if (!twin.is_usable) return kNoAnswer;
  return AngleBetween(twin.estimate.target_from_source,
                      closed_form.target_from_source);
}

void CrosscheckPose(const PointsRef& source,
                    const PointsRef& target,
                    std::optional<CrosscheckReport>* report) {
  if (!*report) report->emplace();
  if (source.cols() == 0) return;
  const Weights weights = Weights::Ones(source.cols());
  const Eigen::Vector3d centroid = source.rowwise().mean();
  if (const auto closed = EstimateYawTranslation(source, target, weights)) {
    const Rigid3 start{RotationZ(closed->yaw + kCrosscheckStart),
                       closed->target_from_source.translation};
    const auto twin =
        SolveYawTranslationByCeres(source, target, weights, start);
    Add(closed->target_from_source,
        twin.estimate.target_from_source,
        twin.is_usable,
        centroid,
        &**report);
  }
  if (const auto closed = EstimateRigid(source, target, weights)) {
    const Rigid3 start{TurnedAway(closed->target_from_source.rotation),
                       closed->target_from_source.translation};
    const auto twin = SolvePoseByCeres(source, target, weights, start);
    Add(closed->target_from_source,
        twin.estimate.target_from_source,
        twin.is_usable,
        centroid,
        &**report);
  }
}

}  // namespace quatro
