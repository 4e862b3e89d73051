// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/estimators/tims.h"

#include <algorithm>

#include "features/base/random.h"

namespace quatro {

std::vector<TimPair> MakeTimPairs(Eigen::Index num_points,
                                  TimLayout layout,
                                  Eigen::Index num_random,
                                  std::uint64_t seed) {
  std::vector<TimPair> pairs;
  if (num_points < 2) return pairs;
  switch (layout) {
    case TimLayout::kRing:
      if (num_points > 2) pairs.emplace_back(0, num_points - 1);
      for (Eigen::Index i = 1; i < num_points; ++i)
        pairs.emplace_back(i, i - 1);
      break;
    case TimLayout::kComplete:
      for (Eigen::Index i = 1; i < num_points; ++i) {
        for (Eigen::Index j = 0; j < i; ++j) pairs.emplace_back(i, j);
      }
      break;
    case TimLayout::kRandom: {
      Random random(seed);
      const auto n = static_cast<std::uint64_t>(num_points);
      for (Eigen::Index k = 0; k < num_random; ++k) {
        const std::uint64_t a = random.Below(n);
        const std::uint64_t b = (a + 1 + random.Below(n - 1)) % n;
        pairs.emplace_back(a, b);
      }
      break;
    }
  }
  return pairs;
}

Points ComputeTims(const PointsRef& points, const std::vector<TimPair>& pairs) {
  Points tims(3, static_cast<Eigen::Index>(pairs.size()));
  Eigen::Index k = 0;
  for (const auto& [a, b] : pairs)
    tims.col(k++) = points.col(a) - points.col(b);
  return tims;
}

std::vector<double> WeighPoints(const std::vector<TimPair>& pairs,
                                const Eigen::VectorXd& weights,
                                Eigen::Index num_points) {
  std::vector<double> of_points(static_cast<std::size_t>(num_points));
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    for (const Eigen::Index i : {pairs[k].first, pairs[k].second}) {
      double& weight = of_points[static_cast<std::size_t>(i)];
      weight = std::max(weight, weights(static_cast<Eigen::Index>(k)));
    }
  }
  return of_points;
}

}  // namespace quatro
