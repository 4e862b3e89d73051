// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/matching.h"

#include <algorithm>
#include <cstddef>
#include <optional>

#include "features/base/parallel.h"
#include "features/base/simd.h"
#include "features/descriptor_index.h"

namespace quatro {
namespace {

constexpr Eigen::Index kPiece = 64;  // Queries per piece.

// Replaces the entries of the given queries in `nearest` by nearer descriptors
// in `others`. If `any` is set, any nearer one will do. Consecutive queries are
// near each other, so they find the same boxes in the cache.
void FindNearest(const Fpfh& descriptors,
                 const DescriptorIndex& index,
                 const std::vector<std::int32_t>& columns,
                 const DescriptorIndex& others,
                 bool any,
                 int num_threads,
                 SimdLevel level,
                 std::vector<NearestDescriptor>* nearest) {
  const auto find = [&](Eigen::Index begin, Eigen::Index end) {
    std::vector<DescriptorQuery> queries;
    for (Eigen::Index k = begin; k < end; ++k) {
      const std::int32_t i = columns[static_cast<std::size_t>(k)];
      queries.push_back({descriptors.col(i).data(),
                         index.coordinates().col(i).data(),
                         (*nearest)[static_cast<std::size_t>(i)]});
    }
    others.FindNearer(any, level, queries);
    for (Eigen::Index k = begin; k < end; ++k) {
      const std::int32_t i = columns[static_cast<std::size_t>(k)];
      (*nearest)[static_cast<std::size_t>(i)] =
          queries[static_cast<std::size_t>(k - begin)].best;
    }
  };
  ParallelFor(
      num_threads, static_cast<Eigen::Index>(columns.size()), kPiece, find);
}

}  // namespace

std::vector<Match> MatchMutualNearest(const Fpfh& source,
                                      const Fpfh& target,
                                      int num_threads) {
  return MatchMutualNearest(source, target, num_threads, BestSimdLevel());
}

std::vector<Match> MatchMutualNearest(const Fpfh& source,
                                      const Fpfh& target,
                                      int num_threads,
                                      SimdLevel level) {
  const DescriptorAxes axes = FindAxes(source, target);
  std::optional<DescriptorIndex> source_index;
  std::optional<DescriptorIndex> target_index;
  ParallelFor(num_threads, 2, 1, [&](Eigen::Index begin, Eigen::Index end) {
    for (Eigen::Index side = begin; side < end; ++side) {
      if (side == 0) source_index.emplace(source, axes);
      if (side == 1) target_index.emplace(target, axes);
    }
  });

  std::vector<NearestDescriptor> target_of(
      static_cast<std::size_t>(source.cols()));
  FindNearest(source,
              *source_index,
              source_index->order(),
              *target_index,
              /*any=*/false,
              num_threads,
              level,
              &target_of);

  // If several sources have the same nearest target, only the nearest of them
  // can be the target's nearest. It is, unless another source is nearer.
  std::vector<NearestDescriptor> source_of(
      static_cast<std::size_t>(target.cols()));
  for (std::size_t i = 0; i < target_of.size(); ++i) {
    const NearestDescriptor& nearest = target_of[i];
    if (nearest.index == NearestDescriptor{}.index) continue;
    NearestDescriptor& best =
        source_of[static_cast<std::size_t>(nearest.index)];
    if (nearest.squared_distance < best.squared_distance) {
      best = {nearest.squared_distance, static_cast<std::int32_t>(i)};
    }
  }
  std::vector<std::int32_t> targets;
  for (const std::int32_t j : target_index->order()) {
    if (source_of[static_cast<std::size_t>(j)].index !=
        NearestDescriptor{}.index) {
      targets.push_back(j);
    }
  }
  FindNearest(target,
              *target_index,
              targets,
              *source_index,
              /*any=*/true,
              num_threads,
              level,
              &source_of);

  std::vector<Match> matches;
  for (std::size_t i = 0; i < target_of.size(); ++i) {
    const std::int32_t j = target_of[i].index;
    if (j != NearestDescriptor{}.index &&
        source_of[static_cast<std::size_t>(j)].index ==
            static_cast<std::int32_t>(i)) {
      matches.push_back({static_cast<std::int32_t>(i), j});
    }
  }
  return matches;
}

std::vector<Match> MatchInRounds(const std::vector<Match>& matches,
                                 const Fpfh& source,
                                 const Fpfh& target,
                                 int num_rounds,
                                 int num_threads) {
  Fpfh open_source = source;
  Fpfh open_target = target;
  std::vector<Match> all;
  const auto add = [&](const std::vector<Match>& added) {
    for (const Match& match : added) {
      // Descriptors that are zero have no match.
      open_source.col(match.source).setZero();
      open_target.col(match.target).setZero();
    }
    all.insert(all.end(), added.begin(), added.end());
  };
  add(matches);
  for (int round = 0; round < num_rounds; ++round) {
    add(MatchMutualNearest(open_source, open_target, num_threads));
  }
  return all;
}

}  // namespace quatro
