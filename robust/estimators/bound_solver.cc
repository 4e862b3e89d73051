// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/estimators/bound_solver.h"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "robust/estimators/distinct_matches.h"

namespace quatro {
namespace {

// The number of poses outside the bounds that are set aside before the search
// ends.
constexpr int kMaxNumOutside = 8;

void MapColumns(const std::vector<Eigen::Index>& columns,
                std::vector<Eigen::Index>* selected) {
  for (Eigen::Index& i : *selected) i = columns[static_cast<std::size_t>(i)];
}

// Runs `solver` on some of the matches.
class ColumnSolver {
 public:
  ColumnSolver(const PoseSolver& solver,
               const PointsRef& source,
               const PointsRef& target)
      : solver_(solver), source_(source), target_(target) {}

  // Columns in the summary refer to all matches.
  PoseSummary operator()(const std::vector<Eigen::Index>& columns) const {
    PoseSummary summary =
        solver_(Columns(source_, columns), Columns(target_, columns));
    MapColumns(columns, &summary.consistent);
    MapColumns(columns, &summary.translation_inliers);
    return summary;
  }

  // The given columns whose residual under the pose is at most the distance,
  // or, if `are_near` is false, above it.
  std::vector<Eigen::Index> Near(const Rigid3& pose,
                                 double distance,
                                 const std::vector<Eigen::Index>& columns,
                                 bool are_near) const {
    std::vector<Eigen::Index> found;
    for (const Eigen::Index i : columns) {
      const Eigen::Vector3d p = source_.col(i), q = target_.col(i);
      if (((pose * p - q).norm() <= distance) == are_near) found.push_back(i);
    }
    return found;
  }

 private:
  const PoseSolver& solver_;
  const PointsRef& source_;
  const PointsRef& target_;
};

// A pose within the bounds, if the pose of a larger consensus is outside.
// Returns `outside` without its pose if none is found.
PoseSummary SolveWithin(const ColumnSolver& solve,
                        const PoseBounds& bounds,
                        double noise_bound,
                        const std::vector<Eigen::Index>& possible,
                        PoseSummary outside) {
  const double inlier_distance = std::sqrt(3.0) * noise_bound;
  std::vector<Eigen::Index> left = possible;
  Rigid3 pose = *outside.target_from_source;
  for (int k = 1; k <= kMaxNumOutside; ++k) {
    const std::size_t num_before = left.size();
    left = solve.Near(pose, inlier_distance, left, /*are_near=*/false);
    if (left.size() == num_before) break;
    PoseSummary summary = solve(left);
    if (!summary.IsUsable()) break;
    pose = *summary.target_from_source;
    if (!bounds.Contain(pose, noise_bound)) continue;
    // The poses set aside may have taken some inliers of this pose with them.
    PoseSummary again =
        solve(solve.Near(pose, 2.0 * inlier_distance, possible, true));
    if (again.IsUsable() &&
        bounds.Contain(*again.target_from_source, noise_bound) &&
        again.num_translation_inliers >= summary.num_translation_inliers) {
      summary = std::move(again);
    }
    summary.num_matches = outside.num_matches;
    summary.notes.push_back(
        {"bounds",
         "a pose outside of the bounds has more inliers, " +
             std::to_string(outside.num_translation_inliers) +
             "; widen the bounds unless they are certain"});
    return summary;
  }
  RefuseOutside(bounds, noise_bound, &outside);
  return outside;
}

}  // namespace

void RefuseOutside(const PoseBounds& bounds,
                   double noise_bound,
                   PoseSummary* summary) {
  if (!summary->IsUsable() ||
      bounds.Contain(*summary->target_from_source, noise_bound)) {
    return;
  }
  summary->message = "the best pose is outside of the bounds: it is " +
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
    // The solver reports this error.
    if (source.cols() != target.cols()) return solver(source, target);
    const std::vector<Eigen::Index> columns =
        bounds.PossibleInliers(source, target, noise_bound);
    const ColumnSolver solve(solver, source, target);
    summary = solve(columns);
    if (summary.IsUsable() &&
        !bounds.Contain(*summary.target_from_source, noise_bound)) {
      return SolveWithin(
          solve, bounds, noise_bound, columns, std::move(summary));
    }
    if (!summary.IsUsable() &&
        summary.termination != PoseTermination::kInvalidInput) {
      summary.message += "; the bounds leave " +
                         std::to_string(columns.size()) + " of " +
                         std::to_string(source.cols()) +
                         " matches: widen them or give another guess";
    }
    return summary;
  };
}

}  // namespace quatro
