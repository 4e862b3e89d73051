// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Draws a random subset of indices.

#ifndef QUATRO_EXPERIMENTS_REPORT_THINNING_H_
#define QUATRO_EXPERIMENTS_REPORT_THINNING_H_

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace quatro {

// Returns `max_count` of the indices, or all if there are no more, in ascending
// order. Every subset has the same probability. The result depends only on the
// indices and the seed.
std::vector<Eigen::Index> Thin(const std::vector<Eigen::Index>& indices,
                               Eigen::Index max_count,
                               std::uint64_t seed);

// Thins the indices 0 .. count - 1.
std::vector<Eigen::Index> ThinRange(Eigen::Index count,
                                    Eigen::Index max_count,
                                    std::uint64_t seed);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_REPORT_THINNING_H_
