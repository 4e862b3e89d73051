// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Graduated non-convexity (GNC) for any ceres::Problem some of whose residual
// blocks may be outliers. The problem is
//
//   min_x  1/2 sum_{i candidate} min(rho_i(|r_i(x)|^2), c_i^2)
//        + 1/2 sum_{k inlier} rho_k(|r_k(x)|^2)                             (1)
//
// with the surrogate TruncatedLeastSquares; the other surrogates replace the
// minimum by their own losses. The loop of robust/gnc/gnc.h alternates weights
// w_i in [0, 1] for fixed x, in closed form, and x for fixed weights by
// ceres::Solve(), which starts from the previous x. Usage:
//
//   CeresGncOptions options;
//   options.bound = 0.1;                        // Or by inlier_probability.
//   const CeresGncSummary summary = SolveCeresGnc(&problem, options);
//   if (!summary.IsUsable()) LOG(ERROR) << summary.FullReport();
//   for (ceres::ResidualBlockId id : my_blocks)
//     if (summary.blocks.at(id).weight < 0.5) ...
//
// Bounds. c_i is the largest |r_i| of an inlier, a bound on the norm of the
// block. inlier_probability sets it to the chi-square bound for as many degrees
// of freedom as the block has residuals, which is correct if these are whitened
// and independent. (Ceres' cost is half of |r|^2; the bound is on |r|, without
// the half.)
//
// Greed. Truncated least squares with mu_step = 1.4 rejects fast. If the plain
// fit is far off, it can settle on an accidental consensus. A mu_step of 1.1,
// or Geman-McClure, takes more solves and fails less often.
//
// Tolerances. With a Ceres function_tolerance below 1e-14, Ceres may treat
// steps at the level of rounding errors as a failure.
//
// Speed. With `plain_fit` and `loose` of the options, the loop solves no more
// than needed. Blocks of weight zero are left out of the problem that is
// solved.
//
// Losses of blocks. The weight multiplies rho_i, and rho_i is compared with
// c_i^2, so both steps of the loop decrease the same cost. A ScaledLoss may
// therefore do the whitening. A loss that never reaches c_i^2 is an error,
// because its block could never be rejected.
//
// Roles. Known inliers keep weight 1 and known outliers 0; known outliers are
// not evaluated. If `candidates` is set, blocks in none of the lists are
// inliers. Only the residuals of candidates determine the initial mu. It is an
// error to name a block twice, in two roles, or one that is not in the problem,
// and to give a bound for a block that is not a candidate.
//
// The caller's problem keeps its blocks, losses, manifolds, bounds, constant
// blocks and ownership (robust/gnc/weighted_problem.h); nothing is kept from
// one call to the next. Only the values of the parameters change: to the
// solution if there is one, else back to the values before the call.
//
// Time: the inner solves and, per iteration, one evaluation of the candidates'
// residuals. Memory: O(residual and parameter blocks). With
// solver.num_threads = 1 the result is the same bit for bit each time; with
// more threads Ceres adds in a varying order.
//
// Source: Yang, Antonante, Tzoumas and Carlone, "Graduated Non-Convexity for
// Robust Spatial Perception", RA-L 2020.

#ifndef QUATRO_ROBUST_GNC_CERES_GNC_H_
#define QUATRO_ROBUST_GNC_CERES_GNC_H_

#include <ceres/ceres.h>

#include <string>
#include <unordered_map>
#include <vector>

#include "robust/gnc/ceres_gnc_options.h"
#include "robust/gnc/gnc.h"

namespace quatro {

// Why the loop ended, and the role and weight of every block.
struct CeresGncSummary {
  GncTermination termination = GncTermination::kInvalidOptions;
  std::string message = "SolveCeresGnc was not called";

  // Every residual block of the problem. Without a solution the weights are the
  // last ones tried. Empty if GNC was not run.
  std::unordered_map<ceres::ResidualBlockId, GncBlock> blocks;

  // `cost` is that of Ceres: half of the weighted sum, known inliers included.
  std::vector<GncIteration> iterations;

  // The plain fit, one summary for each iteration and, with
  // CeresGncOptions::loose, the last solve. The last one may have failed.
  std::vector<ceres::Solver::Summary> inner;

  double total_seconds = 0.0;
  double solver_seconds = 0.0;  // Sum over `inner`.

  // Whether the parameters are a solution. This does not say that it is
  // correct.
  bool IsUsable() const {
    return termination == GncTermination::kAllInliers ||
           termination == GncTermination::kConverged ||
           termination == GncTermination::kMaxNumIterations;
  }

  std::string BriefReport() const;  // One line.
  std::string FullReport() const;   // With the iterations.
};

// Starts from the parameter values in the problem. Writes the solution there,
// if there is one.
CeresGncSummary SolveCeresGnc(ceres::Problem* problem,
                              const CeresGncOptions& options);

}  // namespace quatro

#endif  // QUATRO_ROBUST_GNC_CERES_GNC_H_
