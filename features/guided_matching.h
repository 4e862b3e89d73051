// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Matches two clouds near a known pose T = (R, t): (i, j) may match only if
//
//   |T p_i - q_j| <= radius   and   |n_j . R n_i| >= cos(45 deg),          (1)
//
// and matches if their descriptors are mutually nearest among the pairs that
// may. If distances are equal, the lower index wins.
//
// If the pose is wrong, descriptors choose among the pairs of (1) at random,
// and the residuals |T p_i - q_j| are spread over the whole radius. Therefore
// the share of small residuals is evidence for the pose, independent of the
// matches that it was found from.

#ifndef QUATRO_FEATURES_GUIDED_MATCHING_H_
#define QUATRO_FEATURES_GUIDED_MATCHING_H_

#include <vector>

#include "features/base/rigid3.h"
#include "features/described_cloud.h"
#include "features/matching.h"

namespace quatro {

// Returns the matches in ascending order of `source`. Clouds without
// descriptors, and points without a normal or with an all-zero descriptor, have
// no match. `radius` is in [m]. The result is the same for any `num_threads`.
std::vector<Match> MatchGuided(const DescribedCloud& source,
                               const DescribedCloud& target,
                               const Rigid3& target_from_source,
                               double radius,
                               int num_threads);

}  // namespace quatro

#endif  // QUATRO_FEATURES_GUIDED_MATCHING_H_
