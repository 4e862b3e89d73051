// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/matching.h"
#include "features/tuple_test.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "features/base/simd.h"
#include "tests/support/print_match.h"
#include "tests/support/random_problems.h"

namespace quatro::matching_test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::IsSubsetOf;

// Uniform in [0, 100), like bins of a histogram. No two distances tie.
Fpfh RandomDescriptors(Eigen::Index n, std::uint64_t seed) {
  Random random(seed);
  return Fpfh::NullaryExpr(kFpfhSize, n, [&] {
    return static_cast<float>(100.0 * random.Uniform());
  });
}

// Few different descriptors with bins of 0 or 1: most distances tie, and all
// are exact.
Fpfh TyingDescriptors(Eigen::Index n, std::uint64_t seed) {
  Random random(seed);
  Fpfh descriptors = Fpfh::Zero(kFpfhSize, n);
  if (n == 0) return descriptors;  // Empty rows have no address.
  descriptors.bottomRows<5>() = Fpfh::NullaryExpr(kFpfhSize, n, [&] {
                                  return static_cast<float>(random.Below(2));
                                }).bottomRows<5>();
  return descriptors;
}

// If distances are equal, the lower index wins. All-zero descriptors match
// nothing: -1.
std::vector<int> BruteForceNearest(const Fpfh& queries, const Fpfh& targets) {
  std::vector<int> nearest;
  for (const auto query : queries.colwise()) {
    double least = std::numeric_limits<double>::infinity();
    nearest.push_back(-1);
    if (query.isZero(0.0f)) continue;
    for (int j = 0; j < targets.cols(); ++j) {
      if (targets.col(j).isZero(0.0f)) continue;
      const double d2 = (targets.col(j) - query).cast<double>().squaredNorm();
      if (d2 < least) {
        least = d2;
        nearest.back() = j;
      }
    }
  }
  return nearest;
}

std::vector<Match> BruteForceMatches(const Fpfh& source, const Fpfh& target) {
  const std::vector<int> target_of = BruteForceNearest(source, target);
  const std::vector<int> source_of = BruteForceNearest(target, source);
  std::vector<Match> matches;
  for (int i = 0; i < source.cols(); ++i) {
    const int j = target_of[static_cast<std::size_t>(i)];
    if (j >= 0 && source_of[static_cast<std::size_t>(j)] == i) {
      matches.push_back({i, j});
    }
  }
  return matches;
}

// The reference in single precision, summed term by term. The matches must be
// equal to it bit for bit for all finite descriptors, and ties must go to the
// lower index.
std::vector<int> SinglePrecisionNearest(const Fpfh& queries,
                                        const Fpfh& targets) {
  const auto is_descriptor = [](const auto& x) {
    return !x.isZero(0.0f) && x.allFinite();
  };
  std::vector<int> nearest;
  for (const auto query : queries.colwise()) {
    float least = std::numeric_limits<float>::infinity();
    nearest.push_back(-1);
    if (!is_descriptor(query)) continue;
    for (int j = 0; j < targets.cols(); ++j) {
      if (!is_descriptor(targets.col(j))) continue;
      float sum = 0.0f;
      for (int d = 0; d < kFpfhSize; ++d) {
        const float difference = targets(d, j) - query[d];
        sum += difference * difference;
      }
      if (sum < least) {
        least = sum;
        nearest.back() = j;
      }
    }
  }
  return nearest;
}

std::vector<Match> SinglePrecisionMatches(const Fpfh& source,
                                          const Fpfh& target) {
  const std::vector<int> target_of = SinglePrecisionNearest(source, target);
  const std::vector<int> source_of = SinglePrecisionNearest(target, source);
  std::vector<Match> matches;
  for (int i = 0; i < source.cols(); ++i) {
    const int j = target_of[static_cast<std::size_t>(i)];
    if (j >= 0 && source_of[static_cast<std::size_t>(j)] == i) {
      matches.push_back({i, j});
    }
  }
  return matches;
}

// Descriptors like those of surfaces: near one of a few kinds, spread along few
// directions, with copies and with pairs that differ by little more than
// rounding.
Fpfh ClusteredDescriptors(Eigen::Index n, std::uint64_t seed) {
  const Fpfh kinds = RandomDescriptors(5, 100);
  const Fpfh directions = RandomDescriptors(3, 101).array() - 50.0f;
  Random random(seed);
  Fpfh descriptors(kFpfhSize, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto last = static_cast<std::uint64_t>(std::max<Eigen::Index>(1, i));
    auto x = descriptors.col(i);
    if (i > 0 && random.Below(4) == 0) {
      x = descriptors.col(static_cast<Eigen::Index>(random.Below(last)));
      if (random.Below(2) == 0) x *= 1.0f + 1e-7f;
      continue;
    }
    x = kinds.col(static_cast<Eigen::Index>(random.Below(5)));
    for (int axis = 0; axis < 3; ++axis) {
      x += static_cast<float>(random.Uniform()) * directions.col(axis);
    }
  }
  return descriptors;
}

