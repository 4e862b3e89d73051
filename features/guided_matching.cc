// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/guided_matching.h"

#include <cmath>
#include <cstdint>
#include <limits>

#include "features/base/parallel.h"

namespace quatro {
namespace {

const double kMinNormalCosine = std::sqrt(0.5);

constexpr std::int32_t kNoMatch = -1;

bool IsDescribed(const DescribedCloud& cloud, Eigen::Index i) {
  return !cloud.normals.col(i).isZero(0.0) &&
         !cloud.descriptors->col(i).isZero(0.0f);
}

// For each point of `from`, the point of `to` with the nearest descriptor among
// those of (1), or kNoMatch.
std::vector<std::int32_t> NearestGuided(const DescribedCloud& from,
                                        const DescribedCloud& to,
                                        const Rigid3& to_from_from,
                                        double radius,
                                        int num_threads) {
  constexpr Eigen::Index kGrain = 64;
  const Eigen::Index num = from.points().cols();
  std::vector<std::int32_t> nearest(static_cast<std::size_t>(num), kNoMatch);
  const auto find = [&](Eigen::Index i) {
    std::int32_t found = kNoMatch;
    const auto descriptor = from.descriptors->col(i);
    const Eigen::Vector3d normal = to_from_from.rotation * from.normals.col(i);
    float best = std::numeric_limits<float>::infinity();
    for (const Neighbor& neighbor :
         to.tree->WithinRadius(to_from_from * from.points().col(i), radius)) {
      const Eigen::Index j = neighbor.index;
      if (std::abs(normal.dot(to.normals.col(j))) < kMinNormalCosine ||
          !IsDescribed(to, j)) {
        continue;
      }
      const float distance =
          (descriptor - to.descriptors->col(j)).squaredNorm();
      if (distance < best) {
        best = distance;
        found = static_cast<std::int32_t>(j);
      }
    }
    return found;
  };
  ParallelFor(
      num_threads, num, kGrain, [&](Eigen::Index begin, Eigen::Index end) {
        for (Eigen::Index i = begin; i < end; ++i) {
          if (IsDescribed(from, i)) {
            nearest[static_cast<std::size_t>(i)] = find(i);
          }
        }
      });
  return nearest;
}

}  // namespace

std::vector<Match> MatchGuided(const DescribedCloud& source,
                               const DescribedCloud& target,
                               const Rigid3& target_from_source,
                               double radius,
                               int num_threads) {
  if (!source.descriptors || !target.descriptors) return {};
  const std::vector<std::int32_t> of_source =
      NearestGuided(source, target, target_from_source, radius, num_threads);
  const std::vector<std::int32_t> of_target = NearestGuided(
      target, source, Inverse(target_from_source), radius, num_threads);
  std::vector<Match> matches;
  for (std::size_t i = 0; i < of_source.size(); ++i) {
    const std::int32_t j = of_source[i];
    if (j == kNoMatch) continue;
    const auto source_index = static_cast<std::int32_t>(i);
    if (of_target[static_cast<std::size_t>(j)] == source_index) {
      matches.push_back({source_index, j});
    }
  }
  return matches;
}

}  // namespace quatro
