// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A surrogate of robust/gnc/surrogate.h as a loss of Ceres, for those who drive
// mu themselves; SolveCeresGnc() (robust/gnc/ceres_gnc.h) does it for you,
//
//   rho(s) = c^2 rho_mu(s / c^2),   s = |r|^2,  c the largest |r| of an inlier.
//
// mu is read at every evaluation from where the caller keeps it, e.g. from an
// IterationCallback that lowers it after each step:
//
//   double mu = GemanMcClure::InitialMu(max_r2, GncStart::kIdentity);
//   problem.AddResidualBlock(cost, new GncLoss<GemanMcClure>(c, &mu), x);
//
//   CallbackReturnType operator()(const IterationSummary& step) override {
//     if (step.step_is_successful) *mu_ = GemanMcClure::NextMu(*mu_, 1.4);
//     return SOLVER_CONTINUE;
//   }
//
// Within one ceres::Solve() this works for surrogates whose loss falls as the
// schedule moves on, GemanMcClure and Welsch: Ceres compares the cost of a step
// with that of the last one, seen with the last mu. TruncatedLeastSquares
// rises, every step would look worse and be refused: it needs a Solve() for
// each mu.

#ifndef QUATRO_ROBUST_GNC_GNC_LOSS_H_
#define QUATRO_ROBUST_GNC_GNC_LOSS_H_

#include <ceres/loss_function.h>

#include "robust/gnc/surrogate.h"

namespace quatro {

// A surrogate as Ceres wants a loss, at a mu that others move.
template <typename Surrogate>
class GncLoss final : public ceres::LossFunction {
 public:
  // bound > 0. `mu` must outlive this and be > 0.
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
