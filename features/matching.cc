// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/matching.h"

#include <algorithm>
#include <array>
#include <limits>

#include "features/parallel.h"
#include "features/simd.h"

namespace quatro {
namespace {

// Targets are stored in tiles, one dimension of all its targets after the
// other, so that one SIMD lane is one target.
constexpr int kLanes = 16;
constexpr int kQueries = 4;

// In place of a missing descriptor: as far as can be, and not even at a
// distance from another of its kind.
constexpr float kNoDescriptor = std::numeric_limits<float>::infinity();

using Tile = std::array<std::array<float, kLanes>, kFpfhSize>;

std::vector<Tile> MakeTiles(const Fpfh& descriptors) {
  const Eigen::Index n = descriptors.cols();
  std::vector<Tile> tiles(static_cast<std::size_t>((n + kLanes - 1) / kLanes));
  for (Tile& tile : tiles) {
    for (auto& lanes : tile) {
      lanes.fill(kNoDescriptor);
    }
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    if (descriptors.col(i).isZero(0.0f)) continue;
    Tile& tile = tiles[static_cast<std::size_t>(i / kLanes)];
    for (int d = 0; d < kFpfhSize; ++d) {
      tile[static_cast<std::size_t>(d)][static_cast<std::size_t>(i % kLanes)] =
          descriptors(d, i);
    }
  }
  return tiles;
}

// The squared distances of kQueries descriptors to the targets of one tile.
QUATRO_SIMD_INLINE void Distances(const float* queries,
                                  const float* tile,
                                  float (&out)[kQueries][kLanes]) {
  for (auto& lanes : out) {
    for (float& lane : lanes) lane = 0.0f;
  }
  for (int d = 0; d < kFpfhSize; ++d) {
    const float* lanes = tile + d * kLanes;
    for (int q = 0; q < kQueries; ++q) {
      const float x = queries[q * kFpfhSize + d];
      for (int lane = 0; lane < kLanes; ++lane) {
        const float difference = lanes[lane] - x;
        out[q][lane] += difference * difference;
      }
    }
  }
}

// The nearest of one side to each lane of a tile of the other.
struct TileNearest {
  std::array<float, kLanes> distance;  // Squared.
  std::array<std::int32_t, kLanes> index;
};

// For kQueries descriptors, the first of index `first_query`, the index of the
// nearest target, or -1; and the other way round, whether one of them is nearer
// than what *nearest_query holds. Equal distances leave the lower index.
QUATRO_SIMD_CLONES void Search(const float* queries,
                               std::int32_t first_query,
                               const Tile* tiles,
                               std::size_t num_tiles,
                               TileNearest* nearest_query,
                               std::int32_t* nearest_target) {
  float best[kQueries][kLanes];
  std::int32_t best_tile[kQueries][kLanes];
  for (int q = 0; q < kQueries; ++q) {
    for (int lane = 0; lane < kLanes; ++lane) {
      best[q][lane] = kNoDescriptor;
      best_tile[q][lane] = -1;
    }
  }
  for (std::size_t t = 0; t < num_tiles; ++t) {
    float distance[kQueries][kLanes];
    Distances(queries, tiles[t].front().data(), distance);
    const auto tile = static_cast<std::int32_t>(t);
    float* query_distance = nearest_query[t].distance.data();
    std::int32_t* query_index = nearest_query[t].index.data();
    for (int q = 0; q < kQueries; ++q) {
      for (int lane = 0; lane < kLanes; ++lane) {
        const bool is_nearer = distance[q][lane] < best[q][lane];
        best[q][lane] = is_nearer ? distance[q][lane] : best[q][lane];
        best_tile[q][lane] = is_nearer ? tile : best_tile[q][lane];
      }
      for (int lane = 0; lane < kLanes; ++lane) {
        const bool is_nearer = distance[q][lane] < query_distance[lane];
        query_distance[lane] =
            is_nearer ? distance[q][lane] : query_distance[lane];
        query_index[lane] = is_nearer ? first_query + q : query_index[lane];
      }
    }
  }
  for (int q = 0; q < kQueries; ++q) {
    float least = kNoDescriptor;
    nearest_target[q] = -1;
    for (int lane = 0; lane < kLanes; ++lane) {
      if (best_tile[q][lane] < 0) continue;
      const std::int32_t index = best_tile[q][lane] * kLanes + lane;
      if (best[q][lane] < least ||
          (best[q][lane] == least && index < nearest_target[q])) {
        least = best[q][lane];
        nearest_target[q] = index;
      }
    }
  }
}

// The index of the nearest on the other side, or -1, for each of both sides.
struct NearestOfBoth {
  std::vector<std::int32_t> target_of_source;
  std::vector<std::int32_t> source_of_target;
};

// Both directions in one pass: the distances are the same.
NearestOfBoth FindNearestOfBoth(const Fpfh& source,
                                const Fpfh& target,
                                int num_threads) {
  const std::vector<Tile> tiles = MakeTiles(target);
  const Eigen::Index num_groups = (source.cols() + kQueries - 1) / kQueries;
  // Each part of the sources has its own nearest to the targets.
  const auto num_parts = std::clamp<Eigen::Index>(
      NumThreadsToUse(num_threads), 1, std::max<Eigen::Index>(1, num_groups));
  TileNearest nothing;
  nothing.distance.fill(kNoDescriptor);
  nothing.index.fill(-1);
  std::vector<std::vector<TileNearest>> parts(
      static_cast<std::size_t>(num_parts),
      std::vector<TileNearest>(tiles.size(), nothing));

  NearestOfBoth nearest;
  nearest.target_of_source.assign(static_cast<std::size_t>(source.cols()), -1);
  const auto search_part = [&](Eigen::Index part) {
    const Eigen::Index end = num_groups * (part + 1) / num_parts;
    for (Eigen::Index g = num_groups * part / num_parts; g < end; ++g) {
      Eigen::Matrix<float, kFpfhSize, kQueries> group;
      group.setConstant(kNoDescriptor);
      const Eigen::Index first = g * kQueries;
      const Eigen::Index count =
          std::min<Eigen::Index>(kQueries, source.cols() - first);
      for (Eigen::Index q = 0; q < count; ++q) {
        if (!source.col(first + q).isZero(0.0f)) {
          group.col(q) = source.col(first + q);
        }
      }
      std::int32_t found[kQueries];
      Search(group.data(),
             static_cast<std::int32_t>(first),
             tiles.data(),
             tiles.size(),
             parts[static_cast<std::size_t>(part)].data(),
             found);
      std::copy_n(found,
                  count,
                  &nearest.target_of_source[static_cast<std::size_t>(first)]);
    }
  };
  ParallelFor(
      num_threads, num_parts, 1, [&](Eigen::Index begin, Eigen::Index end) {
        for (Eigen::Index i = begin; i < end; ++i) search_part(i);
      });

  nearest.source_of_target.resize(static_cast<std::size_t>(target.cols()));
  for (std::size_t j = 0; j < nearest.source_of_target.size(); ++j) {
    // Parts are in ascending order of sources: of equals the first wins.
    float least = kNoDescriptor;
    std::int32_t index = -1;
    for (const auto& part : parts) {
      const TileNearest& tile = part[j / kLanes];
      if (tile.distance[j % kLanes] < least) {
        least = tile.distance[j % kLanes];
        index = tile.index[j % kLanes];
      }
    }
    nearest.source_of_target[j] = index;
  }
  return nearest;
}

}  // namespace

std::vector<Match> MatchMutualNearest(const Fpfh& source,
                                      const Fpfh& target,
                                      int num_threads) {
  const NearestOfBoth nearest = FindNearestOfBoth(source, target, num_threads);
  std::vector<Match> matches;
  for (std::size_t i = 0; i < nearest.target_of_source.size(); ++i) {
    const std::int32_t j = nearest.target_of_source[i];
    if (j >= 0 && nearest.source_of_target[static_cast<std::size_t>(j)] ==
                      static_cast<std::int32_t>(i)) {
      matches.push_back({static_cast<std::int32_t>(i), j});
    }
  }
  return matches;
}

}  // namespace quatro
