// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A surrogate of robust/gnc/surrogate.h as a ceres::LossFunction, for callers
// that update mu themselves (SolveCeresGnc() in robust/gnc/ceres_gnc.h does so
// for you),
//
//   rho(s) = c^2 rho_mu(s / c^2),   s = |r|^2,  c the largest |r| of an inlier.
//
// The loss reads mu through the caller's pointer at every evaluation. For
// example, an IterationCallback can lower it after each step:
//
//   double mu = GemanMcClure::InitialMu(max_r2, GncStart::kIdentity);
//   problem.AddResidualBlock(cost, new GncLoss<GemanMcClure>(c, &mu), x);
//
//   CallbackReturnType operator()(const IterationSummary& step) override {
//     if (step.step_is_successful) *mu_ = GemanMcClure::NextMu(*mu_, 1.4);
//     return SOLVER_CONTINUE;
//   }
//
// Within one ceres::Solve() this works only for surrogates whose loss falls
// along the schedule, GemanMcClure and Welsch: Ceres compares the cost of a
// step with the previous cost, which was evaluated at the previous mu. The loss
// of TruncatedLeastSquares rises, so Ceres would reject every step; it needs
// one Solve() for each mu.

#ifndef QUATRO_ROBUST_GNC_GNC_LOSS_H_
#define QUATRO_ROBUST_GNC_GNC_LOSS_H_

#include <ceres/loss_function.h>

#include "robust/gnc/surrogate.h"

namespace quatro {

// A surrogate as a ceres::LossFunction with an external mu.
template <typename Surrogate>
class GncLoss final : public ceres::LossFunction {
 public:
  // `bound` c > 0 is on the norm of the residual block. `mu` must outlive this
  // object and be > 0.
  GncLoss(double bound, const double* mu) : c2_(bound * bound), mu_(mu) {}

  void Evaluate(double s, double* rho) const override {
    const double r2 = s / c2_;
    rho[0] = c2_ * Surrogate::Loss(r2, *mu_);
    rho[1] = Surrogate::Weight(r2, *mu_);
    rho[2] = Surrogate::WeightSlope(r2, *mu_) / c2_;
  }

 private:
  double c2_;
  const double* mu_;
};

}  // namespace quatro

#endif  // QUATRO_ROBUST_GNC_GNC_LOSS_H_
