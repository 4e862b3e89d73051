// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A caller's ceres::Problem once more, with weights that can be changed,
//
//   min_x  1/2 sum_{i weighted} w_i rho_i(|r_i(x)|^2)
//        + 1/2 sum_{k others} rho_k(|r_k(x)|^2).                            (1)
//
// Ceres can't exchange the loss of a block that is in a Problem. So this is a
// second Problem over the same cost functions, losses, manifolds and parameter
// memory, owning none of them: the caller's stays as it is by construction.
// Parameter and residual blocks keep their order, so that with all w_i = 1 the
// solver takes the same steps bit for bit.

#ifndef QUATRO_ROBUST_GNC_WEIGHTED_PROBLEM_H_
#define QUATRO_ROBUST_GNC_WEIGHTED_PROBLEM_H_

#include <ceres/ceres.h>

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "features/base/types.h"

namespace quatro {

// A Ceres problem in which some blocks have weights.
class WeightedProblem {
 public:
  // Blocks in `left_out` have no part in (1); parameters that no other block
  // has stay as they are. `problem` must outlive this and not change.
  WeightedProblem(const ceres::Problem& problem,
                  const std::vector<ceres::ResidualBlockId>& weighted,
                  const std::unordered_set<ceres::ResidualBlockId>& left_out,
                  ceres::EvaluationCallback* evaluation_callback);

  // Blocks with a weight.
  Eigen::Index num_weighted() const { return weights_.size(); }

  // Whether there are blocks without one.
  bool HasOthers() const { return num_others_ > 0; }

  // Minimises (1) from the current values and leaves the answer there, unless
  // Ceres failed.
  ceres::Solver::Summary Solve(const WeightsRef& weights,
                               const ceres::Solver::Options& options);

  // rho_i(|r_i|^2) at the current values, in the order of `weighted`. Nullopt
  // if one can't be evaluated or is not finite.
  std::optional<Eigen::VectorXd> Costs() const;

  // Puts the values back that the problem came with.
  void RestoreInitialValues();

 private:
  struct Weighted {
    const ceres::CostFunction* cost;
    const ceres::LossFunction* loss;  // May be null.
    std::vector<double*> parameters;
  };

  Weights weights_;
  std::vector<Weighted> weighted_;
  std::vector<std::unique_ptr<ceres::LossFunction>> losses_;
  std::unordered_map<ceres::ResidualBlockId, ceres::ResidualBlockId> ours_;
  std::vector<double*> parameters_;
  std::vector<double> initial_values_;
  ceres::EvaluationCallback* evaluation_callback_;
  Eigen::Index num_others_ = 0;
  ceres::Problem problem_;
};

}  // namespace quatro

#endif  // QUATRO_ROBUST_GNC_WEIGHTED_PROBLEM_H_
