// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Translation with outliers, axis by axis: COTE, component-wise translation
// estimation. For rotated source points R p_i and targets q_i, on each axis l
//
//   t_l = argmin_t  sum_i min( (t - v_i)^2 / b_i^2, 1 ),
//   v_i = (q_i - R p_i)_l,                                                  (1)
//
// which is equations (4) and (9) of the paper, divided by c^2, with bounds
// b_i = sigma_i c. (1) is solved exactly: only the sets of i with
// |t - v_i| <= b_i can matter, there are fewer than 2N of them along the axis,
// and each has the weighted mean as its minimum. O(N log N).
//
// Source: Lim et al., "A Single Correspondence Is Enough", ICRA 2022; Yang, Shi
// and Carlone, "TEASER: Fast and Certifiable Point Cloud Registration", T-RO
// 2021. (Their code takes a median and a cost of mixed units; this is (4).)

#ifndef QUATRO_SOLVERS_CLOSED_FORM_TRANSLATION_H_
#define QUATRO_SOLVERS_CLOSED_FORM_TRANSLATION_H_

#include <Eigen/Core>
#include <optional>

#include "features/base/types.h"

namespace quatro {

// The best value, and who agrees with it.
struct ConsensusEstimate {
  double value = 0.0;  // The minimum of (1), in the unit of the values.
  double cost = 0.0;   // (1) there, in [0, N).
  Eigen::Index num_inliers = 0;  // How many i have |value - v_i| <= b_i.
};

// (1) for one axis. `bounds` are > 0, as many as `values`, and the largest no
// more than 1e8 times the smallest; all must be finite. Nullopt if there are
// none.
std::optional<ConsensusEstimate> EstimateConsensus(
    const Eigen::Ref<const Eigen::VectorXd>& values,
    const Eigen::Ref<const Eigen::VectorXd>& bounds);

// The best of each axis.
struct TranslationEstimate {
  Eigen::Vector3d target_from_source;               // [m]
  Eigen::Vector3d cost;                             // (1) of each axis.
  Eigen::Array<bool, Eigen::Dynamic, 1> is_inlier;  // On all three axes.
};

// `rotated_source` holds R p_i; `noise_bound` [m] is the b of all matches and
// axes, > 0; all must be finite. Nullopt if there are no matches.
std::optional<TranslationEstimate> EstimateTranslation(
    const PointsRef& rotated_source,
    const PointsRef& target,
    double noise_bound);

}  // namespace quatro

#endif  // QUATRO_SOLVERS_CLOSED_FORM_TRANSLATION_H_
