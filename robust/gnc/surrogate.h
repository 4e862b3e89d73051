// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The robust losses of GNC, as stateless types.
//
// Each is a family of losses rho_mu(r2) with its dual outlier process
// Phi_mu(w),
//
//   rho_mu(r2) = min_{0 <= w <= 1}  w r2 + Phi_mu(w),                      (1)
//
// with the minimum at w = Weight(r2, mu) (Black and Rangarajan, IJCV 1996).
// Hence Weight is the first derivative of Loss with respect to r2, and
// WeightSlope the second.
//
// Residuals are divided by the noise bound beforehand, so an inlier has r2 <= 1
// and no loss has a threshold of its own. Equation numbers are those of Yang,
// Antonante, Tzoumas and Carlone, "Graduated Non-Convexity for Robust Spatial
// Perception", RA-L 2020, unless another paper is named.

#ifndef QUATRO_ROBUST_GNC_SURROGATE_H_
#define QUATRO_ROBUST_GNC_SURROGATE_H_

#include <algorithm>
#include <cmath>

namespace quatro {

// Which residuals set the initial mu, and so how convex the first surrogate is.
enum class GncStart {
  kPlainFit,  // The residuals of the plain fit, as in the GNC paper.
  kIdentity,  // The residuals before any fit, as in the Quatro paper.
};

// Names of the types below.
enum class SurrogateType { kTruncatedLeastSquares, kGemanMcClure, kWelsch };

// Truncated least squares, min(r2, 1). Convex as mu -> 0, exact as mu -> inf.
struct TruncatedLeastSquares {
  // Remark 5, and Section III.C of the Quatro paper. Needs max_r2 > 1.
  static double InitialMu(double max_r2, GncStart start) {
    const double factor = start == GncStart::kPlainFit ? 2.0 : 1.0;
    return 1.0 / (factor * max_r2 - 1.0);
  }
  static double NextMu(double mu, double step) { return mu * step; }
  static bool IsExact(double) { return false; }

  // Equation (14).
  static double Weight(double r2, double mu) {
    if (r2 >= (mu + 1.0) / mu) return 0.0;
    if (r2 <= mu / (mu + 1.0)) return 1.0;
    return std::sqrt(mu * (mu + 1.0) / r2) - mu;
  }
  static double WeightSlope(double r2, double mu) {
    if (r2 >= (mu + 1.0) / mu || r2 <= mu / (mu + 1.0)) return 0.0;
    return -0.5 * std::sqrt(mu * (mu + 1.0) / r2) / r2;
  }
  // Equation (5) of the Quatro paper.
  static double OutlierProcess(double w, double mu) {
    return mu * (1.0 - w) / (mu + w);
  }
  static double Loss(double r2, double mu) {
    if (r2 >= (mu + 1.0) / mu) return 1.0;
    if (r2 <= mu / (mu + 1.0)) return r2;
    return 2.0 * std::sqrt(r2 * mu * (mu + 1.0)) - mu * (1.0 + r2);
  }
};

// Geman-McClure, r2 / (1 + r2). Convex as mu -> inf, exact at mu = 1.
struct GemanMcClure {
  static double InitialMu(double max_r2, GncStart) {
    return std::max(1.0, 2.0 * max_r2);
  }
  static double NextMu(double mu, double step) {
    return std::max(1.0, mu / step);
  }
  static bool IsExact(double mu) { return mu <= 1.0; }

  // Equation (12).
  static double Weight(double r2, double mu) {
    const double w = mu / (r2 + mu);
    return w * w;
  }
  static double WeightSlope(double r2, double mu) {
    return -2.0 * Weight(r2, mu) / (r2 + mu);
  }
  static double OutlierProcess(double w, double mu) {
    const double root = std::sqrt(w) - 1.0;
    return mu * root * root;
  }
  static double Loss(double r2, double mu) { return mu * r2 / (mu + r2); }
};

// Welsch (or Leclerc), 1 - exp(-r2). Convex as mu -> inf, exact at mu = 1.
struct Welsch {
  static double InitialMu(double max_r2, GncStart) {
    return std::max(1.0, 2.0 * max_r2);
  }
  static double NextMu(double mu, double step) {
    return std::max(1.0, mu / step);
  }
  static bool IsExact(double mu) { return mu <= 1.0; }

  static double Weight(double r2, double mu) { return std::exp(-r2 / mu); }
  static double WeightSlope(double r2, double mu) {
    return -Weight(r2, mu) / mu;
  }
  static double OutlierProcess(double w, double mu) {
    return w > 0.0 ? mu * (1.0 - w + w * std::log(w)) : mu;
  }
  static double Loss(double r2, double mu) {
    return -mu * std::expm1(-r2 / mu);
  }
};

}  // namespace quatro

#endif  // QUATRO_ROBUST_GNC_SURROGATE_H_
