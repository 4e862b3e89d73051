// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Fast Global Registration on matched points,
//
//   T = argmin  sum_i rho(r_i),   r_i = |q_i - T p_i|,
//   rho(r) = mu r^2 / (mu + r^2),                                          (1)
//
// with the Geman-McClure loss. By its line process, (1) is the minimum over l_i
// in [0, 1] of
//
//   E(T, l) = sum_i l_i r_i^2 + mu (sqrt(l_i) - 1)^2,
//   attained at  l_i = ( mu / (mu + r_i^2) )^2.                            (2)
//
// The solver alternates (2) with one Gauss-Newton step for T, linearized in
// xi = (omega, tau) and composed from the left,
//
//   q_i - T p_i - omega x (T p_i) - tau,     T <- exp(xi) T,               (3)
//
// while mu falls from D^2 to delta^2, divided by 1.4 every four iterations. D
// is the extent of the matched points, so that (1) is nearly convex at mu =
// D^2. delta is the noise bound, a radius. At the last mu the steps continue
// until convergence. The full rotation and the translation are estimated, from
// at least three matches.
//
// Differences from the authors' program and Open3D: these compare mu itself,
// not its root, with delta (both relative to D), so their schedule stops at a
// scale of about sqrt(delta D) instead of delta. They also stop after 64
// iterations, which lower mu by a factor of 218 at most.
//
// A match far from the others (FindNear() in robust/graph/far_matches.h) is
// ignored, because one stray coordinate would set D, and its lever would
// dominate the pose.
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

// The noise bound, the schedule of mu, and when to stop.
struct FgrOptions {
  double noise_bound = 0.3;  // delta, a radius [m].

  // D over the largest distance of a matched point from the mean of its cloud.
  double start_scale = 1.0;
  double mu_step = 1.4;
  int iterations_per_mu = 4;
  int max_iterations = 1000;  // Steps (3).

  // Converged once mu is delta^2 and the norm of a step (omega [rad], tau / D)
  // is at most this.
  double step_tolerance = 1e-10;

  // The initial T. If true, the least-squares pose of all matches, which is
  // also the minimum for large mu. If false, the identity about the means, as
  // in the paper. From there the steps are slow for rotations near 180 deg,
  // where the cost is flat.
  bool start_at_plain_fit = false;

  int num_threads = 1;  // 0: all cores. Does not change the result.

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// The pose, and where the iterations ended.
struct FgrSummary : PoseSummary {
  int iterations = 0;
  double mu = 0.0;             // After the last step [m^2].
  double cost = 0.0;           // (1) before the last step, at its mu [m^2].
  double last_step = 0.0;      // Norm of (omega [rad], tau / D).
  bool has_converged = false;  // At mu = delta^2.
};

// Column i of `source` is matched with column i of `target` [m].
FgrSummary SolveFgr(const PointsRef& source,
                    const PointsRef& target,
                    const FgrOptions& options);

// The normal equations of (3) with the weights (2): the weighted sum of squares
// is sum_i l_i r_i^2 - 2 xi^T b + xi^T A xi.
struct FgrNormalEquations {
  Eigen::Matrix<double, 6, 6> A;
  Eigen::Matrix<double, 6, 1> b;
  double loss = 0.0;  // (1)
};

// Linearizes (1) at a pose and a mu.
FgrNormalEquations LinearizeFgr(const PointsRef& source,
                                const PointsRef& target,
                                const Rigid3& target_from_source,
                                double mu,
                                int num_threads);

// exp(xi) T in (3): T followed by a rotation by omega about the origin of the
// target, then by a translation by tau.
Rigid3 ComposeLeft(const Eigen::Matrix<double, 6, 1>& xi,
                   const Rigid3& target_from_source);

}  // namespace quatro

#endif  // QUATRO_ROBUST_ESTIMATORS_FGR_H_
