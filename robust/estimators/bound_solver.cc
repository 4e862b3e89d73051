// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/estimators/bound_solver.h"

#include <string>
#include <utility>
#include <vector>

#include "robust/estimators/distinct_matches.h"

namespace quatro {
namespace {

void MapColumns(const std::vector<Eigen::Index>& columns,
                std::vector<Eigen::Index>* selected) {
  for (Eigen::Index& i : *selected) i = columns[static_cast<std::size_t>(i)];
}

}  // namespace

void RefuseOutside(const PoseBounds& bounds,
                   double noise_bound,
                   PoseSummary* summary) {
  if (!summary->IsUsable() ||
      bounds.Contain(*summary->target_from_source, noise_bound)) {
    return;
  }
  summary->message = "the best pose lies outside of the bounds given: " +
                     bounds.Describe(*summary->target_from_source) +
                     "; widen the bounds or give another guess";
  summary->termination = PoseTermination::kInsufficient;
  summary->target_from_source.reset();
  summary->unpolished_target_from_source.reset();
}

PoseSolver BoundSolver(PoseSolver solver,
                       const PoseBounds& bounds,
                       double noise_bound) {
  if (!bounds.IsActive()) return solver;
  return [solver = std::move(solver), bounds, noise_bound](
             const PointsRef& source, const PointsRef& target) {
    PoseSummary summary;
    if (!bounds.IsValid(&summary.message)) return summary;
    // For the solver to refuse.
    if (source.cols() != target.cols()) return solver(source, target);
    const std::vector<Eigen::Index> columns =
        bounds.PossibleInliers(source, target, noise_bound);
    summary = solver(Columns(source, columns), Columns(target, columns));
    MapColumns(columns, &summary.consistent);
    MapColumns(columns, &summary.translation_inliers);
    if (summary.IsUsable()) {
      RefuseOutside(bounds, noise_bound, &summary);
    } else if (summary.termination != PoseTermination::kInvalidInput) {
      summary.message +=
          "; within the bounds given, " + std::to_string(columns.size()) +
          " of " + std::to_string(source.cols()) + " matches can be inliers";
    }
    return summary;
  };
}

}  // namespace quatro
