// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The covariance of a pose from matched points. With Gaussian noise of standard
// deviation sigma on each axis of q_i, the least-squares pose
//
//   min_{R, t}  sum_i |q_i - R p_i - t|^2 / sigma^2                        (1)
//
// has the covariance (J^T J)^-1 of the error (w, d), both in the target frame,
//
//   true R = exp([w]x) R,   true t = t + d,                                (2)
//
// with w [rad] in the first three places and d [m] in the last three. Here w is
// a rotation about the axes of the target, and d a translation of the image of
// the source's origin. Far from that origin, w and d are strongly correlated,
// and (2) holds to first order only as long as |R mean(p)| |w|^2 is small. The
// following form avoids both, with rotations about c = R mean(p) + t and
// translations u of c,
//
//   true target_from_source: p -> exp([w]x) (R p + t - c) + c + u,         (3)
//   d = u + (R mean(p)) x w.
//
// Ceres computes the covariance for (1) at the given pose, by a dense singular
// value decomposition that reveals the rank. For many matches J^T J is inverted
// instead.
//
// Unobservable directions are listed. If nothing constrains a direction, or if
// all points are practically on one axis, there is no covariance, because no
// number would be meaningful.
//
// The model ignores that errors of matches are correlated, for example because
// the matches are neighbors in a scan or the sensor is biased. It also ignores
// that some estimators do not minimize (1); see `offset`. So on real pairs the
// covariance is too small: the squared normalized error is tens instead of 6.
// If there are clouds, robust/verdict/contact_covariance.h replaces it.

#ifndef QUATRO_SOLVERS_CERES_POSE_COVARIANCE_H_
#define QUATRO_SOLVERS_CERES_POSE_COVARIANCE_H_

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "features/base/rigid3.h"
#include "features/base/types.h"
#include "solvers/ceres/ins_refinement.h"
#include "solvers/ceres/observability.h"

namespace quatro {

// The degrees of freedom that were estimated.
enum class PoseModel {
  kRigid,  // All six degrees of freedom.
  // A rotation about the vertical and a translation. The tilt, a rotation about
  // a level axis, is assumed with a standard deviation of `tilt_std`. The
  // covariance includes this error and its effect on yaw and translation.
  kYawTranslation,
};

// How the covariance is computed, and when a direction counts as observable.
struct CovarianceOptions {
  // Estimate sigma from the residuals, but not below sigma / 3, if there are
  // more residuals than degrees of freedom.
  bool sigma_from_residuals = false;

  // For kYawTranslation: the standard deviation of the tilt about each level
  // axis [rad].
  double tilt_std = 0.0175;

  // Directions with a larger standard deviation at c are reported as uncertain.
  double max_rotation_std = 0.01;    // [rad]
  double max_translation_std = 0.3;  // [m]

  // A rotation about an axis counts as unobservable if the root mean square
  // distance of the points from the axis is not above this many sigma, because
  // then noise alone would constrain it.
  double min_lever = 2.0;

  // If there are more matches, J^T J is summed and inverted without Ceres.
  Eigen::Index max_ceres_matches = 2000;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// All options, including those that depend on the estimator.
struct PoseCovarianceOptions : CovarianceOptions {
  PoseModel model = PoseModel::kRigid;

  double sigma = 0.1;  // Standard deviation of a match on each axis [m].

  // For kYawTranslation: the vertical in the target frame, a unit vector.
  Eigen::Vector3d up_in_target = Eigen::Vector3d::UnitZ();

  // For kRigid: a term that is added to (1) (solvers/ceres/ins_refinement.h).
  std::optional<VerticalPrior> prior;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// The covariance of a pose, and the directions that are unobservable or
// uncertain.
struct PoseCovariance {
  std::optional<Matrix6> covariance;            // Covariance of w and d in (2).
  std::optional<Matrix6> covariance_at_center;  // Covariance of w and u in (3).
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  // c [m]

  std::vector<UnobservableDirection> unobservable;

  // The number of observable degrees of freedom, out of the 6 or 4 estimated.
  int rank = 0;

  double sigma = 0.0;                     // The sigma that was used [m].
  std::optional<double> estimated_sigma;  // Estimate from the residuals [m].

  // The distance from the pose to the minimum of (1) in standard deviations. If
  // it is not small compared with 1, the pose comes from an estimator with
  // another cost, and the covariance is that of the minimum.
  double offset = 0.0;

  std::string message = "no covariance was computed";
};

// The covariance of (2) from that of (3). `arm` is c - t, from the image of the
// source's origin to the center [m].
Matrix6 CovarianceAtOrigin(const Matrix6& covariance_at_center,
                           const Eigen::Vector3d& arm);

// Column i of `source` is matched with column i of `target` [m]. All matches
// are assumed to be inliers. If sizes differ, something is not finite, or an
// option is out of range, there is no covariance and the message says why.
PoseCovariance ComputePoseCovariance(const PointsRef& source,
                                     const PointsRef& target,
                                     const Rigid3& target_from_source,
                                     const PoseCovarianceOptions& options);

}  // namespace quatro

#endif  // QUATRO_SOLVERS_CERES_POSE_COVARIANCE_H_
