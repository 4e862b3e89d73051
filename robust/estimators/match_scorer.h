// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The truncated cost of many poses over the same matches,
//
//   f(R, t) = sum_i min( |q_i - R p_i - t|^2 / b^2, 1 ),                   (1)
//
// which is robust/estimators/consensus.h's, laid out for speed: several matches
// at a time, and no further than a limit, above which nobody asks how much.

#ifndef QUATRO_ROBUST_ESTIMATORS_MATCH_SCORER_H_
#define QUATRO_ROBUST_ESTIMATORS_MATCH_SCORER_H_

#include <Eigen/Core>
#include <vector>

#include "features/base/rigid3.h"
#include "features/base/types.h"

namespace quatro {

// (1) of these matches, for one pose after another.
class MatchScorer {
 public:
  // `noise_bound` b > 0 [m].
  MatchScorer(const PointsRef& source,
              const PointsRef& target,
              double noise_bound);

  // (1) if it is at most `limit`, else some number above `limit`. A match whose
  // residual is not a number costs 1. The same bits on every machine.
  double Cost(const Rigid3& target_from_source, double limit) const;

  // The columns with |q_i - R p_i - t| <= factor b, in ascending order.
  std::vector<Eigen::Index> Inliers(const Rigid3& target_from_source,
                                    double factor = 1.0) const;

  // All of them.
  Eigen::Index num_matches() const { return num_matches_; }

 private:
  Eigen::Index num_matches_;
  // In units of b. A block holds kLanes numbers of each of p_x, p_y, p_z, q_x,
  // q_y, q_z and of the most that a match may cost: 1, or 0 past the last one.
  std::vector<double> blocks_;
  double noise_bound_;
};

}  // namespace quatro

#endif  // QUATRO_ROBUST_ESTIMATORS_MATCH_SCORER_H_