std::vector<SimdLevel> Levels() {
  std::vector<SimdLevel> levels;
  for (const SimdLevel level :
       {SimdLevel::kBaseline, SimdLevel::kAvx2, SimdLevel::kAvx512}) {
    if (level <= BestSimdLevel()) levels.push_back(level);
  }
  return levels;
}

void ExpectSinglePrecisionMatches(const Fpfh& source, const Fpfh& target) {
  const auto expected = SinglePrecisionMatches(source, target);
  for (const SimdLevel level : Levels()) {
    EXPECT_EQ(MatchMutualNearest(source, target, 1, level), expected)
        << "level " << static_cast<int>(level);
  }
}

// Sizes around multiples of the 16 targets of a tile.
constexpr Eigen::Index kSizes[] = {
    0, 1, 2, 3, 4, 5, 15, 16, 17, 31, 63, 64, 65, 130};

TEST(MatchMutualNearest, AgreesWithBruteForce) {
  std::size_t num_matches = 0;
  for (const Eigen::Index m : kSizes) {
    for (const Eigen::Index n : kSizes) {
      const Fpfh source = RandomDescriptors(m, 1);
      const Fpfh target = RandomDescriptors(n, 2);
      const auto matches = MatchMutualNearest(source, target, 1);
      ASSERT_EQ(matches, BruteForceMatches(source, target))
          << m << " and " << n << " descriptors";
      num_matches += matches.size();
    }
  }
  EXPECT_GT(num_matches, 1000u);
}

TEST(MatchMutualNearest, OfEqualDistancesTheLowerIndexWins) {
  for (const Eigen::Index m : kSizes) {
    for (const Eigen::Index n : kSizes) {
      for (const std::uint64_t seed : {1, 3}) {
        const Fpfh source = TyingDescriptors(m, seed);
        const Fpfh target = TyingDescriptors(n, seed + 1);
        ASSERT_EQ(MatchMutualNearest(source, target, 1),
                  BruteForceMatches(source, target))
            << m << " and " << n << " descriptors";
      }
    }
  }
  const Fpfh same = Fpfh::Ones(kFpfhSize, 50);
  EXPECT_THAT(MatchMutualNearest(same, same, 1), ElementsAre(Match{0, 0}));
}

TEST(MatchMutualNearest, IsSinglePrecisionToTheLastBitByAnyInstructions) {
  // More than the 256 of one box, and fewer than in two.
  for (const auto& [m, n] :
       {std::pair{900, 700}, {700, 900}, {257, 300}, {30, 511}}) {
    SCOPED_TRACE(m);
    const Fpfh source = ClusteredDescriptors(m, 1);
    const Fpfh target = ClusteredDescriptors(n, 2);
    ExpectSinglePrecisionMatches(source, target);
    EXPECT_GT(MatchMutualNearest(source, target, 1).size(), 10u);
  }
  ExpectSinglePrecisionMatches(TyingDescriptors(700, 1),
                               TyingDescriptors(700, 2));
  ExpectSinglePrecisionMatches(RandomDescriptors(500, 1),
                               RandomDescriptors(500, 2));
}

TEST(MatchMutualNearest, SquaresMayVanishOrOverflow) {
  const Fpfh source = ClusteredDescriptors(600, 1);
  const Fpfh target = ClusteredDescriptors(500, 2);
  for (const float scale : {1e-40f,
                            1e-25f,
                            1e-24f,
                            3e-24f,
                            1e-23f,
                            1e-22f,
                            1e-20f,
                            1e-10f,
                            1e10f,
                            1e14f,
                            1e17f,
                            1e30f}) {
    SCOPED_TRACE(scale);
    ExpectSinglePrecisionMatches(scale * source, scale * target);
  }
}

TEST(MatchMutualNearest, WhatIsNotFiniteMatchesNothing) {
  Fpfh source = ClusteredDescriptors(300, 1);
  Fpfh target = ClusteredDescriptors(300, 2);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const float bad : {nan, -nan, std::numeric_limits<float>::infinity()}) {
    source(7, 10) = bad;
    target(32, 11) = bad;
    source.col(12).setConstant(bad);
    ExpectSinglePrecisionMatches(source, target);
  }
}

