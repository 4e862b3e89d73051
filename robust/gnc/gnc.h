// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Graduated non-convexity (GNC): a robust fit as a sequence of weighted
// least-squares fits.
//
// The loop is independent of what is estimated and how. A Subproblem defines
// both:
//
//   struct Subproblem {
//     using Estimate = ...;
//     Eigen::Index NumMeasurements() const;
//     // Weighted least squares; nullopt if the weights leave it undetermined.
//     std::optional<Estimate> Solve(const WeightsRef& weights) const;
//     // ||residual_i||^2 over the squared noise bound: inlier iff <= 1.
//     Eigen::VectorXd SquaredResiduals(const Estimate& estimate) const;
//     // The estimate before any data; needed only for GncStart::kIdentity.
//     Estimate Identity() const;
//     // Optional: the cost that Solve() minimizes, if not sum_i w_i r2_i.
//     double Cost(const Estimate& estimate) const;
//     // Optional: whether the estimate is known even if every measurement is
//     // rejected. If absent, false.
//     bool HasOthers() const;
//   };
//
// A Surrogate (robust/gnc/surrogate.h) defines the loss and its schedule. The
// smallest Subproblem is robust/gnc/quasi_so3.h; robust/gnc/ceres_gnc.h makes
// one from any ceres::Problem.
//
// Start and end. The initial mu of truncated least squares is the inverse of
// the largest squared residual, so outliers far above the bound (by a factor of
// 1e6 or more) make every first weight tiny but positive. Such weights are not
// binary: the loop has not begun to decide. It stops only if some weight
// exceeds the tolerance or if all of them are exactly zero. A solution with no
// measurement within its bound is not usable, unless the Subproblem has others.

#ifndef QUATRO_ROBUST_GNC_GNC_H_
#define QUATRO_ROBUST_GNC_GNC_H_

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "features/base/types.h"
#include "robust/gnc/surrogate.h"

namespace quatro {

// When the loop starts, how it updates mu, and when it stops.
struct GncOptions {
  int max_num_iterations = 100;

  GncStart start = GncStart::kPlainFit;

  // mu changes by this factor per iteration. Larger values are faster and
  // greedier.
  double mu_step = 1.4;

  // Stop once every weight is this close to 0 or 1 and at least one is larger
  // than this, or all are exactly 0.
  double binary_weight_tolerance = 1e-6;

  // Stop once |change in weighted cost| <= this * cost.
  double relative_cost_tolerance = 1e-9;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// Why the loop ended.
enum class GncTermination {
  kInvalidOptions,    // GNC was not run; see the message.
  kUndetermined,      // The subproblem had no solution for some weights.
  kAllInliers,        // No initial residual exceeds the noise bound.
  kConverged,         // Weights binary, cost converged, or loss exact.
  kMaxNumIterations,  // Usable, but mu was still changing.
};

// The termination in words, for example "12 iterations, then the weights were
// binary or the cost converged".
std::string DescribeGnc(GncTermination termination, std::size_t num_iterations);

// One step of the loop.
struct GncIteration {
  double mu = 0.0;
  double cost = 0.0;  // sum_i w_i r2_i, or the Subproblem's own.
  double sum_of_weights = 0.0;
};

// The estimate, its weights, and the iterations.
template <typename Estimate>
struct GncSummary {
  GncTermination termination = GncTermination::kUndetermined;
  std::string message;                // Which criterion or error ended it.
  std::optional<Estimate> estimate;   // Set iff IsUsable().
  Weights weights;                    // The weights of the last fit.
  Eigen::VectorXd squared_residuals;  // At the estimate; inlier iff <= 1.
  std::vector<GncIteration> iterations;

