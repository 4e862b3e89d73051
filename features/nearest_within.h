// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Finds, for many places q at once, the nearest point p of a cloud,
//
//   argmin_p |q - p|,   if the distance is at most the radius.
//
// Places in the same cell (features/cells.h) share their candidates. This is
// faster than a k-d tree if a ball of the radius holds few points, as in a
// sampled cloud. A k-d tree is for radii that are not known in advance.

#ifndef QUATRO_FEATURES_NEAREST_WITHIN_H_
#define QUATRO_FEATURES_NEAREST_WITHIN_H_

#include <cstdint>
#include <vector>

#include "features/base/types.h"
#include "features/kd_tree.h"

namespace quatro {

constexpr std::int32_t kNoneWithin = -1;

// For each column of `places`, the index of the nearest point of the tree
// within `radius` [m]. If points are equally near, the lowest index wins.
// kNoneWithin if no point is that near or the place is not finite.
std::vector<std::int32_t> FindNearestWithin(const KdTree& tree,
                                            const Points& places,
                                            double radius,
                                            int num_threads);

}  // namespace quatro

#endif  // QUATRO_FEATURES_NEAREST_WITHIN_H_
