// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/estimators/tims.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <set>
#include <vector>

namespace quatro::tims_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

std::vector<TimPair> Ring(Eigen::Index num_points) {
  return MakeTimPairs(num_points, TimLayout::kRing, 0, 0);
}

std::vector<TimPair> RandomPairs(Eigen::Index num_points,
                                 Eigen::Index num_random,
                                 std::uint64_t seed) {
  return MakeTimPairs(num_points, TimLayout::kRandom, num_random, seed);
}

TEST(TimRing, FirstPairClosesTheRing) {
  EXPECT_THAT(Ring(3),
              ElementsAre(TimPair(0, 2), TimPair(1, 0), TimPair(2, 1)));
  EXPECT_THAT(Ring(5),
              ElementsAre(TimPair(0, 4),
                          TimPair(1, 0),
                          TimPair(2, 1),
                          TimPair(3, 2),
                          TimPair(4, 3)));
}

TEST(TimRing, TwoPointsAreOnePairAndNotTheSameTwice) {
  EXPECT_THAT(Ring(2), ElementsAre(TimPair(1, 0)));
}

TEST(TimPairs, FewerThanTwoPointsHaveNoneInAnyLayout) {
  for (const TimLayout layout :
       {TimLayout::kRing, TimLayout::kComplete, TimLayout::kRandom}) {
    EXPECT_THAT(MakeTimPairs(0, layout, 10, 0), IsEmpty());
    EXPECT_THAT(MakeTimPairs(1, layout, 10, 0), IsEmpty());
  }
}

TEST(TimComplete, HoldsEachUnorderedPairOnce) {
  for (const Eigen::Index n : {2, 3, 7, 40}) {
    const auto pairs = MakeTimPairs(n, TimLayout::kComplete, 0, 0);
    std::set<TimPair> unordered;
    for (const auto& [a, b] : pairs) {
      EXPECT_NE(a, b);
      unordered.insert(std::minmax(a, b));
    }
    EXPECT_THAT(pairs, SizeIs(n * (n - 1) / 2));
    EXPECT_THAT(unordered, SizeIs(n * (n - 1) / 2));
  }
}

TEST(TimRandom, DrawsAsManyAsAskedForBetweenDifferentPoints) {
  for (const Eigen::Index n : {2, 3, 10}) {
    const auto pairs = RandomPairs(n, 2000, 1);
    EXPECT_THAT(pairs, SizeIs(2000));
    std::set<TimPair> seen;
    for (const auto& [a, b] : pairs) {
      ASSERT_NE(a, b);
      ASSERT_GE(std::min(a, b), 0);
      ASSERT_LT(std::max(a, b), n);
      seen.emplace(a, b);
    }
    // All n (n - 1) ordered pairs occur.
    EXPECT_THAT(seen, SizeIs(n * (n - 1)));
  }
}

TEST(TimRandom, DependsOnTheSeedAlone) {
  EXPECT_EQ(RandomPairs(100, 50, 7), RandomPairs(100, 50, 7));
  EXPECT_NE(RandomPairs(100, 50, 7), RandomPairs(100, 50, 8));
}

TEST(ComputeTims, SubtractsTheSecondFromTheFirst) {
  Points points(3, 3);
  points << 1, 2, 4,  //
      10, 20, 40,     //
      100, 200, 400;
  const Points tims = ComputeTims(points, {{2, 0}, {0, 1}});
  ASSERT_EQ(tims.cols(), 2);
  EXPECT_EQ(tims.col(0), Eigen::Vector3d(3, 30, 300));
  EXPECT_EQ(tims.col(1), Eigen::Vector3d(-1, -10, -100));
}

TEST(ComputeTims, DoNotHoldTheTranslation) {
  Points points(3, 4);    // Integers, so the shift is exact.
  points << 1, -2, 4, 7,  //
      0, 3, -9, 5,        //
      2, 2, 8, -1;
  const Points moved = points.colwise() + Eigen::Vector3d(5, -6, 7);
  EXPECT_EQ(ComputeTims(points, Ring(4)), ComputeTims(moved, Ring(4)));
}

TEST(ComputeTims, NoPairsGiveNoColumns) {
  EXPECT_EQ(ComputeTims(Points(3, 1), {}).cols(), 0);
}

TEST(WeighPoints, APointHasTheLargestWeightOfItsDifferences) {
  const Eigen::Vector4d weights(0.2, 0.9, 0.1, 0.4);
  EXPECT_THAT(WeighPoints({{0, 3}, {1, 0}, {2, 1}, {3, 2}}, weights, 5),
              ElementsAre(0.9, 0.9, 0.4, 0.4, 0.0));
}

}  // namespace
}  // namespace quatro::tims_test
