// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/metrics/paired_test.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/support/pair_results.h"
#include "tests/support/random_problems.h"

namespace quatro::paired_test_test {
namespace {

// 2 sum C(n, k) / 2^n in integers, by Pascal's triangle.
double McNemarByPascal(long b, long c) {
  const auto n = static_cast<std::size_t>(b + c);
  std::vector<double> row = {1.0};
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<double> next(row.size() + 1, 1.0);
    for (std::size_t k = 1; k < row.size(); ++k) {
      next[k] = row[k - 1] + row[k];
    }
    row = next;
  }
  double sum = 0.0;
  for (long k = 0; k <= std::min(b, c); ++k) {
    sum += row[static_cast<std::size_t>(k)];
  }
  return std::min(1.0, std::ldexp(2.0 * sum, -static_cast<int>(n)));
}

TEST(McNemarP, IsByHand) {
  EXPECT_NEAR(McNemarP(0, 5), 2.0 / 32.0, 1e-15);
  EXPECT_NEAR(McNemarP(6, 1), 2.0 * 8.0 / 128.0, 1e-15);
  EXPECT_NEAR(McNemarP(2, 10), 2.0 * (1 + 12 + 66) / 4096.0, 1e-15);
  EXPECT_EQ(McNemarP(0, 0), 1.0);
  EXPECT_EQ(McNemarP(4, 4), 1.0);
}

TEST(McNemarP, IsTheSumOfBinomials) {
  for (long b = 0; b <= 25; ++b) {
    for (long c = 0; c <= 25; ++c) {
      EXPECT_NEAR(McNemarP(b, c), McNemarByPascal(b, c), 1e-13);
      EXPECT_EQ(McNemarP(b, c), McNemarP(c, b));
    }
  }
}

TEST(McNemarP, OfManyPairsNeitherOverflowsNorVanishes) {
  // The normal approximation with continuity correction, z = (|b - c| - 1) /
  // sqrt(n).
  const double z = (200.0 - 1.0) / std::sqrt(10000.0);
  EXPECT_NEAR(McNemarP(4900, 5100), std::erfc(z / std::sqrt(2.0)), 1e-4);
  EXPECT_GE(McNemarP(0, 5000), 0.0);
  EXPECT_LT(McNemarP(0, 5000), 1e-300);
}

// Darwin's plants, crossed minus self-fertilized: Fisher counted 863 of 2^15
// sums of at least 314. ("The Design of Experiments", section 21.)
TEST(SignFlipP, OfDarwinsPlantsIsFishers) {
  const std::vector<double> d = {
      49, -67, 8, 16, 6, 23, 28, 41, 14, 29, 56, 24, 75, 60, -48};
  EXPECT_DOUBLE_EQ(SignFlipP(d, {.max_enumerated = 15}), 2.0 * 863 / 32768);
  // Random draws, within four standard deviations.
  const double p = 2.0 * 863 / 32768;
  EXPECT_NEAR(SignFlipP(d, {.max_enumerated = 0, .num_draws = 20000}),
              p,
              4.0 * std::sqrt(p / 20000));
}

TEST(SignFlipP, IsByHand) {
  EXPECT_EQ(SignFlipP({}), 1.0);
  EXPECT_EQ(SignFlipP({0.0, 0.0}), 1.0);
  EXPECT_EQ(SignFlipP({3.0}), 1.0);
  EXPECT_EQ(SignFlipP({1.0, 2.0}), 0.5);        // 3, 1, -1, -3
  EXPECT_EQ(SignFlipP({1.0, 0.0, 2.0}), 0.5);   // A tie has no effect.
  EXPECT_EQ(SignFlipP({0.1, 0.2, 0.3}), 0.25);  // Sums with rounding.
  EXPECT_EQ(SignFlipP({-0.1, -0.2, 0.3}), 1.0);
  EXPECT_EQ(SignFlipP({5.0, 4.0, -1.0}), 0.5);  // 10 twice and 8 twice, of 8.
}

// More differences than the draw has bits (64).
TEST(SignFlipP, OfManyClearDifferencesIsTheLeastThereIs) {
  EXPECT_EQ(SignFlipP(std::vector<double>(150, 1.0), {.num_draws = 999}),
            1.0 / 1000.0);
  std::vector<double> even(150, 1.0);
  for (std::size_t i = 0; i < even.size(); i += 2) even[i] = -1.0;
  EXPECT_EQ(SignFlipP(even), 1.0);
}

// The sum of 200 random signs has standard deviation sqrt(200).
TEST(SignFlipP, OfManyPairsIsTheNormalLaw) {
  std::vector<double> d(200, 1.0);
  for (std::size_t i = 0; i < 86; ++i) d[i] = -1.0;  // Sum 28.
  const double z = 27.0 / std::sqrt(200.0);
  EXPECT_NEAR(SignFlipP(d), std::erfc(z / std::sqrt(2.0)), 0.01);
}

TEST(SignFlipP, AlarmsAsRarelyAsItSays) {
  int num_alarms = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    Random random(seed);
    std::vector<double> d(9);
    for (double& difference : d) difference = RandomNormal(random);
    num_alarms += SignFlipP(d) <= 0.1;
  }
  // 51 of 512 signs, two-sided: 9.77 %, and four standard deviations.
  EXPECT_NEAR(num_alarms, 39, 24);
}

