// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pthread.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <new>
#include <set>
#include <system_error>
#include <thread>
#include <vector>

#include "features/base/parallel.h"
#include "features/base/random.h"

namespace quatro::parallel_random_test {
namespace {

using ::testing::Each;
using ::testing::Ge;

constexpr int kNumDraws = 100000;

TEST(Random, MixIsSplitMix64) {
  // The first outputs of the authors' reference generator, seeded with 0.
  constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15u;
  EXPECT_EQ(Mix(0), 0xe220a8397b1dcdafu);
  EXPECT_EQ(Mix(kGolden), 0x6e789e6aa1b965f4u);
  EXPECT_EQ(Mix(2 * kGolden), 0x06c45d188009454fu);
}

TEST(Random, SameSeedSameSequence) {
  for (const std::uint64_t seed : {0u, 1u, 2022u}) {
    Random a(seed);
    Random b(seed);
    for (int i = 0; i < 1000; ++i) {
      ASSERT_EQ(a.Next(), b.Next()) << "seed " << seed << ", draw " << i;
    }
  }
}

TEST(Random, SkippingIsDrawing) {
  Random drawn(3);
  for (int i = 0; i < 7; ++i) drawn.Next();
  Random skipped(3);
  skipped.Skip(7);
  EXPECT_EQ(skipped.Next(), drawn.Next());
}

TEST(Random, ConsecutiveSeedsShareNoDraw) {
  std::set<std::uint64_t> draws;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Random random(seed);
    for (int i = 0; i < 1000; ++i) draws.insert(random.Next());
  }
  EXPECT_EQ(draws.size(), 50u * 1000u);
}

// Pearson's statistic of counts that should be equal: about 1 per degree of
// freedom. If it is five standard deviations larger, the draws are not uniform.
void ExpectUniform(const std::vector<int>& counts) {
  double total = 0.0;
  for (const int count : counts) total += count;
  const double expected = total / static_cast<double>(counts.size());
  double chi2 = 0.0;
  for (const int count : counts) {
    chi2 += (count - expected) * (count - expected) / expected;
  }
  const double freedom = static_cast<double>(counts.size() - 1);
  EXPECT_LT(std::abs(chi2 - freedom), 5.0 * std::sqrt(2.0 * freedom))
      << "chi^2 = " << chi2 << " of " << freedom << " degrees of freedom";
}

TEST(Random, BelowIsInRangeAndUniform) {
  for (const std::uint64_t n : {2u, 3u, 7u, 16u, 1000u}) {
    SCOPED_TRACE(n);
    Random random(n);
    std::vector<int> counts(n, 0);
    for (int i = 0; i < kNumDraws; ++i) {
      const std::uint64_t draw = random.Below(n);
      ASSERT_LT(draw, n);
      ++counts[draw];
    }
    ExpectUniform(counts);
  }
}

TEST(Random, BelowReachesBothEndsOfTheWidestRange) {
  constexpr std::uint64_t kMax = std::numeric_limits<std::uint64_t>::max();
  Random random(3);
  std::vector<int> counts(8, 0);
  for (int i = 0; i < kNumDraws; ++i) ++counts[random.Below(kMax) >> 61];
  ExpectUniform(counts);
}

TEST(Random, BelowOneIsZero) {
  Random random(1);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(random.Below(1), 0u);
}

TEST(Random, UniformIsInTheHalfOpenUnitIntervalAndUniform) {
  Random random(1);
  std::vector<int> counts(100, 0);
  for (int i = 0; i < kNumDraws; ++i) {
    const double draw = random.Uniform();
    ASSERT_GE(draw, 0.0);
    ASSERT_LT(draw, 1.0);
    ++counts[static_cast<std::size_t>(100.0 * draw)];
  }
  ExpectUniform(counts);
}

TEST(Random, ConsecutiveDrawsAreIndependent) {
  Random random(4);
  std::vector<int> counts(64, 0);
  for (int i = 0; i < kNumDraws; ++i) {
    const std::uint64_t first = random.Below(8);
    ++counts[8 * first + random.Below(8)];
  }
  ExpectUniform(counts);
}

TEST(Parallel, ZeroThreadsStandsForAtLeastOne) {
  EXPECT_GE(NumThreadsToUse(0), 1);
  EXPECT_EQ(NumThreadsToUse(1), 1);
  EXPECT_EQ(NumThreadsToUse(7), 7);
}

TEST(Parallel, CoversEveryIndexExactlyOnce) {
  for (const Eigen::Index n : {0, 1, 2, 3, 15, 16, 17, 255, 256, 257, 1000}) {
    for (const Eigen::Index piece : {1, 2, 7, 16, 256, 5000}) {
      for (const int num_threads : {0, 1, 2, 3, 8}) {
        std::vector<int> visits(static_cast<std::size_t>(n), 0);
        ParallelFor(
            num_threads, n, piece, [&](Eigen::Index begin, Eigen::Index end) {
              for (Eigen::Index i = begin; i < end; ++i) {
                ++visits[static_cast<std::size_t>(i)];
              }
            });
        ASSERT_THAT(visits, Each(1)) << "n = " << n << ", pieces of " << piece
                                     << ", " << num_threads << " threads";
      }
    }
  }
}

TEST(Parallel, PiecesAreDisjointWholeAndWithinTheRange) {
  constexpr Eigen::Index kPiece = 16;
  for (const Eigen::Index n : {0, 1, 16, 100}) {
    std::atomic<Eigen::Index> num_pieces{0};
    ParallelFor(2, n, kPiece, [&](Eigen::Index begin, Eigen::Index end) {
      EXPECT_EQ(begin % kPiece, 0);
      EXPECT_EQ(end, std::min(n, begin + kPiece));
      EXPECT_LT(begin, end);
      ++num_pieces;
    });
    EXPECT_EQ(num_pieces, (n + kPiece - 1) / kPiece) << "n = " << n;
  }
}

TEST(Parallel, OneThreadIsTheCallers) {
  std::vector<std::thread::id> ids(10);
  ParallelFor(1, 10, 1, [&](Eigen::Index i, Eigen::Index) {
    ids[static_cast<std::size_t>(i)] = std::this_thread::get_id();
  });
  EXPECT_THAT(ids, Each(std::this_thread::get_id()));
}

TEST(Parallel, SeveralThreadsRunAtOnce) {
  // Each piece waits for the other, so one thread alone would hang.
  std::atomic<int> num_arrived{0};
  ParallelFor(2, 2, 1, [&](Eigen::Index, Eigen::Index) {
    ++num_arrived;
    while (num_arrived < 2) std::this_thread::yield();
  });
  EXPECT_THAT(num_arrived.load(), Ge(2));
}

// An exception of any thread is rethrown, and no thread is left running.
TEST(Parallel, WhatTheBodyThrowsReachesTheCaller) {
  for (const int num_threads : {1, 2, 8}) {
    for (const Eigen::Index bad : {0, 50, 99}) {
      std::atomic<int> num_running{0};
      const auto body = [&](Eigen::Index i, Eigen::Index) {
        ++num_running;
        const bool is_bad = i == bad;
        --num_running;
        if (is_bad) throw std::bad_alloc();
      };
      EXPECT_THROW(ParallelFor(num_threads, 100, 1, body), std::bad_alloc)
          << num_threads << " threads, piece " << bad;
      EXPECT_EQ(num_running, 0);
    }
  }
}

TEST(Parallel, AfterAThrowNoPieceIsBegun) {
  int num_begun = 0;
  EXPECT_THROW(ParallelFor(1,
                           100,
                           1,
                           [&](Eigen::Index, Eigen::Index) {
                             ++num_begun;
                             throw std::bad_alloc();
                           }),
               std::bad_alloc);
  EXPECT_EQ(num_begun, 1);
}

// A stack of 2^50 bytes cannot be allocated.
TEST(Parallel, DoesWithoutThreadsThatCannotBeStarted) {
  pthread_attr_t before, huge;
  ASSERT_EQ(pthread_getattr_default_np(&before), 0);
  ASSERT_EQ(pthread_attr_init(&huge), 0);
  ASSERT_EQ(pthread_attr_setstacksize(&huge, std::size_t{1} << 50), 0);
  ASSERT_EQ(pthread_setattr_default_np(&huge), 0);
  EXPECT_THROW(std::thread([] {}).join(), std::system_error);
  std::vector<int> visits(100, 0);
  ParallelFor(8, 100, 1, [&](Eigen::Index i, Eigen::Index) {
    ++visits[static_cast<std::size_t>(i)];
  });
  EXPECT_EQ(pthread_setattr_default_np(&before), 0);
  EXPECT_THAT(visits, Each(1));
  pthread_attr_destroy(&huge);
  pthread_attr_destroy(&before);
}

}  // namespace
}  // namespace quatro::parallel_random_test
