// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Graduated non-convexity for any ceres::Problem: of its residual blocks some
// may be outliers, and
//
//   min_x  1/2 sum_{i candidate} min(rho_i(|r_i(x)|^2), c_i^2)
//        + 1/2 sum_{k inlier} rho_k(|r_k(x)|^2)                             (1)
//
// is approached by the loop of robust/gnc/gnc.h: weights w_i in [0, 1] for a
// fixed x in closed form, and x for fixed weights by ceres::Solve(), each from
// where the last one ended. (1) is with TruncatedLeastSquares; the other
// surrogates stand for their own losses. Ten lines:
//
//   CeresGncOptions options;
//   options.bound = 0.1;                        // Or by inlier_probability.
//   const CeresGncSummary summary = SolveCeresGnc(&problem, options);
//   if (!summary.IsUsable()) LOG(ERROR) << summary.FullReport();
//   for (ceres::ResidualBlockId id : my_blocks)
//     if (summary.blocks.at(id).weight < 0.5) ...
//
// Bounds. c_i is the largest |r_i| of an inlier. By inlier_probability it is
// the chi-square bound for as many degrees of freedom as the block has
// residuals: right if these are whitened and independent. (Ceres' cost is half
// of |r|^2; the bound is of |r|, without the half.)
//
// Greed. Truncated least squares at the step of 1.4 forgets fast: where the
// plain fit is far off it can settle on chance. A mu_step of 1.1, or Geman and
// McClure's, cost more solves and go wrong less.
//
// Tolerances. Where all inner solves have to agree to the last digits, Ceres
// may take steps that are no more than rounding for a failure; its own
// function_tolerance below 1e-14 asks for that.
//
// A block's own loss. Weights multiply rho_i, and it is rho_i that is held
// against c_i^2, so that both halves of the loop lower (1): a ScaledLoss may do
// the whitening. A loss that never reaches its bound could never be rejected
// and is refused.
//
// Known inliers keep weight 1, known outliers 0; known outliers are not
// evaluated. Blocks that are none of these, where candidates are named, are
// inliers. Neither has a say in the start of mu. What contradicts itself is
// refused: a block named twice, in two roles, or not in the problem; a bound
// for a block that is no candidate.
//
// The caller's problem keeps its blocks, losses, manifolds, bounds, constant
// blocks and ownership (robust/gnc/weighted_problem.h); nothing is kept from
// one call to the next. Only the values of parameters change. They are those of
// the answer if there is one; if not, those before the call.
//
// Time is that of the inner solves and, per iteration, one evaluation of the
// candidates' residuals; memory O(residual and parameter blocks). With
// solver.num_threads = 1 the answer is the same bit for bit each time; with
// more Ceres adds up in another order.
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

// How the loop ended, and every block's part in it.
struct CeresGncSummary {
  GncTermination termination = GncTermination::kInvalidOptions;
  std::string message = "SolveCeresGnc was not called";

  // Every residual block of the problem, where there is no answer with the
  // weights tried last; empty if GNC was not run.
  std::unordered_map<ceres::ResidualBlockId, GncBlock> blocks;

  // Of `cost` as Ceres counts it: half of the weighted sum, known inliers
  // included.
  std::vector<GncIteration> iterations;

  // The plain fit, then one for each iteration; of a failure the last.
  std::vector<ceres::Solver::Summary> inner;

  double total_seconds = 0.0;
  double solver_seconds = 0.0;  // Of `inner` together.

  // Whether the parameters hold an answer; whether it is right is another
  // question.
  bool IsUsable() const {
    return termination == GncTermination::kAllInliers ||
           termination == GncTermination::kConverged ||
           termination == GncTermination::kMaxNumIterations;
  }

  std::string BriefReport() const;  // One line.
  std::string FullReport() const;   // And the trace.
};

// Starts from the values in the problem and leaves the answer there, if there
// is one.
CeresGncSummary SolveCeresGnc(ceres::Problem* problem,
                              const CeresGncOptions& options);

}  // namespace quatro

#endif  // QUATRO_ROBUST_GNC_CERES_GNC_H_
