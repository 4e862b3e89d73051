// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/fpfh.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <numeric>
#include <span>
#include <vector>

#include "features/base/parallel.h"
#include "features/base/simd.h"
#include "features/base/zeroed_allocator.h"
#include "features/pair_feature.h"

namespace quatro {
namespace {

// The largest number of parts of the cloud whose pairs are counted in parallel.
// Each part has its own array.
constexpr Eigen::Index kMaxParts = 8;

// A row holds one part of a descriptor.
constexpr int kRowLanes = 16;
using Row __attribute__((vector_size(4 * kRowLanes), may_alias)) = float;

struct alignas(64) Histogram {
  float part[3][kRowLanes];
};

// The number of pairs of a point in each bin.
struct alignas(64) Counts {
  std::int32_t part[3][kRowLanes] = {};

  void Add(const PairBins& bins) {
    ++part[0][bins.part(0)];
    ++part[1][bins.part(1)];
    ++part[2][bins.part(2)];
  }
  void Add(const Counts& other) {
    for (int k = 0; k < 3; ++k) {
      for (int lane = 0; lane < kRowLanes; ++lane) {
        part[k][lane] += other.part[k][lane];
      }
    }
  }
  // The number of pairs of distinct points that both have a normal.
  std::int32_t NumPairs() const {
    return std::accumulate(part[0], part[0] + PairBins::kNoPair, 0);
  }
};

// 1 / distance, or 0 if the distance is 0.
QUATRO_SIMD_CLONES void FindWeights(const float* __restrict squared_distance,
                                    std::size_t size,
                                    float* __restrict weights) {
  for (std::size_t k = 0; k < size; ++k) {
    const bool is_apart = squared_distance[k] > 0.0f;
    const float divisor = std::sqrt(is_apart ? squared_distance[k] : 1.0f);
    weights[k] = is_apart ? 1.0f / divisor : 0.0f;
  }
}

// The sum in (2). Points without a normal have an SPFH of zero.
QUATRO_SIMD_CLONES void AddUp(const Histogram* spfh,
                              const std::int32_t* index,
                              const float* weights,
                              std::size_t size,
                              Histogram* out) {
  Row sum0 = {}, sum1 = {}, sum2 = {};
  for (std::size_t k = 0; k < size; ++k) {
    const auto* rows = reinterpret_cast<const Row*>(spfh[index[k]].part[0]);
    sum0 += rows[0] * weights[k];
    sum1 += rows[1] * weights[k];
    sum2 += rows[2] * weights[k];
  }
  auto* rows = reinterpret_cast<Row*>(out->part[0]);
  rows[0] = sum0;
  rows[1] = sum1;
  rows[2] = sum2;
}

// Scales each part to the given sum. A part that is all zero stays zero. Lanes
// past the bins are zero.
void NormalizeParts(float sum, Histogram* histogram) {
  for (auto& part : histogram->part) {
    float mass = 0.0f;
    for (int bin = 0; bin < kFpfhBinsPerPart; ++bin) mass += part[bin];
    if (!(mass > 0.0f)) continue;
    *reinterpret_cast<Row*>(part) *= sum / mass;
  }
}

// Counts the pairs of points [begin, end) with later points. Each pair counts
// for both of its points, because the feature is symmetric. The result starts
// at point `begin`.
ZeroedVector<Counts> CountPairs(const std::vector<OrientedPoint>& points,
                                const Neighborhoods& neighborhoods,
                                Eigen::Index begin,
                                Eigen::Index end) {
  const auto later = [&](Eigen::Index i) {
    const std::span<const std::int32_t> index = neighborhoods.row(i).index;
    const auto first = std::upper_bound(index.begin(), index.end(), i);
    return index.subspan(static_cast<std::size_t>(first - index.begin()));
  };
  Eigen::Index last = end - 1;
  for (Eigen::Index i = begin; i < end; ++i) {
    const auto& index = neighborhoods.row(i).index;
    if (!index.empty()) last = std::max<Eigen::Index>(last, index.back());
  }
  ZeroedVector<Counts> counts(static_cast<std::size_t>(last - begin + 1));
  PairBinner binner;
  for (Eigen::Index i = begin; i < end; ++i) {
    const OrientedPoint& own = points[static_cast<std::size_t>(i)];
    if (!own.HasNormal()) continue;
    const std::span<const std::int32_t> index = later(i);
    const auto bins = binner.FindBins(own, points, index);
    // Two counters, since consecutive pairs often fall into the same bin.
    Counts of_own[2];
    for (std::size_t k = 0; k < index.size(); ++k) {
      of_own[k % 2].Add(bins[k]);
      counts[static_cast<std::size_t>(index[k] - begin)].Add(bins[k]);
    }
    Counts& all = counts[static_cast<std::size_t>(i - begin)];
    all.Add(of_own[0]);
    all.Add(of_own[1]);
  }
  return counts;
}

// The SPFH of a point, from the counts of its pairs.
Histogram MakeSpfh(const Counts& counts) {
  Histogram histogram;
  for (int part = 0; part < 3; ++part) {
    for (int bin = 0; bin < kRowLanes; ++bin) {
      histogram.part[part][bin] =
          bin < kFpfhBinsPerPart ? static_cast<float>(counts.part[part][bin])
                                 : 0.0f;
    }
  }
  NormalizeParts(1.0f, &histogram);
  return histogram;
}

// Computes (2) in place: *sum is the sum in (2), `num_pairs` is k.
void FinishFpfh(const Histogram& spfh, std::int32_t num_pairs, Histogram* sum) {
  const float scale =
      num_pairs > 0 ? 1.0f / static_cast<float>(num_pairs) : 1.0f;
  for (int part = 0; part < 3; ++part) {
    auto* row = reinterpret_cast<Row*>(sum->part[part]);
    *row = *row * scale + *reinterpret_cast<const Row*>(spfh.part[part]);
  }
  NormalizeParts(100.0f, sum);
}

// The points with their normals. Coordinates are relative to a point of the
// cloud, so that they keep their digits in single precision.
std::vector<OrientedPoint> Orient(const PointsRef& points,
                                  const PointsRef& normals) {
  const Eigen::Index n = points.cols();
  const Eigen::Vector3d center = points.col(n / 2);
  std::vector<OrientedPoint> oriented(static_cast<std::size_t>(n));
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Vector3f p = (points.col(i) - center).cast<float>();
    const Eigen::Vector3f normal = normals.col(i).cast<float>();
    constexpr float kNowhere = std::numeric_limits<float>::quiet_NaN();
    oriented[static_cast<std::size_t>(i)] = {
        normal.isZero(0.0f) ? kNowhere : p.x(),
        p.y(),
        p.z(),
        normal.x(),
        normal.y(),
        normal.z()};
  }
  return oriented;
}

}  // namespace

