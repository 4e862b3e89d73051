// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A candidate pose, before the geometry of the scans has chosen among the
// candidates (robust/verdict/geometric_score.h).

#ifndef QUATRO_ROBUST_ESTIMATORS_PROPOSAL_H_
#define QUATRO_ROBUST_ESTIMATORS_PROPOSAL_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "features/base/rigid3.h"

namespace quatro {

// One candidate.
struct Proposal {
  Rigid3 target_from_source;
  std::vector<Eigen::Index> inliers;  // Columns of the matches, ascending.

  // How much better than chance the inliers explain the matches [nat]: (3) of
  // robust/estimators/consensus_search.h.
  double log_likelihood_ratio = 0.0;
};

// A pose proposed by other means, and its origin.
struct ProposedPose {
  std::string origin;  // For example "clique in SO(3), bound x 2".
  Rigid3 target_from_source;
};

}  // namespace quatro

#endif  // QUATRO_ROBUST_ESTIMATORS_PROPOSAL_H_