TEST(MatchMutualNearest, UndoesAPermutation) {
  const Fpfh source = RandomDescriptors(300, 1);
  const auto order = RandomPermutation(300, 2);
  const auto matches = MatchMutualNearest(source, source(Eigen::all, order), 1);
  ASSERT_EQ(matches.size(), 300u);
  for (std::size_t i = 0; i < matches.size(); ++i) {
    EXPECT_EQ(matches[i].source, static_cast<int>(i));
    EXPECT_EQ(order[static_cast<std::size_t>(matches[i].target)],
              matches[i].source);
  }
}

TEST(MatchMutualNearest, SwappingTheCloudsSwapsTheMatches) {
  const auto expect_swapped = [](const Fpfh& source, const Fpfh& target) {
    std::vector<Match> swapped = MatchMutualNearest(target, source, 1);
    for (Match& match : swapped) std::swap(match.source, match.target);
    std::sort(
        swapped.begin(), swapped.end(), [](const Match& a, const Match& b) {
          return a.source < b.source;
        });
    EXPECT_EQ(swapped, MatchMutualNearest(source, target, 1));
    EXPECT_FALSE(swapped.empty());
  };
  expect_swapped(RandomDescriptors(203, 1), RandomDescriptors(98, 2));
  expect_swapped(TyingDescriptors(203, 1), TyingDescriptors(98, 2));
}

TEST(MatchMutualNearest, ZeroDescriptorsMatchNothing) {
  // All-zero descriptors match nothing, even if zero is the nearest or is in
  // both sets.
  Fpfh source = RandomDescriptors(50, 1);
  Fpfh target = 1e-3f * RandomDescriptors(70, 2);
  for (const Eigen::Index i : {0, 3, 16, 49}) source.col(i).setZero();
  for (const Eigen::Index j : {0, 15, 16, 69}) target.col(j).setZero();
  const auto matches = MatchMutualNearest(source, target, 1);
  EXPECT_EQ(matches, BruteForceMatches(source, target));
  EXPECT_FALSE(matches.empty());
  for (const auto& [i, j] : matches) {
    EXPECT_FALSE(source.col(i).isZero(0.0f)) << "source " << i;
    EXPECT_FALSE(target.col(j).isZero(0.0f)) << "target " << j;
  }
  const Fpfh none = Fpfh::Zero(kFpfhSize, 20);
  EXPECT_THAT(MatchMutualNearest(none, none, 1), IsEmpty());
  EXPECT_THAT(MatchMutualNearest(none, target, 1), IsEmpty());
  EXPECT_THAT(MatchMutualNearest(source, none, 1), IsEmpty());
}

// Each round is the mutual matches of what the rounds before left.
TEST(MatchInRounds, MatchesWhatIsLeft) {
  const Fpfh source = RandomDescriptors(150, 3);
  const Fpfh target = RandomDescriptors(120, 4);
  Fpfh left_source = source;
  Fpfh left_target = target;
  std::vector<Match> expected;
  for (int num_rounds = 0; num_rounds <= 4; ++num_rounds) {
    EXPECT_EQ(MatchInRounds({}, source, target, num_rounds, 1), expected)
        << num_rounds;
    EXPECT_EQ(MatchInRounds(expected, source, target, 4 - num_rounds, 1),
              MatchInRounds({}, source, target, 4, 1))
        << num_rounds;
    for (const Match& match : MatchMutualNearest(left_source, left_target, 1)) {
      expected.push_back(match);
      left_source.col(match.source).setZero();
      left_target.col(match.target).setZero();
    }
  }
  std::set<std::int32_t> sources, targets;
  for (const Match& match : MatchInRounds({}, source, target, 4, 1)) {
    EXPECT_TRUE(sources.insert(match.source).second);
    EXPECT_TRUE(targets.insert(match.target).second);
  }
  EXPECT_GT(sources.size(), MatchMutualNearest(source, target, 1).size());
}

TEST(MatchMutualNearest, DoesNotDependOnTheNumberOfThreads) {
  const Fpfh source = RandomDescriptors(1001, 1);
  const Fpfh target = RandomDescriptors(777, 2);
  const auto one = MatchMutualNearest(source, target, 1);
  EXPECT_EQ(one, BruteForceMatches(source, target));
  for (const int num_threads : {0, 2, 3, 8}) {
    EXPECT_EQ(MatchMutualNearest(source, target, num_threads), one)
        << num_threads << " threads";
  }
}

