// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/metrics/intervals.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "tests/support/random_problems.h"

namespace quatro::intervals_test {
namespace {

std::vector<double> NormalValues(int n, std::uint64_t seed) {
  Random random(seed);
  std::vector<double> values(static_cast<std::size_t>(n));
  for (double& value : values) value = 3.0 + RandomNormal(random);
  return values;
}

TEST(NormalQuantile, IsThatOfTheTables) {
  EXPECT_NEAR(NormalQuantile(0.975), 1.959963984540054, 1e-12);
  EXPECT_NEAR(NormalQuantile(0.995), 2.575829303548901, 1e-12);
  EXPECT_NEAR(NormalQuantile(0.5), 0.0, 1e-15);
  for (const double p : {1e-10, 0.01, 0.3}) {
    EXPECT_NEAR(0.5 * std::erfc(-NormalQuantile(p) / std::sqrt(2.0)),
                p,
                1e-12 * p + 1e-18);
  }
}

// Newcombe, "Two-sided confidence intervals for the single proportion",
// Statistics in Medicine 1998, table I, method 3.
TEST(WilsonInterval, IsThatOfNewcombesTable) {
  const auto expect = [](long k, long n, double low, double high) {
    const Interval interval = WilsonInterval(k, n);
    EXPECT_NEAR(interval.low, low, 5e-5) << k << "/" << n;
    EXPECT_NEAR(interval.high, high, 5e-5) << k << "/" << n;
  };
  expect(81, 263, 0.2553, 0.3662);
  expect(15, 148, 0.0624, 0.1605);
  expect(0, 20, 0.0000, 0.1611);
  expect(1, 29, 0.0061, 0.1718);
}

// Both ends solve (p - q)^2 = z^2 q (1 - q) / n.
TEST(WilsonInterval, EndsSolveTheEquation) {
  for (long n = 1; n <= 40; n += 3) {
    for (long k = 0; k <= n; ++k) {
      const Interval interval = WilsonInterval(k, n, 0.9);
      const double p = static_cast<double>(k) / static_cast<double>(n);
      const double z = NormalQuantile(0.95);
      for (const double q : {interval.low, interval.high}) {
        EXPECT_NEAR((p - q) * (p - q),
                    z * z * q * (1.0 - q) / static_cast<double>(n),
                    1e-12);
      }
      EXPECT_LE(interval.low, p);
      EXPECT_GE(interval.high, p);
      EXPECT_LT(interval.low, interval.high);
      const Interval mirrored = WilsonInterval(n - k, n, 0.9);
      EXPECT_NEAR(mirrored.low, 1.0 - interval.high, 1e-12);
    }
  }
}

TEST(WilsonInterval, OfNothingIsEverything) {
  EXPECT_EQ(WilsonInterval(0, 0).low, 0.0);
  EXPECT_EQ(WilsonInterval(0, 0).high, 1.0);
}

// The share of all outcomes whose interval contains the true rate, from their
// binomial probabilities.
TEST(WilsonInterval, CoversAsOftenAsItSays) {
  const long n = 50;
  double mean = 0.0;
  int num_rates = 0;
  for (double rate = 0.05; rate < 0.96; rate += 0.01, ++num_rates) {
    double covered = 0.0;
    for (long k = 0; k <= n; ++k) {
      const Interval interval = WilsonInterval(k, n);
      if (rate < interval.low || rate > interval.high) continue;
      const auto kd = static_cast<double>(k), nd = static_cast<double>(n);
      covered += std::exp(std::lgamma(nd + 1) - std::lgamma(kd + 1) -
                          std::lgamma(nd - kd + 1) + kd * std::log(rate) +
                          (nd - kd) * std::log1p(-rate));
    }
    EXPECT_GT(covered, 0.90) << rate;
    mean += covered;
  }
  EXPECT_NEAR(mean / num_rates, 0.95, 0.01);
}

TEST(Statistics, AreByHand) {
  EXPECT_EQ(Mean({1.0, 2.0, 6.0}), 3.0);
  EXPECT_EQ(Median({6.0, 1.0, 2.0}), 2.0);
  EXPECT_EQ(Median({6.0, 1.0, 2.0, 4.0}), 3.0);
  EXPECT_EQ(Median({7.0}), 7.0);
  EXPECT_EQ(Quantile({10.0, 0.0, 20.0}, 0.25), 5.0);
  EXPECT_EQ(Quantile({10.0, 0.0, 20.0}, 0.0), 0.0);
  EXPECT_EQ(Quantile({10.0, 0.0, 20.0}, 1.0), 20.0);
  EXPECT_FALSE(Mean({}));
  EXPECT_FALSE(Median({}));
  EXPECT_FALSE(Quantile({}, 0.5));
}

TEST(Statistics, QuantileIsThatOfTheSortedValues) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto values = NormalValues(1 + static_cast<int>(seed), seed);
    auto sorted = values;
    std::sort(sorted.begin(), sorted.end());
    const auto last = static_cast<double>(sorted.size() - 1);
    for (std::size_t i = 0; i < sorted.size() && last > 0.0; ++i) {
      EXPECT_NEAR(
          *Quantile(values, static_cast<double>(i) / last), sorted[i], 1e-9);
    }
  }
}

