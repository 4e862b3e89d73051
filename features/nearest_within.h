// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Of many places the nearest point of a cloud each, all at once:
//
//   argmin_p |q - p|,   if that is no more than the radius.
//
// Places in one cell (features/cells.h) look at the same few points. Faster
// than a kd-tree where a ball holds few points, as of a sampled cloud; what a
// kd-tree is built for are radii that are not known before.

#ifndef QUATRO_FEATURES_NEAREST_WITHIN_H_
#define QUATRO_FEATURES_NEAREST_WITHIN_H_

#include <cstdint>
#include <vector>

#include "features/base/types.h"
#include "features/kd_tree.h"

namespace quatro {

constexpr std::int32_t kNoneWithin = -1;

// Of each column of `places` the index of the nearest point of the tree within
// `radius` [m], the lowest of equally near ones; kNoneWithin where there is
// none, or the place is not finite.
std::vector<std::int32_t> FindNearestWithin(const KdTree& tree,
                                            const Points& places,
                                            double radius,
                                            int num_threads);

}  // namespace quatro

#endif  // QUATRO_FEATURES_NEAREST_WITHIN_H_
