// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/report/thinning.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "features/base/random.h"

namespace quatro {

std::vector<Eigen::Index> Thin(const std::vector<Eigen::Index>& indices,
                               Eigen::Index max_count,
                               std::uint64_t seed) {
  std::vector<Eigen::Index> thinned = indices;
  const auto count =
      static_cast<std::size_t>(std::max<Eigen::Index>(0, max_count));
  if (thinned.size() > count) {
    Random random(seed);
    for (std::size_t i = 0; i < count; ++i) {
      std::swap(thinned[i], thinned[i + random.Below(thinned.size() - i)]);
    }
    thinned.resize(count);
  }
  std::sort(thinned.begin(), thinned.end());
  return thinned;
}

std::vector<Eigen::Index> ThinRange(Eigen::Index count,
                                    Eigen::Index max_count,
                                    std::uint64_t seed) {
  std::vector<Eigen::Index> all(static_cast<std::size_t>(count));
  std::iota(all.begin(), all.end(), 0);
  return Thin(all, max_count, seed);
}

}  // namespace quatro