TEST(Bootstrap, OfNoValueIsNoneAndOfOneIsIt) {
  EXPECT_FALSE(BootstrapMean({}));
  EXPECT_FALSE(BootstrapMedian({}));
  EXPECT_EQ(BootstrapMean({4.0})->low, 4.0);
  EXPECT_EQ(BootstrapMedian({4.0})->high, 4.0);
}

// For two values, means of resamples are low, middle or high with probability
// 1/4, 1/2, 1/4: the 10 % quantile is low, the 30 % quantile is in the middle.
TEST(Bootstrap, OfTwoValuesIsByHand) {
  const Interval wide = *BootstrapMean({0.0, 1.0}, {.confidence = 0.8});
  EXPECT_EQ(wide.low, 0.0);
  EXPECT_EQ(wide.high, 1.0);
  const Interval narrow = *BootstrapMean({0.0, 1.0}, {.confidence = 0.4});
  EXPECT_EQ(narrow.low, 0.5);
  EXPECT_EQ(narrow.high, 0.5);
}

TEST(Bootstrap, DependsOnTheSeedAlone) {
  const auto values = NormalValues(40, 1);
  const Interval once = *BootstrapMean(values, {.seed = 3});
  const Interval again = *BootstrapMean(values, {.seed = 3});
  const Interval other = *BootstrapMean(values, {.seed = 4});
  EXPECT_EQ(once.low, again.low);
  EXPECT_EQ(once.high, again.high);
  EXPECT_NE(once.low, other.low);
}

// The width agrees with z sigma / sqrt(n) for many values.
TEST(Bootstrap, OfAMeanIsAsWideAsTheory) {
  const auto values = NormalValues(400, 1);
  const Interval interval = *BootstrapMean(values, {.num_samples = 4000});
  double variance = 0.0;
  for (const double value : values) {
    variance += (value - *Mean(values)) * (value - *Mean(values)) / 400.0;
  }
  EXPECT_NEAR(interval.high - interval.low,
              2.0 * 1.96 * std::sqrt(variance / 400.0),
              0.01);
}

void ExpectCoverage(
    const std::function<Interval(const std::vector<double>&)>& interval_of) {
  int num_covered = 0;
  const int num_rounds = 300;
  for (int round = 0; round < num_rounds; ++round) {
    const Interval interval =
        interval_of(NormalValues(30, 100 + static_cast<std::uint64_t>(round)));
    num_covered += interval.low <= 3.0 && 3.0 <= interval.high;
  }
  EXPECT_GE(num_covered, 0.90 * num_rounds);
  EXPECT_LE(num_covered, 0.98 * num_rounds);
}

TEST(Bootstrap, CoversAsOftenAsItSays) {
  ExpectCoverage([](const std::vector<double>& values) {
    return *BootstrapMean(values, {.num_samples = 300});
  });
  ExpectCoverage([](const std::vector<double>& values) {
    return *BootstrapMedian(values, {.num_samples = 300});
  });
}

TEST(BootstrapOptions, ErrorNamesTheField) {
  std::string error;
  EXPECT_TRUE(BootstrapOptions{}.IsValid(&error));
  EXPECT_FALSE(BootstrapOptions{.confidence = 1.0}.IsValid(&error));
  EXPECT_THAT(error, ::testing::HasSubstr("confidence = 1"));
  EXPECT_FALSE(BootstrapOptions{.num_samples = 0}.IsValid(&error));
  EXPECT_THAT(error, ::testing::HasSubstr("num_samples = 0"));
}

}  // namespace
}  // namespace quatro::intervals_test
