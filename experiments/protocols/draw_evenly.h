// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Selects a subset that is spread evenly over the whole.

#ifndef QUATRO_EXPERIMENTS_PROTOCOLS_DRAW_EVENLY_H_
#define QUATRO_EXPERIMENTS_PROTOCOLS_DRAW_EVENLY_H_

#include <algorithm>
#include <cstddef>
#include <vector>

#include "features/base/random.h"

namespace quatro {

// Draws `max` of 0 .. n - 1 (all if max is 0 or n <= max), as evenly as
// possible:
//
//   floor((k + u) n / max),  k = 0 .. max - 1,  u uniform in [0, 1).      (1)
inline std::vector<std::size_t> DrawEvenly(std::size_t n,
                                           std::size_t max,
                                           Random& random) {
  const std::size_t num = max == 0 || n < max ? n : max;
  const double offset = random.Uniform();
  std::vector<std::size_t> drawn;
  for (std::size_t k = 0; k < num; ++k) {
    const double at = (static_cast<double>(k) + offset) *
                      static_cast<double>(n) / static_cast<double>(num);
    // k + u may round up to max.
    drawn.push_back(num == n ? k
                             : std::min(n - 1, static_cast<std::size_t>(at)));
  }
  return drawn;
}

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PROTOCOLS_DRAW_EVENLY_H_