Fpfh ComputeFpfh(const PointsRef& points,
                 const PointsRef& normals,
                 const Neighborhoods& neighborhoods,
                 int num_threads) {
  const Eigen::Index n = points.cols();
  Fpfh fpfh(kFpfhSize, n);
  if (n == 0) return fpfh;
  const std::vector<OrientedPoint> oriented = Orient(points, normals);

  // Each part is counted in its own array. Sums of integers do not depend on
  // how the cloud is split.
  const Eigen::Index num_parts =
      std::min<Eigen::Index>({NumThreadsToUse(num_threads), kMaxParts, n});
  const auto part_begin = [&](Eigen::Index part) {
    return part * n / num_parts;
  };
  std::vector<ZeroedVector<Counts>> counts(static_cast<std::size_t>(num_parts));
  ParallelFor(
      num_threads, num_parts, 1, [&](Eigen::Index begin, Eigen::Index end) {
        for (Eigen::Index part = begin; part < end; ++part) {
          counts[static_cast<std::size_t>(part)] = CountPairs(
              oriented, neighborhoods, part_begin(part), part_begin(part + 1));
        }
      });
  const auto size = static_cast<std::size_t>(n);
  ZeroedVector<Histogram> spfh(size);
  const auto num_pairs = std::make_unique_for_overwrite<std::int32_t[]>(size);
  ParallelFor(num_threads, n, 256, [&](Eigen::Index begin, Eigen::Index end) {
    for (Eigen::Index i = begin; i < end; ++i) {
      Counts sum;
      for (Eigen::Index part = 0; part < num_parts; ++part) {
        const auto& of_part = counts[static_cast<std::size_t>(part)];
        const auto at = static_cast<std::size_t>(i - part_begin(part));
        if (i >= part_begin(part) && at < of_part.size()) sum.Add(of_part[at]);
      }
      spfh[static_cast<std::size_t>(i)] = MakeSpfh(sum);
      num_pairs[static_cast<std::size_t>(i)] = sum.NumPairs();
    }
  });

  ParallelFor(num_threads, n, 256, [&](Eigen::Index begin, Eigen::Index end) {
    std::vector<float> weights;
    for (auto i = static_cast<std::size_t>(begin);
         i < static_cast<std::size_t>(end);
         ++i) {
      if (!oriented[i].HasNormal()) {
        fpfh.col(static_cast<Eigen::Index>(i)).setZero();
        continue;
      }
      const Neighborhoods::Row& row =
          neighborhoods.row(static_cast<Eigen::Index>(i));
      weights.resize(std::max(weights.size(), row.size()));
      FindWeights(row.squared_distance.data(), row.size(), weights.data());
      Histogram sum;
      AddUp(spfh.data(), row.index.data(), weights.data(), row.size(), &sum);
      FinishFpfh(spfh[i], num_pairs[i], &sum);
      for (int part = 0; part < 3; ++part) {
        std::copy_n(
            sum.part[part],
            kFpfhBinsPerPart,
            &fpfh(part * kFpfhBinsPerPart, static_cast<Eigen::Index>(i)));
      }
    }
  });
  return fpfh;
}

}  // namespace quatro