  bool IsUsable() const { return estimate.has_value(); }
};

// The subproblem's own cost, or sum_i w_i r2_i.
template <typename Subproblem>
double GncCost(const Subproblem& subproblem,
               const typename Subproblem::Estimate& estimate,
               const Weights& weights,
               const Eigen::VectorXd& r2) {
  if constexpr (requires { subproblem.Cost(estimate); }) {
    return subproblem.Cost(estimate);
  } else {
    return weights.dot(r2);
  }
}

// Whether the estimate is known even if every measurement is rejected.
template <typename Subproblem>
bool GncHasOthers(const Subproblem& subproblem) {
  if constexpr (requires { subproblem.HasOthers(); }) {
    return subproblem.HasOthers();
  } else {
    return false;
  }
}

// The loop: weights for a fixed estimate, the estimate for fixed weights.
template <typename Surrogate, typename Subproblem>
GncSummary<typename Subproblem::Estimate> SolveGnc(const Subproblem& subproblem,
                                                   const GncOptions& options) {
  GncSummary<typename Subproblem::Estimate> summary;
  if (!options.IsValid(&summary.message)) {
    summary.termination = GncTermination::kInvalidOptions;
    return summary;
  }

  summary.weights.setOnes(subproblem.NumMeasurements());
  summary.estimate = subproblem.Solve(summary.weights);
  if (!summary.IsUsable()) {
    summary.message = "the measurements do not determine the estimate";
    return summary;
  }
  Eigen::VectorXd& r2 = summary.squared_residuals;
  r2 = subproblem.SquaredResiduals(*summary.estimate);

  // Without measurements there is nothing to weight, and the plain fit is the
  // answer.
  const double max_r2 =
      r2.size() == 0 ? 0.0
      : options.start == GncStart::kPlainFit
          ? r2.maxCoeff()
          : subproblem.SquaredResiduals(subproblem.Identity()).maxCoeff();
  if (max_r2 <= 1.0) {
    summary.termination = GncTermination::kAllInliers;
    summary.message = "no initial residual exceeds its bound";
    return summary;
  }

  summary.termination = GncTermination::kMaxNumIterations;
  summary.message = "max_num_iterations was reached";
  double mu = Surrogate::InitialMu(max_r2, options.start);
  double previous_cost = std::numeric_limits<double>::infinity();
  for (int i = 0; i < options.max_num_iterations; ++i) {
    // Weights for a fixed estimate, then the estimate for fixed weights.
    summary.weights =
        r2.unaryExpr([mu](double r2_i) { return Surrogate::Weight(r2_i, mu); });
    summary.estimate = subproblem.Solve(summary.weights);
    if (!summary.IsUsable()) {
      summary.termination = GncTermination::kUndetermined;
      summary.message = "all measurements were rejected";
      return summary;
    }
    r2 = subproblem.SquaredResiduals(*summary.estimate);

    const double cost =
        GncCost(subproblem, *summary.estimate, summary.weights, r2);
    summary.iterations.push_back({mu, cost, summary.weights.sum()});

    const double gap_to_binary =
        summary.weights.array().min(1.0 - summary.weights.array()).maxCoeff();
    const double cost_change = std::abs(previous_cost - cost);
    const double max_weight = summary.weights.maxCoeff();
    const bool has_begun =
        max_weight > options.binary_weight_tolerance || max_weight == 0.0;
    const char* const stop =
        Surrogate::IsExact(mu) ? "the loss was exact"
        : !has_begun           ? nullptr
        : gap_to_binary <= options.binary_weight_tolerance
            ? "the weights were binary"
        : cost_change <= options.relative_cost_tolerance * cost
            ? "the cost converged"
            : nullptr;
    if (stop != nullptr) {
      summary.termination = GncTermination::kConverged;
      summary.message = stop;
      break;
    }
    previous_cost = cost;
    mu = Surrogate::NextMu(mu, options.mu_step);
  }
  if (r2.minCoeff() > 1.0) {
    summary.message += ", but no measurement is within its bound";
    if (summary.termination == GncTermination::kConverged &&
        !GncHasOthers(subproblem)) {
      summary.termination = GncTermination::kUndetermined;
      summary.estimate.reset();
    }
  }
  return summary;
}

// Runs the loop with the surrogate that `surrogate` names.
template <typename Subproblem>
GncSummary<typename Subproblem::Estimate> SolveGnc(SurrogateType surrogate,
                                                   const Subproblem& subproblem,
                                                   const GncOptions& options) {
  switch (surrogate) {
    case SurrogateType::kGemanMcClure:
      return SolveGnc<GemanMcClure>(subproblem, options);
    case SurrogateType::kWelsch:
      return SolveGnc<Welsch>(subproblem, options);
    case SurrogateType::kTruncatedLeastSquares:
      break;
  }
  return SolveGnc<TruncatedLeastSquares>(subproblem, options);
}

}  // namespace quatro

#endif  // QUATRO_ROBUST_GNC_GNC_H_
