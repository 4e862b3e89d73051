// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Fast Global Registration on matched points,
//
//   T = argmin  sum_i rho(r_i),   r_i = |q_i - T p_i|,
//   rho(r) = mu r^2 / (mu + r^2),                                          (1)
//
// the loss of Geman and McClure, by its line process: (1) is the least over
// l_i in [0, 1] of
//
//   E(T, l) = sum_i l_i r_i^2 + mu (sqrt(l_i) - 1)^2,
//   attained at  l_i = ( mu / (mu + r_i^2) )^2.                            (2)
//
// Alternates (2) with one Gauss-Newton step for T, linearised in
// xi = (omega, tau) and composed from the left,
//
//   q_i - T p_i - omega x (T p_i) - tau,     T <- exp(xi) T,               (3)
//
// while mu falls from D^2 to delta^2, divided by 1.4 every four iterations: D
// is the extent of the matched points, at which (1) is nearly convex, delta the
// noise bound. At the last mu the steps go on until they are zero. Full
// rotation and translation; needs three matches.
//
// Not as in the authors' program and Open3D's: there mu itself, not its root,
// is compared with delta (both relative to D), which stops the schedule at
// about sqrt(delta D) in place of delta; and there are 64 iterations, which at
// 1.4 every four bring mu down to no less than D^2 / 218.
//
// Source: Zhou, Park and Koltun, "Fast Global Registration", ECCV 2016.

#ifndef QUATRO_ROBUST_ESTIMATORS_FGR_H_
#define QUATRO_ROBUST_ESTIMATORS_FGR_H_

#include <Eigen/Core>
#include <string>

#include "features/base/rigid3.h"
#include "features/base/types.h"
#include "robust/estimators/pose_summary.h"

namespace quatro {

// The noise, and how fast the loss tightens to it.
struct FgrOptions {
  double noise_bound = 0.3;  // delta [m]

  // D over the largest distance of a matched point from the mean of its cloud.
  double start_scale = 1.0;
  double mu_step = 1.4;
  int iterations_per_mu = 4;
  int max_iterations = 1000;  // Of steps (3).

  // Solved once a step is no longer than this (omega [rad], tau / D).
  double step_tolerance = 1e-10;

  // The first T: that of plain least squares over all matches, to which a large
  // mu leads in the end, or the identity about the means, as in the paper. The
  // steps from there are slow for turns near 180 deg, where the cost is flat.
  bool start_at_plain_fit = false;

  int num_threads = 1;  // 0: all cores. Never changes the answer.

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// The pose, and where the descent ended.
struct FgrSummary : PoseSummary {
  int iterations = 0;
  double mu = 0.0;    // The last one [m^2].
  double cost = 0.0;  // (1) at the last mu and step [m^2].
  double last_step = 0.0;
  bool has_converged = false;  // At mu = delta^2, not out of iterations.
};

// Column i of `source` is matched with column i of `target` [m].
FgrSummary SolveFgr(const PointsRef& source,
                    const PointsRef& target,
                    const FgrOptions& options);

// (3) with the weights (2): sum_i l_i |..|^2 = cost - 2 xi^T b + xi^T A xi.
struct FgrNormalEquations {
  Eigen::Matrix<double, 6, 6> A;
  Eigen::Matrix<double, 6, 1> b;
  double loss = 0.0;  // (1)
};

// (1) at a pose and a mu, line process included.
FgrNormalEquations LinearizeFgr(const PointsRef& source,
                                const PointsRef& target,
                                const Rigid3& target_from_source,
                                double mu,
                                int num_threads);

// exp(xi) T: turned by omega about the origin of the target, then moved by tau.
Rigid3 ComposeLeft(const Eigen::Matrix<double, 6, 1>& xi,
                   const Rigid3& target_from_source);

}  // namespace quatro

#endif  // QUATRO_ROBUST_ESTIMATORS_FGR_H_
