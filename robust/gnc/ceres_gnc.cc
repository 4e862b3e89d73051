// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/gnc/ceres_gnc.h"

#include <glog/logging.h>

#include <cmath>
#include <iomanip>
#include <sstream>
#include <unordered_set>
#include <utility>

#include "features/base/stopwatch.h"
#include "robust/gnc/gnc_roles.h"
#include "robust/gnc/weighted_problem.h"

namespace quatro {
namespace {

using Id = ceres::ResidualBlockId;

std::string FirstLine(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

// The problem as a subproblem of robust/gnc/gnc.h. x stays in the caller's
// memory, so an Estimate holds only its cost and residuals.
class CeresSubproblem {
 public:
  struct Estimate {
    double cost = 0.0;
    Eigen::VectorXd squared_residuals;
  };

  CeresSubproblem(WeightedProblem* problem,
                  Eigen::VectorXd squared_bounds,
                  const CeresGncOptions& options,
                  CeresGncSummary* summary)
      : problem_(*problem),
        squared_bounds_(std::move(squared_bounds)),
        options_(options),
        summary_(*summary) {
    if (options.gnc.start == GncStart::kIdentity) initial_ = Evaluate(0.0);
  }

  // Why Solve() returned nullopt.
  const std::string& error() const { return error_; }

  Eigen::Index NumMeasurements() const { return squared_bounds_.size(); }
  bool HasOthers() const { return problem_.HasOthers(); }
  Estimate Identity() const { return *initial_; }
  double Cost(const Estimate& estimate) const { return estimate.cost; }
  Eigen::VectorXd SquaredResiduals(const Estimate& estimate) const {
    return estimate.squared_residuals;
  }

  std::optional<Estimate> Solve(const WeightsRef& weights) const {
    if (options_.gnc.start == GncStart::kIdentity && !initial_) {
      return std::nullopt;
    }
    if (!problem_.HasOthers() && !(weights.sum() > 0.0)) {
      error_ = weights.size() == 0 ? "there is no residual block to fit"
                                   : "all candidates were rejected";
      return std::nullopt;
    }
    const auto& cheap =
        summary_.inner.empty() ? options_.plain_fit : options_.loose;
    return Solve(weights, cheap ? *cheap : options_.solver);
  }

  std::optional<Estimate> Solve(const WeightsRef& weights,
                                const ceres::Solver::Options& solver) const {
    summary_.inner.push_back(problem_.Solve(weights, solver));
    const ceres::Solver::Summary& inner = summary_.inner.back();
    summary_.solver_seconds += inner.total_time_in_seconds;
    if (!inner.IsSolutionUsable()) {
      error_ = "inner solve " + std::to_string(summary_.inner.size() - 1) +
               " failed: " + FirstLine(inner.message);
      return std::nullopt;
    }
    return Evaluate(inner.final_cost);
  }

 private:
  std::optional<Estimate> Evaluate(double cost) const {
    auto costs = problem_.Costs();
    if (!costs) {
      error_ = "a candidate's residual could not be evaluated or is not finite";
      return std::nullopt;
    }
    return Estimate{cost, costs->cwiseQuotient(squared_bounds_)};
  }

  WeightedProblem& problem_;
  Eigen::VectorXd squared_bounds_;
  const CeresGncOptions& options_;
  CeresGncSummary& summary_;
  std::optional<Estimate> initial_;
  mutable std::string error_;
};

}  // namespace

CeresGncSummary SolveCeresGnc(ceres::Problem* problem,
                              const CeresGncOptions& options) {
  CHECK(problem != nullptr);
  Stopwatch stopwatch;
  CeresGncSummary summary;
  if (!options.IsValid(&summary.message)) return summary;
  std::vector<Id> ids;
  problem->GetResidualBlocks(&ids);
  auto roles = AssignGncRoles(*problem, options, &summary.message);
  if (!roles) return summary;
  GncBlocks& blocks = *roles;

  std::vector<Id> candidates;
  std::unordered_set<Id> left_out;
  for (const Id id : ids) {
    const GncRole role = blocks[id].role;
    if (role == GncRole::kCandidate) candidates.push_back(id);
    if (role == GncRole::kKnownOutlier) left_out.insert(id);
  }
  Eigen::VectorXd squared_bounds(static_cast<Eigen::Index>(candidates.size()));
  for (Eigen::Index i = 0; i < squared_bounds.size(); ++i) {
    const double bound = blocks[candidates[static_cast<std::size_t>(i)]].bound;
    squared_bounds[i] = bound * bound;
  }

  WeightedProblem weighted(
      *problem, candidates, left_out, options.evaluation_callback);
  const CeresSubproblem subproblem(
      &weighted, std::move(squared_bounds), options, &summary);
  auto gnc = SolveGnc(options.surrogate, subproblem, options.gnc);
  if (gnc.IsUsable() && options.loose) {
    gnc.estimate = subproblem.Solve(gnc.weights, options.solver);
    if (gnc.IsUsable()) {
      gnc.squared_residuals = subproblem.SquaredResiduals(*gnc.estimate);
    } else {
      gnc.termination = GncTermination::kUndetermined;
    }
  }

  summary.termination = gnc.termination;
  summary.message =
      subproblem.error().empty() ? gnc.message : subproblem.error();
  summary.iterations = std::move(gnc.iterations);
  for (const Id id : left_out) blocks[id].weight = 0.0;
  for (Eigen::Index i = 0; i < gnc.weights.size(); ++i) {
    GncBlock& block = blocks[candidates[static_cast<std::size_t>(i)]];
    block.weight = gnc.weights[i];
    if (i < gnc.squared_residuals.size()) {
      block.squared_residual = gnc.squared_residuals[i];
    }
  }
  summary.blocks = std::move(blocks);
  if (!summary.IsUsable()) weighted.RestoreInitialValues();
  summary.total_seconds = stopwatch.Lap();
  return summary;
}

std::string CeresGncSummary::BriefReport() const {
  if (termination == GncTermination::kInvalidOptions) {
    return "GNC was not run: " + message;
  }
  std::size_t num_candidates = 0;
  std::size_t num_kept = 0;
  for (const auto& [id, block] : blocks) {
    if (block.role != GncRole::kCandidate) continue;
    ++num_candidates;
    if (block.squared_residual <= 1.0) ++num_kept;
  }
  std::ostringstream report;
  report << (IsUsable() ? "GNC: " : "GNC failed: ") << message << " after "
         << iterations.size() << " iterations";
  if (!IsUsable()) return report.str() + "; the parameters are unchanged";
  report << ", cost " << inner.front().initial_cost << " -> "
         << inner.back().final_cost << ", " << num_kept << " of "
         << num_candidates << " candidates are within their bounds";
  return report.str();
}

std::string CeresGncSummary::FullReport() const {
  std::ostringstream report;
  report << BriefReport() << "\n";
  if (inner.empty()) return report.str();
  report << total_seconds << " s, of which " << solver_seconds << " s in "
         << inner.size() << " inner solves\n"
         << "plain fit: " << inner.front().BriefReport() << "\n"
         << "    i          mu        cost  sum of weights  inner steps\n";
  for (std::size_t i = 0; i < iterations.size(); ++i) {
    report << std::setw(5) << i << std::setw(12) << iterations[i].mu
           << std::setw(12) << iterations[i].cost << std::setw(16)
           << iterations[i].sum_of_weights << std::setw(13)
           << inner[i + 1].iterations.size() << "\n";
  }
  return report.str();
}

}  // namespace quatro
