// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Consensus search: the poses in yaw and translation with which unusually many
// matches are consistent, without a graph and without pruning,
//
//   v(yaw, t) = #{ i : |e_i,xy| <= r, |e_i,z| <= r + |p_i,xy| tan(max_tilt) },
//   e_i = q_i - R_z(yaw) p_i - t.                                          (1)
//
// Every match votes once per yaw step for the cell of its translation. The
// fullest cells are refined on their own matches by the closed form
// (solvers/closed_form/yaw_translation.h).
//
// Votes alone mislead. The rings of a spinning lidar look alike around any
// sensor, so matches of equal range coincide with no translation at any yaw.
// Therefore a cell is compared with the number of votes expected if the
// matches kept their distances from both centers and had random azimuths,
//
//   lambda(t) = sum_i P(|q_i - R_z(u) p_i - t|_xy <= r),  u uniform,        (2)
//
// and cells are ranked by the log-likelihood ratio of a Poisson variable,
//
//   v ln(v / lambda) - (v - lambda)  if v > lambda, else 0.                (3)
//
// No translation is excluded. Memory grows with the number of matches.

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
  double noise_bound = 0.6;  // r [m]
  double max_tilt = 0.1;     // [rad], in [0, pi / 4].

  int max_num_proposals = 128;

  // Where the sensors stood, for (2) [m]. The medians of the points if not set.
  std::optional<Eigen::Vector3d> source_center;
  std::optional<Eigen::Vector3d> target_center;

  // Two proposals differ by more than one of these: in yaw [rad], or in where
  // they move the middle of the source [noise bounds].
  double min_yaw_difference = 0.07;
  double min_shift_in_bounds = 3.0;

  int num_threads = 1;  // 0: all cores. Never changes the answer.

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// The most significant poses by (3), the best first. Column i of `source` is
// matched with column i of `target` [m]; z is up. Empty if no two matches are
// consistent.
std::vector<Proposal> SearchConsensus(const PointsRef& source,
                                      const PointsRef& target,
                                      const ConsensusSearchOptions& options);

}  // namespace quatro

#endif  // QUATRO_ROBUST_ESTIMATORS_CONSENSUS_SEARCH_H_