TEST(SignFlipOptions, ErrorNamesTheField) {
  std::string error;
  EXPECT_TRUE(SignFlipOptions{}.IsValid(&error));
  EXPECT_FALSE(SignFlipOptions{.max_enumerated = 25}.IsValid(&error));
  EXPECT_THAT(error, ::testing::HasSubstr("max_enumerated = 25"));
  EXPECT_FALSE(SignFlipOptions{.num_draws = 0}.IsValid(&error));
  EXPECT_THAT(error, ::testing::HasSubstr("num_draws = 0"));
}

TEST(ComparePaired, CountsPairsOfBothMethods) {
  auto elsewhere = ResultOff("b", "1", 9.0, 90.0);
  elsewhere.bin = "other";
  const std::vector<PairResult> results = {
      ResultOff("a", "1", 0.1, 1.0),
      ResultOff("a", "2", 0.1, 1.0),
      ResultOff("a", "3", 5.0, 1.0),
      ResultWithoutAnswer("a", "4"),
      ResultOff("a", "5", 0.1, 1.0),  // b has no such pair.
      UnreadableResult("a", "6"),
      ResultApart("a", "7", "registered"),
      elsewhere,
      ResultApart("b", "7", "ambiguous"),
      UnreadableResult("b", "6"),
      ResultOff("b", "4", 0.3, 1.0),
      ResultOff("b", "3", 0.2, 3.0),
      ResultOff("b", "2", 4.0, 20.0),
      ResultOff("b", "1", 0.3, 2.0)};
  const SuccessLimit limit = UsualLimits()[0];
  const PairedComparison comparison = ComparePaired(results, "a", "b", limit);
  EXPECT_EQ(comparison.num_pairs, 4);
  EXPECT_EQ(comparison.num_only_first, 1);
  EXPECT_EQ(comparison.num_only_second, 2);
  EXPECT_EQ(comparison.success_p, McNemarP(1, 2));
  EXPECT_EQ(comparison.num_both_answer, 3);
  EXPECT_NEAR(
      comparison.mean_translation_difference, (-0.2 - 3.9 + 4.8) / 3.0, 1e-12);
  EXPECT_NEAR(comparison.mean_rotation_difference,
              (-1.0 - 19.0 - 2.0) / 3.0 * M_PI / 180.0,
              1e-12);
  EXPECT_EQ(comparison.rotation_p, 0.25);
  const PairedComparison swapped = ComparePaired(results, "b", "a", limit);
  EXPECT_EQ(swapped.num_only_first, 2);
  EXPECT_EQ(swapped.success_p, comparison.success_p);
  EXPECT_EQ(swapped.translation_p, comparison.translation_p);
  EXPECT_NEAR(swapped.mean_translation_difference,
              -comparison.mean_translation_difference,
              1e-15);
}

TEST(ComparePaired, OfNoCommonPairsTellsNothing) {
  const PairedComparison comparison =
      ComparePaired({ResultOff("a", "1", 0.1, 1.0)}, "a", "b", {2.0, 0.2});
  EXPECT_EQ(comparison.num_pairs, 0);
  EXPECT_EQ(comparison.success_p, 1.0);
  EXPECT_EQ(comparison.translation_p, 1.0);
}

}  // namespace
}  // namespace quatro::paired_test_test