// Matches of a cloud with its transformed copy. The first matches get incorrect
// partners.
class TupleTestTest : public ::testing::Test {
 protected:
  static constexpr int kNumMatches = 300;

  static std::vector<Match> Matches() {
    std::vector<Match> matches;
    for (std::int32_t i = 0; i < kNumMatches; ++i) matches.push_back({i, i});
    return matches;
  }

  Points WithOutliers(int num_outliers, std::uint64_t seed) const {
    Points target = target_;
    target.leftCols(num_outliers) =
        RandomPoints(num_outliers, 20.0, 100 + seed);
    return target;
  }

  const Points source_ = RandomPoints(kNumMatches, 20.0, 1);
  const Points target_ = (RandomRotation(2) * source_).colwise() +
                         Eigen::Vector3d(30.0, -20.0, 5.0);
  const std::vector<Match> matches_ = Matches();
  const TupleTestOptions options_{};
};

TEST_F(TupleTestTest, RigidMatchesAllPass) {
  for (const std::size_t n : {3, 4, 10, 300}) {
    const std::vector<Match> matches(
        matches_.begin(), matches_.begin() + static_cast<std::ptrdiff_t>(n));
    EXPECT_EQ(FilterByTupleTest(matches, source_, target_, options_), matches)
        << n << " matches";
  }
}

TEST_F(TupleTestTest, ScaledMatchesPassUpToTheScale) {
  for (const double scale : {0.5, 0.9, 0.95}) {
    TupleTestOptions options;
    options.scale = scale;
    for (const double within : {scale + 0.01, 1.0, 1.0 / (scale + 0.01)}) {
      EXPECT_EQ(FilterByTupleTest(matches_, source_, within * target_, options),
                matches_)
          << "stretched by " << within << " at scale " << scale;
    }
    for (const double beyond : {scale - 0.01, 1.0 / (scale - 0.01)}) {
      EXPECT_THAT(
          FilterByTupleTest(matches_, source_, beyond * target_, options),
          IsEmpty())
          << "stretched by " << beyond << " at scale " << scale;
    }
  }
}

TEST_F(TupleTestTest, MostOutliersFail) {
  // Half of the matches are outliers. They pass only by chance, each in one of
  // the 300 triples it is drawn into. Each inlier is in 75 triples of inliers
  // only.
  constexpr int kNumOutliers = kNumMatches / 2;
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    const auto kept = FilterByTupleTest(
        matches_, source_, WithOutliers(kNumOutliers, seed), options_);
    const auto num_wrong =
        std::count_if(kept.begin(), kept.end(), [&](const Match& match) {
          return match.source < kNumOutliers;
        });
    EXPECT_EQ(static_cast<int>(kept.size() - num_wrong),
              kNumMatches - kNumOutliers)
        << "seed " << seed;
    EXPECT_LT(num_wrong, kNumOutliers / 2) << "seed " << seed;
  }
}

TEST_F(TupleTestTest, KeepsTheOrderOfTheMatches) {
  std::vector<Match> shuffled;
  for (const Eigen::Index i : RandomPermutation(kNumMatches, 3)) {
    shuffled.push_back(matches_[static_cast<std::size_t>(i)]);
  }
  const Points target = WithOutliers(100, 1);
  const auto kept = FilterByTupleTest(shuffled, source_, target, options_);
  ASSERT_GT(kept.size(), 150u);
  ASSERT_LT(kept.size(), shuffled.size());
  auto next = shuffled.begin();
  for (const Match& match : kept) {
    next = std::find(next, shuffled.end(), match);
    ASSERT_NE(next, shuffled.end()) << "match of " << match.source;
    ++next;
  }
}

TEST_F(TupleTestTest, DependsOnTheSeedAlone) {
  const Points target = WithOutliers(250, 1);
  const auto with_seed = [&](std::uint64_t seed) {
    TupleTestOptions options;
    options.seed = seed;
    options.num_triples_per_match = 10;
    return FilterByTupleTest(matches_, source_, target, options);
  };
  EXPECT_EQ(with_seed(1), with_seed(1));
  EXPECT_NE(with_seed(1), with_seed(2));
}

TEST_F(TupleTestTest, DoesNotDependOnTheNumberOfThreads) {
  const Points target = WithOutliers(250, 1);
  for (const std::int64_t max_num_triples : {0, 20}) {
    TupleTestOptions options;
    options.max_num_triples = max_num_triples;
    const auto expected = FilterByTupleTest(matches_, source_, target, options);
    EXPECT_LT(expected.size(), matches_.size());
    for (const int num_threads : {0, 2, 3}) {
      options.num_threads = num_threads;
      EXPECT_EQ(FilterByTupleTest(matches_, source_, target, options), expected)
          << num_threads << " threads";
    }
  }
}

