// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Translation from matches with outliers, axis by axis: COTE, component-wise
// translation estimation. For rotated source points R p_i and targets q_i, on
// each axis l,
//
//   t_l = argmin_t  sum_i min( (t - v_i)^2 / b_i^2, 1 ),
//   v_i = (q_i - R p_i)_l,                                                  (1)
//
// These are equations (4) and (9) of the Quatro paper divided by c^2, with
// bounds b_i = sigma_i c. (1) is solved exactly: along the axis there are fewer
// than 2N distinct sets of inliers {i : |t - v_i| <= b_i}, and the minimum of
// each is at its weighted mean. The cost is O(N log N).
//
// Sources: Lim et al., "A Single Correspondence Is Enough", ICRA 2022; Yang,
// Shi and Carlone, "TEASER: Fast and Certifiable Point Cloud Registration",
// T-RO 2021. (The code of these papers uses a median and a cost with mixed
// units; this file implements equation (4) as printed.)

#ifndef QUATRO_SOLVERS_CLOSED_FORM_TRANSLATION_H_
#define QUATRO_SOLVERS_CLOSED_FORM_TRANSLATION_H_

#include <Eigen/Core>
#include <optional>

#include "features/base/types.h"

namespace quatro {

// The minimum of (1) for one axis.
struct ConsensusEstimate {
  double value = 0.0;  // The minimizer t of (1), in the unit of the values.
  double cost = 0.0;   // (1) at the minimum, in [0, N).
  Eigen::Index num_inliers = 0;  // Number of i with |value - v_i| <= b_i.
};

// Solves (1) for one axis. There is one bound > 0 per value, and the largest
// bound must be at most 1e8 times the smallest. All values and bounds must be
// finite. Returns nullopt if there are no values.
std::optional<ConsensusEstimate> EstimateConsensus(
    const Eigen::Ref<const Eigen::VectorXd>& values,
    const Eigen::Ref<const Eigen::VectorXd>& bounds);

// The minimum of (1) for all three axes.
struct TranslationEstimate {
  Eigen::Vector3d target_from_source;               // [m]
  Eigen::Vector3d cost;                             // (1) of each axis.
  Eigen::Array<bool, Eigen::Dynamic, 1> is_inlier;  // Inlier on each axis.
};

// `rotated_source` holds the R p_i, and `target` the q_i [m]. `noise_bound` > 0
// [m] is the b_i of all matches: a bound on each axis, half the edge of a box,
// not a radius. All must be finite. Returns nullopt if there are no matches.
std::optional<TranslationEstimate> EstimateTranslation(
    const PointsRef& rotated_source,
    const PointsRef& target,
    double noise_bound);

}  // namespace quatro

#endif  // QUATRO_SOLVERS_CLOSED_FORM_TRANSLATION_H_
