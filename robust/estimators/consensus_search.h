// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Consensus search: the poses in yaw and translation with which unusually many
// matches are consistent, without a graph and without pruning,
//
//   v(yaw, t) = #{ i : |e_i,xy| <= r, |e_i,z| <= r + |p_i,xy| tan(max_tilt) },
//   e_i = q_i - R_z(yaw) p_i - t,                                          (1)
//
// with p_i and q_i relative to the center of their cloud. At each yaw step,
// every match votes for the cell of its translation. The fullest blocks of two
// by two cells are refined on their own matches by the closed form
// (solvers/closed_form/yaw_translation.h).
//
// Votes alone mislead. The rings of a spinning lidar look alike around any
// sensor. So matches of equal range vote for a translation of zero, whatever
// the yaw. Therefore the votes are compared with the number expected if the
// matches kept their distances from both centers and had random azimuths,
//
//   lambda(t) = sum_i P(|q_i - R_z(u) p_i - t|_xy <= r),  u uniform,        (2)
//
// summed over the matches whose heights satisfy (1). Poses are ranked by the
// log-likelihood ratio of a Poisson variable,
//
//   v ln(v / lambda) - (v - lambda)  if v > lambda, else 0.                (3)
//
// No translation is excluded. Memory grows linearly with the number of matches.

#ifndef QUATRO_ROBUST_ESTIMATORS_CONSENSUS_SEARCH_H_
#define QUATRO_ROBUST_ESTIMATORS_CONSENSUS_SEARCH_H_

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "features/base/types.h"
#include "robust/estimators/proposal.h"

namespace quatro {

// The search and its bounds.
struct ConsensusSearchOptions {
  double noise_bound = 0.6;  // r, a horizontal radius [m].
  double max_tilt = 0.1;     // [rad], in [0, pi / 4].

  int max_num_proposals = 128;

  // The positions of the sensors [m], from which distances in (1) and (2) are
  // measured. If not set, the medians of the points are used.
  std::optional<Eigen::Vector3d> source_center;
  std::optional<Eigen::Vector3d> target_center;

  // Two proposals differ by more than one of these: in the yaw [rad], or in the
  // position to which they move the center of the source [noise bounds].
  double min_yaw_difference = 0.07;
  double min_shift_in_bounds = 3.0;

  int num_threads = 1;  // 0: all cores. Does not change the result.

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// The most significant poses by (3), the best first. Column i of `source` is
// matched with column i of `target` [m]; z is up. Empty if no block has at
// least three votes.
std::vector<Proposal> SearchConsensus(const PointsRef& source,
                                      const PointsRef& target,
                                      const ConsensusSearchOptions& options);

// How much better than chance the inliers of a pose explain the matches: (3)
// for these matches and any pose [nat]. An inlier is within the noise bound in
// the plane and in height; a tilt of the pose is taken into account, so
// options.max_tilt is not used.
double ConsensusLogLikelihoodRatio(const PointsRef& source,
                                   const PointsRef& target,
                                   const Rigid3& target_from_source,
                                   const ConsensusSearchOptions& options);

}  // namespace quatro

#endif  // QUATRO_ROBUST_ESTIMATORS_CONSENSUS_SEARCH_H_
