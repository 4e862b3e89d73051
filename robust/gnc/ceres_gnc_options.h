// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The options of SolveCeresGnc() (robust/gnc/ceres_gnc.h), and the part that
// each residual block plays.

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

// The loss, the loop, and the bound of each block.
struct CeresGncOptions {
  SurrogateType surrogate = SurrogateType::kTruncatedLeastSquares;

  // With GncStart::kIdentity mu starts from the residuals at the values given,
  // before the plain fit.
  GncOptions gnc;

  // Of each inner solve. Callbacks are called in each; a time limit is each
  // one's own.
  ceres::Solver::Options solver;

  // Blocks that may be outliers. Nullopt: all that are not known.
  std::optional<std::vector<ceres::ResidualBlockId>> candidates;
  std::vector<ceres::ResidualBlockId> known_inliers;
  std::vector<ceres::ResidualBlockId> known_outliers;

  // c_i: of the block if it has one here, else `bound`, else by chi-square.
  std::unordered_map<ceres::ResidualBlockId, double> bounds;
  std::optional<double> bound;
  double inlier_probability = 0.99;

  // That of the problem, if it was made with one: Ceres does not tell.
  ceres::EvaluationCallback* evaluation_callback = nullptr;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// Only candidates are weighted.
enum class GncRole { kCandidate, kKnownInlier, kKnownOutlier };

// What became of a residual block.
struct GncBlock {
  GncRole role = GncRole::kKnownInlier;
  double weight = 1.0;            // That the answer was solved with.
  double bound = 0.0;             // c_i, of candidates.
  double squared_residual = 0.0;  // rho_i / c_i^2, of candidates.
};

}  // namespace quatro

#endif  // QUATRO_ROBUST_GNC_CERES_GNC_OPTIONS_H_
