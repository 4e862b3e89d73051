// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Finds, for many places q at once, the nearest point p of a cloud,
//
//   argmin_p |q - p|,   if the distance is at most the radius.
//
// Places in the same cell (features/cells.h) share their candidates. This is
// faster than a k-d tree if a ball of the radius holds few points, as in a
// sampled cloud. Use a k-d tree if the radius is not known in advance.

#ifndef QUATRO_FEATURES_NEAREST_WITHIN_H_
#define QUATRO_FEATURES_NEAREST_WITHIN_H_

#include <cstdint>
#include <vector>

#include "features/base/types.h"
#include "features/kd_tree.h"

namespace quatro {

// The index of no point.
constexpr std::int32_t kNoneWithin = -1;

// For each column of `places` [m], the index of the nearest point of the tree
// within `radius` [m], or kNoneWithin if no point is that near or the place is
// not finite. If points are equally near, the lowest index wins, unless the
// cloud is too wide for cells.
std::vector<std::int32_t> FindNearestWithin(const KdTree& tree,
                                            const Points& places,
                                            double radius,
                                            int num_threads);

}  // namespace quatro

#endif  // QUATRO_FEATURES_NEAREST_WITHIN_H_
