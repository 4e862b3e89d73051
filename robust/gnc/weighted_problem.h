// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A copy of a caller's ceres::Problem whose residual blocks have variable
// weights,
//
//   min_x  1/2 sum_{i weighted} w_i rho_i(|r_i(x)|^2)
//        + 1/2 sum_{k others} rho_k(|r_k(x)|^2).                            (1)
//
// Ceres cannot replace the loss of a block that is in a Problem. This is
// therefore a second Problem over the same cost functions, losses, manifolds
// and parameter memory. It owns none of them and leaves the caller's Problem
// unchanged. Parameter and residual blocks keep their order, so with all
// w_i = 1 the solver takes the same steps bit for bit.

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

// A Ceres problem with weights on some of its blocks.
class WeightedProblem {
 public:
  // Blocks in `left_out` are not part of (1); parameters that only they use
  // keep their values. `problem` must outlive this object and not change.
  WeightedProblem(const ceres::Problem& problem,
                  const std::vector<ceres::ResidualBlockId>& weighted,
                  const std::unordered_set<ceres::ResidualBlockId>& left_out,
                  ceres::EvaluationCallback* evaluation_callback);

  // The number of weighted blocks.
  Eigen::Index num_weighted() const { return weights_.size(); }

  // Whether (1) has blocks without a weight.
  bool HasOthers() const { return num_others_ > 0; }

  // Minimizes (1) from the current parameter values and writes the solution
  // there, unless Ceres fails.
  ceres::Solver::Summary Solve(const WeightsRef& weights,
                               const ceres::Solver::Options& options);

  // rho_i(|r_i|^2) at the current values, in the order of `weighted`. Returns
  // nullopt if a residual cannot be evaluated or is not finite.
  std::optional<Eigen::VectorXd> Costs() const;

  // Restores the parameter values at construction.
  void RestoreInitialValues();

 private:
  struct Weighted {
    const ceres::CostFunction* cost;
    const ceres::LossFunction* loss;  // May be null.
    std::vector<double*> parameters;
    ceres::ResidualBlockId caller;
    std::unique_ptr<ceres::LossFunction> weighted_loss;
  };

  // Adds the block to problem_, or removes it, unless that is its state.
  void SetPresent(const Weighted& block, bool is_present);

  Weights weights_;
  std::vector<Weighted> weighted_;
  // The blocks of problem_, by those of the caller.
  std::unordered_map<ceres::ResidualBlockId, ceres::ResidualBlockId> ours_;
  std::vector<double*> parameters_;
  std::vector<double> initial_values_;
  ceres::EvaluationCallback* evaluation_callback_;
  Eigen::Index num_others_ = 0;
  ceres::Problem problem_;
};

}  // namespace quatro

#endif  // QUATRO_ROBUST_GNC_WEIGHTED_PROBLEM_H_