TEST_F(TupleTestTest, MoreTriplesOfTheSameSeedPassMore) {
  const Points target = WithOutliers(250, 1);
  std::vector<Match> before;
  for (const int num_triples : {1, 3, 10, 30, 100}) {
    TupleTestOptions options;
    options.num_triples_per_match = num_triples;
    const auto kept = FilterByTupleTest(matches_, source_, target, options);
    EXPECT_THAT(before, IsSubsetOf(kept)) << num_triples << " triples";
    before = kept;
  }
  EXPECT_FALSE(before.empty());
}

TEST_F(TupleTestTest, StopsAtTheMostTriples) {
  const Points target = WithOutliers(100, 1);
  const auto with_most = [&](std::int64_t max_num_triples) {
    TupleTestOptions options;
    options.max_num_triples = max_num_triples;
    return FilterByTupleTest(matches_, source_, target, options);
  };
  const auto all = with_most(0);
  EXPECT_EQ(with_most(1).size(), 3u);
  std::size_t before = 3;
  for (const std::int64_t most : {5, 20, 60}) {
    const auto kept = with_most(most);
    EXPECT_GT(kept.size(), before);
    EXPECT_LE(kept.size(), static_cast<std::size_t>(3 * most));
    EXPECT_LT(kept.size(), all.size());
    EXPECT_THAT(kept, IsSubsetOf(all));
    before = kept.size();
  }
  EXPECT_EQ(with_most(1'000'000), all);
}

TEST(TupleTestOptions, ThreadsMustNotBeNegative) {
  TupleTestOptions options;
  options.num_threads = -1;
  std::string error;
  EXPECT_FALSE(options.IsValid(&error));
  EXPECT_THAT(error, HasSubstr("num_threads = -1"));
}

TEST(TupleTestOptions, MostTriplesMustNotBeNegative) {
  TupleTestOptions options;
  options.max_num_triples = -1;
  std::string error;
  EXPECT_FALSE(options.IsValid(&error));
  EXPECT_THAT(error, HasSubstr("max_num_triples = -1"));
}

TEST_F(TupleTestTest, FewerThanThreeMatchesAreReturnedAsTheyAre) {
  const std::vector<Match> wrong = {{0, 5}, {1, 200}};
  EXPECT_EQ(FilterByTupleTest(wrong, source_, target_, options_), wrong);
  EXPECT_THAT(FilterByTupleTest({wrong[0]}, source_, target_, options_),
              ElementsAre(wrong[0]));
  EXPECT_THAT(FilterByTupleTest({}, source_, target_, options_), IsEmpty());
}

TEST_F(TupleTestTest, IdenticalPointsAllFail) {
  const Points same = Points::Ones(3, kNumMatches);
  EXPECT_THAT(FilterByTupleTest(matches_, same, same, options_), IsEmpty());
  EXPECT_THAT(FilterByTupleTest(matches_, same, target_, options_), IsEmpty());
  EXPECT_THAT(FilterByTupleTest(matches_, source_, same, options_), IsEmpty());
  const std::vector<Match> repeated(10, Match{7, 7});
  EXPECT_THAT(FilterByTupleTest(repeated, source_, target_, options_),
              IsEmpty());
}

TEST(TupleTestOptions, ScaleMustBeBetweenZeroAndOne) {
  TupleTestOptions options;
  std::string error = "left over";
  EXPECT_TRUE(options.IsValid(&error)) << error;
  EXPECT_THAT(error, IsEmpty());
  for (const double bad : {0.0,
                           1.0,
                           -0.5,
                           1.5,
                           std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity()}) {
    options.scale = bad;
    EXPECT_FALSE(options.IsValid(&error)) << bad;
    EXPECT_THAT(error, AllOf(HasSubstr("scale"), HasSubstr("(0, 1)")));
  }
}

TEST(TupleTestOptions, NumberOfTriplesMustBePositive) {
  for (const int bad : {0, -1}) {
    TupleTestOptions options;
    options.num_triples_per_match = bad;
    std::string error;
    EXPECT_FALSE(options.IsValid(&error)) << bad;
    EXPECT_THAT(error, HasSubstr("num_triples_per_match = "));
  }
}

}  // namespace
}  // namespace quatro::matching_test
