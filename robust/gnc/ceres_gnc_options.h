// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The options of SolveCeresGnc() (robust/gnc/ceres_gnc.h), and the role of each
// residual block.

#ifndef QUATRO_ROBUST_GNC_CERES_GNC_OPTIONS_H_
#define QUATRO_ROBUST_GNC_CERES_GNC_OPTIONS_H_

#include <ceres/ceres.h>

#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "robust/gnc/gnc.h"
#include "robust/gnc/surrogate.h"

namespace quatro {

// Loss, loop, inner solver, and role and bound of each block.
struct CeresGncOptions {
  SurrogateType surrogate = SurrogateType::kTruncatedLeastSquares;

  // With GncStart::kIdentity the initial mu comes from the residuals at the
  // initial parameter values, before the plain fit.
  GncOptions gnc;

  // Options of each inner solve. Callbacks are called in each, and a time limit
  // applies to each separately.
  ceres::Solver::Options solver;

  // Cheaper options, if set: of the plain fit, and of the inner solves that
  // follow. With `loose`, one more solve with `solver` and the last weights
  // ends the loop.
  std::optional<ceres::Solver::Options> plain_fit;
  std::optional<ceres::Solver::Options> loose;

  // Blocks that may be outliers. If not set: all blocks that are in neither
  // list below.
  std::optional<std::vector<ceres::ResidualBlockId>> candidates;
  std::vector<ceres::ResidualBlockId> known_inliers;
  std::vector<ceres::ResidualBlockId> known_outliers;

  // The bound c_i on the norm |r_i|: the block's entry in `bounds`, else
  // `bound`, else the chi-square bound of inlier_probability.
  std::unordered_map<ceres::ResidualBlockId, double> bounds;
  std::optional<double> bound;
  double inlier_probability = 0.99;

  // The evaluation callback of the problem, if it has one: Ceres has no
  // accessor for it.
  ceres::EvaluationCallback* evaluation_callback = nullptr;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// The role of a residual block. Only candidates are weighted.
enum class GncRole { kCandidate, kKnownInlier, kKnownOutlier };

// Role and final weight of a residual block.
struct GncBlock {
  GncRole role = GncRole::kKnownInlier;
  double weight = 1.0;            // In the last inner solve.
  double bound = 0.0;             // c_i; candidates only.
  double squared_residual = 0.0;  // rho_i / c_i^2; candidates only.
};

}  // namespace quatro

#endif  // QUATRO_ROBUST_GNC_CERES_GNC_OPTIONS_H_
