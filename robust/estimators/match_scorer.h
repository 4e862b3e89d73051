// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The truncated cost of many poses over the same matches,
//
//   f(R, t) = sum_i min( |q_i - R p_i - t|^2 / b^2, 1 ),                   (1)
//
// as in robust/estimators/consensus.h, but optimized for speed: several matches
// are evaluated at a time, and the sum stops once it exceeds a given limit. b
// is a radius.

#ifndef QUATRO_ROBUST_ESTIMATORS_MATCH_SCORER_H_
#define QUATRO_ROBUST_ESTIMATORS_MATCH_SCORER_H_

#include <Eigen/Core>
#include <vector>

#include "features/base/rigid3.h"
#include "features/base/types.h"

namespace quatro {

// Evaluates (1) for fixed matches and many poses.
class MatchScorer {
 public:
  // `noise_bound` b > 0, a radius [m].
  MatchScorer(const PointsRef& source,
              const PointsRef& target,
              double noise_bound);

  // Returns (1) if it is at most `limit`, and otherwise some number above
  // `limit`. A match whose residual is NaN costs 1. The result is the same, bit
  // for bit, on every machine.
  double Cost(const Rigid3& target_from_source, double limit) const;

  // The columns with |q_i - R p_i - t| <= factor * b, in ascending order.
  std::vector<Eigen::Index> Inliers(const Rigid3& target_from_source,
                                    double factor = 1.0) const;

  // The number of matches.
  Eigen::Index num_matches() const { return num_matches_; }

 private:
  Eigen::Index num_matches_;
  // Lengths are in units of b. A block has kLanes values of each of p_x, p_y,
  // p_z, q_x, q_y, q_z and the largest cost of a match: 1, or 0 for padding
  // after the last one.
  std::vector<double> blocks_;
  double noise_bound_;
};

}  // namespace quatro

#endif  // QUATRO_ROBUST_ESTIMATORS_MATCH_SCORER_H_
