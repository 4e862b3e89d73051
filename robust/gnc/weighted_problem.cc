// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/gnc/weighted_problem.h"

#include <algorithm>
#include <limits>
#include <memory>

namespace quatro {
namespace {

// w rho(s), with w read through a pointer; rho(s) = s without a loss.
class WeightedLoss final : public ceres::LossFunction {
 public:
  WeightedLoss(const double* weight, const ceres::LossFunction* loss)
      : weight_(weight), loss_(loss) {}

  void Evaluate(double s, double* rho) const override {
    rho[0] = s;
    rho[1] = 1.0;
    rho[2] = 0.0;
    if (loss_ != nullptr) loss_->Evaluate(s, rho);
    for (int i = 0; i < 3; ++i) rho[i] *= *weight_;
  }

 private:
  const double* weight_;
  const ceres::LossFunction* loss_;
};

ceres::Problem::Options SharedOptions(ceres::EvaluationCallback* callback) {
  ceres::Problem::Options options;
  options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.evaluation_callback = callback;
  options.enable_fast_removal = true;
  return options;
}

// Ceres returns pointers to const and takes pointers to non-const objects, but
// does not modify them.
template <typename T>
T* Shared(const T* object) {
  return const_cast<T*>(object);
}

void CopyParameterBlock(const ceres::Problem& from,
                        double* values,
                        ceres::Problem* to) {
  const int size = from.ParameterBlockSize(values);
  to->AddParameterBlock(values, size);
  if (from.HasManifold(values)) {
    to->SetManifold(values, Shared(from.GetManifold(values)));
  }
  constexpr double kUnbounded = std::numeric_limits<double>::max();
  for (int i = 0; i < size; ++i) {
    const double lower = from.GetParameterLowerBound(values, i);
    const double upper = from.GetParameterUpperBound(values, i);
    if (lower > -kUnbounded) to->SetParameterLowerBound(values, i, lower);
    if (upper < kUnbounded) to->SetParameterUpperBound(values, i, upper);
  }
  if (from.IsParameterBlockConstant(values)) {
    to->SetParameterBlockConstant(values);
  }
}

// A copy with its own orderings, since Solve() removes constant blocks from the
// orderings it gets.
ceres::Solver::Options WithOwnOrderings(ceres::Solver::Options options) {
  for (auto* ordering :
       {&options.linear_solver_ordering, &options.inner_iteration_ordering}) {
    if (*ordering == nullptr) continue;
    *ordering = std::make_shared<ceres::ParameterBlockOrdering>(**ordering);
  }
  return options;
}

}  // namespace

WeightedProblem::WeightedProblem(
    const ceres::Problem& problem,
    const std::vector<ceres::ResidualBlockId>& weighted,
    const std::unordered_set<ceres::ResidualBlockId>& left_out,
    ceres::EvaluationCallback* evaluation_callback)
    : weights_(Weights::Ones(static_cast<Eigen::Index>(weighted.size()))),
      evaluation_callback_(evaluation_callback),
      problem_(SharedOptions(evaluation_callback)) {
  problem.GetParameterBlocks(&parameters_);
  for (double* values : parameters_) {
    CopyParameterBlock(problem, values, &problem_);
    initial_values_.insert(initial_values_.end(),
                           values,
                           values + problem.ParameterBlockSize(values));
  }

  std::unordered_map<ceres::ResidualBlockId, Eigen::Index> columns;
  for (const ceres::ResidualBlockId id : weighted) {
    Weighted block;
    block.cost = problem.GetCostFunctionForResidualBlock(id);
    block.loss = problem.GetLossFunctionForResidualBlock(id);
    problem.GetParameterBlocksForResidualBlock(id, &block.parameters);
    columns.emplace(id, static_cast<Eigen::Index>(weighted_.size()));
    weighted_.push_back(std::move(block));
  }

  std::vector<ceres::ResidualBlockId> ids;
  problem.GetResidualBlocks(&ids);
  std::vector<double*> parameters;
  for (const ceres::ResidualBlockId id : ids) {
    if (left_out.contains(id)) continue;
    if (const auto column = columns.find(id); column != columns.end()) {
      Weighted& block = weighted_[static_cast<std::size_t>(column->second)];
      block.caller = id;
      block.weighted_loss =
          std::make_unique<WeightedLoss>(&weights_[column->second], block.loss);
      SetPresent(block, true);
      continue;
    }
    ++num_others_;
    problem.GetParameterBlocksForResidualBlock(id, &parameters);
    ours_[id] = problem_.AddResidualBlock(
        Shared(problem.GetCostFunctionForResidualBlock(id)),
        Shared(problem.GetLossFunctionForResidualBlock(id)),
        parameters);
  }
}

void WeightedProblem::SetPresent(const Weighted& block, bool is_present) {
  const auto our = ours_.find(block.caller);
  if ((our != ours_.end()) == is_present) return;
  if (is_present) {
    ours_[block.caller] = problem_.AddResidualBlock(
        Shared(block.cost), block.weighted_loss.get(), block.parameters);
  } else {
    problem_.RemoveResidualBlock(our->second);
    ours_.erase(our);
  }
}

ceres::Solver::Summary WeightedProblem::Solve(
    const WeightsRef& weights, const ceres::Solver::Options& options) {
  weights_ = weights;
  // A block of weight zero would still fill the factor of the normal equations.
  for (Eigen::Index i = 0; i < num_weighted(); ++i) {
    SetPresent(weighted_[static_cast<std::size_t>(i)], weights_[i] > 0.0);
  }
  ceres::Solver::Options own = WithOwnOrderings(options);
  own.residual_blocks_for_subset_preconditioner.clear();
  for (const auto id : options.residual_blocks_for_subset_preconditioner) {
    if (const auto our = ours_.find(id); our != ours_.end()) {
      own.residual_blocks_for_subset_preconditioner.insert(our->second);
    }
  }
  ceres::Solver::Summary summary;
  ceres::Solve(own, &problem_, &summary);
  return summary;
}

std::optional<Eigen::VectorXd> WeightedProblem::Costs() const {
  if (evaluation_callback_ != nullptr) {
    evaluation_callback_->PrepareForEvaluation(false, true);
  }
  Eigen::VectorXd costs(num_weighted());
  Eigen::VectorXd residuals;
  for (Eigen::Index i = 0; i < num_weighted(); ++i) {
    const Weighted& block = weighted_[static_cast<std::size_t>(i)];
    residuals.resize(block.cost->num_residuals());
    if (!block.cost->Evaluate(
            block.parameters.data(), residuals.data(), nullptr)) {
      return std::nullopt;
    }
    double rho[3] = {residuals.squaredNorm(), 1.0, 0.0};
    if (block.loss != nullptr) block.loss->Evaluate(rho[0], rho);
    costs[i] = rho[0];
  }
  if (!costs.allFinite()) return std::nullopt;
  return costs;
}

void WeightedProblem::RestoreInitialValues() {
  auto from = initial_values_.cbegin();
  for (double* values : parameters_) {
    const int size = problem_.ParameterBlockSize(values);
    std::copy_n(from, size, values);
    from += size;
  }
}

}  // namespace quatro
