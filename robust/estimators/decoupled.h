// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The stages that Quatro and TEASER++ share. Both decouple the pose in
//
//   q_i = R p_i + t + noise.
//
// They prune the matches to a consistent set, estimate R from the TIMs of that
// set by GNC, and then t with R known.

#ifndef QUATRO_ROBUST_ESTIMATORS_DECOUPLED_H_
#define QUATRO_ROBUST_ESTIMATORS_DECOUPLED_H_

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "features/base/rigid3.h"
#include "features/base/types.h"
#include "robust/estimators/crosscheck.h"
#include "robust/estimators/distinct_matches.h"
#include "robust/estimators/pose_summary.h"
#include "robust/estimators/pruning.h"
#include "robust/estimators/tims.h"
#include "robust/gnc/gnc.h"

namespace quatro {

// The consistent matches, and the pairs among them whose differences are the
// TIMs.
struct ConsistentSet {
  std::vector<Eigen::Index> columns;  // Distinct matches, ascending.
  Points source;
  Points target;
  std::vector<TimPair> tims;
};

// Prunes the matches. Sets the consistent matches of the summary and their
// number.
ConsistentSet PruneMatches(const DistinctMatches& matches,
                           const PruningOptions& options,
                           int num_threads,
                           PoseSummary* summary);

// Chooses the pairs of `set` for the TIMs. Sets the number of TIMs of the
// summary.
void ChooseTims(TimLayout layout,
                Eigen::Index num_random,
                std::uint64_t seed,
                ConsistentSet* set,
                PoseSummary* summary);

// Ends the estimation with kInsufficient. `needs` says what is needed, for
// example "a heading needs two consistent matches".
void EndInsufficient(const std::string& needs, PoseSummary* summary);

// Solves the rotation by GNC with this surrogate. If `crosscheck` is set, every
// step is compared with Ceres.
template <typename Subproblem>
GncSummary<typename Subproblem::Estimate> SolveRotation(
    const Subproblem& subproblem,
    SurrogateType surrogate,
    const GncOptions& options,
    bool crosscheck,
    PoseSummary* summary) {
  if (!crosscheck) return SolveGnc(surrogate, subproblem, options);
  const CrossChecked<Subproblem> checked(subproblem);
  const auto gnc = SolveGnc(surrogate, checked, options);
  summary->crosscheck = checked.report();
  return gnc;
}

// Sets the weight of each consistent match from the weights of its TIMs. Sets
// nothing if there are no weights.
void WeighMatches(const DistinctMatches& matches,
                  const ConsistentSet& set,
                  const Eigen::VectorXd& tim_weights,
                  PoseSummary* summary);

// Returns the pose with this rotation, and the columns of the distinct matches
// that are inliers of its translation in *inliers. The set must not be empty.
Rigid3 AddTranslation(const ConsistentSet& set,
                      const Eigen::Matrix3d& rotation,
                      double noise_bound,
                      std::vector<Eigen::Index>* inliers);

// Ends the estimation with kSolved.
void EndSolved(const DistinctMatches& matches,
               const Rigid3& pose,
               const std::vector<Eigen::Index>& inliers,
               bool crosscheck,
               PoseSummary* summary);

}  // namespace quatro

#endif  // QUATRO_ROBUST_ESTIMATORS_DECOUPLED_H_
