// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/matching.h"

#include <array>
#include <limits>
#include <sstream>

#include "features/parallel.h"
#include "features/random.h"
#include "features/simd.h"

namespace quatro {
namespace {

// Targets are stored in tiles, one dimension of all its targets after the
// other, so that one SIMD lane is one target.
constexpr int kLanes = 16;
constexpr int kQueries = 4;
using Tile = std::array<std::array<float, kLanes>, kFpfhSize>;

std::vector<Tile> MakeTiles(const Fpfh& descriptors) {
  const Eigen::Index n = descriptors.cols();
  std::vector<Tile> tiles(static_cast<std::size_t>((n + kLanes - 1) / kLanes));
  for (Tile& tile : tiles) {
    for (auto& lanes : tile) {
      lanes.fill(std::numeric_limits<float>::infinity());
    }
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    // Infinity stays in place of a missing descriptor: it is nearest to none.
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
inline __attribute__((always_inline)) void Distances(
    const float* queries, const Tile& tile, float (&out)[kQueries][kLanes]) {
  for (auto& lanes : out) {
    for (float& lane : lanes) lane = 0.0f;
  }
  for (int d = 0; d < kFpfhSize; ++d) {
    const float* lanes = tile[static_cast<std::size_t>(d)].data();
    for (int q = 0; q < kQueries; ++q) {
      const float x = queries[q * kFpfhSize + d];
      for (int lane = 0; lane < kLanes; ++lane) {
        const float difference = lanes[lane] - x;
        out[q][lane] += difference * difference;
      }
    }
  }
}

// For kQueries descriptors the index of the nearest target, or -1.
QUATRO_SIMD_CLONES void FindNearest(const float* queries,
                                    const Tile* tiles,
                                    std::size_t num_tiles,
                                    std::int32_t* nearest) {
  float best[kQueries][kLanes];
  std::int32_t best_tile[kQueries][kLanes];
  for (int q = 0; q < kQueries; ++q) {
    for (int lane = 0; lane < kLanes; ++lane) {
      best[q][lane] = std::numeric_limits<float>::infinity();
      best_tile[q][lane] = -1;
    }
  }
  for (std::size_t t = 0; t < num_tiles; ++t) {
    float distance[kQueries][kLanes];
    Distances(queries, tiles[t], distance);
    const auto tile = static_cast<std::int32_t>(t);
    for (int q = 0; q < kQueries; ++q) {
      for (int lane = 0; lane < kLanes; ++lane) {
        const bool is_nearer = distance[q][lane] < best[q][lane];
        best[q][lane] = is_nearer ? distance[q][lane] : best[q][lane];
        best_tile[q][lane] = is_nearer ? tile : best_tile[q][lane];
      }
    }
  }
  for (int q = 0; q < kQueries; ++q) {
    float least = std::numeric_limits<float>::infinity();
    nearest[q] = -1;
    for (int lane = 0; lane < kLanes; ++lane) {
      if (best_tile[q][lane] < 0) continue;
      const std::int32_t index = best_tile[q][lane] * kLanes + lane;
      if (best[q][lane] < least ||
          (best[q][lane] == least && index < nearest[q])) {
        least = best[q][lane];
        nearest[q] = index;
      }
    }
  }
}

std::vector<std::int32_t> FindNearestOfAll(const Fpfh& queries,
                                           const Fpfh& targets,
                                           int num_threads) {
  const std::vector<Tile> tiles = MakeTiles(targets);
  std::vector<std::int32_t> nearest(static_cast<std::size_t>(queries.cols()));
  ParallelFor(num_threads,
              queries.cols(),
              16 * kQueries,
              [&](Eigen::Index begin, Eigen::Index end) {
                for (Eigen::Index i = begin; i < end; i += kQueries) {
                  // The last group is filled up with copies of its last
                  // descriptor.
                  Eigen::Matrix<float, kFpfhSize, kQueries> group;
                  for (int q = 0; q < kQueries; ++q) {
                    group.col(q) = queries.col(std::min(i + q, end - 1));
                  }
                  std::int32_t found[kQueries];
                  FindNearest(group.data(), tiles.data(), tiles.size(), found);
                  for (int q = 0; q < kQueries && i + q < end; ++q) {
                    const bool is_missing = queries.col(i + q).isZero(0.0f);
                    nearest[static_cast<std::size_t>(i + q)] =
                        is_missing ? -1 : found[q];
                  }
                }
              });
  return nearest;
}

}  // namespace

std::vector<Match> MatchMutualNearest(const Fpfh& source,
                                      const Fpfh& target,
                                      int num_threads) {
  const auto target_of = FindNearestOfAll(source, target, num_threads);
  const auto source_of = FindNearestOfAll(target, source, num_threads);
  std::vector<Match> matches;
  for (std::size_t i = 0; i < target_of.size(); ++i) {
    const std::int32_t j = target_of[i];
    if (j >= 0 &&
        source_of[static_cast<std::size_t>(j)] == static_cast<int>(i)) {
      matches.push_back({static_cast<std::int32_t>(i), j});
    }
  }
  return matches;
}

bool TupleTestOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  if (!(scale > 0.0 && scale < 1.0)) {
    problem << "tuple_test.scale = " << scale << ", must be in (0, 1)";
  } else if (num_triples_per_match < 1) {
    problem << "tuple_test.num_triples_per_match = " << num_triples_per_match
            << ", must be >= 1";
  }
  *error = problem.str();
  return error->empty();
}

std::vector<Match> FilterByTupleTest(const std::vector<Match>& matches,
                                     const PointsRef& source,
                                     const PointsRef& target,
                                     const TupleTestOptions& options) {
  const std::size_t n = matches.size();
  if (n < 3) return matches;
  const double s2 = options.scale * options.scale;
  const auto sides_agree = [&](const Match& a, const Match& b) {
    // Equation (1), squared.
    const double p2 =
        (source.col(a.source) - source.col(b.source)).squaredNorm();
    const double q2 =
        (target.col(a.target) - target.col(b.target)).squaredNorm();
    return s2 * q2 < p2 && s2 * p2 < q2;
  };

  std::vector<bool> passes(n, false);
  Random random(options.seed);
  const std::size_t num_triples =
      n * static_cast<std::size_t>(options.num_triples_per_match);
  for (std::size_t triple = 0; triple < num_triples; ++triple) {
    const std::size_t a = random.Below(n);
    const std::size_t b = random.Below(n);
    const std::size_t c = random.Below(n);
    if (passes[a] && passes[b] && passes[c]) continue;
    if (sides_agree(matches[a], matches[b]) &&
        sides_agree(matches[b], matches[c]) &&
        sides_agree(matches[c], matches[a])) {
      passes[a] = passes[b] = passes[c] = true;
    }
  }
  std::vector<Match> kept;
  for (std::size_t i = 0; i < n; ++i) {
    if (passes[i]) kept.push_back(matches[i]);
  }
  return kept;
}

}  // namespace quatro
