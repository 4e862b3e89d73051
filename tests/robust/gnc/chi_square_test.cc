// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/gnc/chi_square.h"

#include <gtest/gtest.h>

#include <cmath>

#include "features/base/random.h"

namespace quatro::chi_square_test {
namespace {

// Upper critical values as printed in NIST/SEMATECH, e-Handbook of Statistical
// Methods, 1.3.6.7.4.
struct Entry {
  int degrees_of_freedom;
  double p90, p95, p975, p99, p999;
};
constexpr Entry kTable[] = {
    {1, 2.706, 3.841, 5.024, 6.635, 10.828},
    {2, 4.605, 5.991, 7.378, 9.210, 13.816},
    {3, 6.251, 7.815, 9.348, 11.345, 16.266},
    {4, 7.779, 9.488, 11.143, 13.277, 18.467},
    {5, 9.236, 11.070, 12.833, 15.086, 20.515},
    {6, 10.645, 12.592, 14.449, 16.812, 22.458},
    {7, 12.017, 14.067, 16.013, 18.475, 24.322},
    {10, 15.987, 18.307, 20.483, 23.209, 29.588},
    {15, 22.307, 24.996, 27.488, 30.578, 37.697},
    {30, 40.256, 43.773, 46.979, 50.892, 59.703},
    {100, 118.498, 124.342, 129.561, 135.807, 149.449},
};

TEST(ChiSquareQuantile, IsThatOfThePrintedTable) {
  for (const Entry& entry : kTable) {
    const int n = entry.degrees_of_freedom;
    EXPECT_NEAR(ChiSquareQuantile(0.9, n), entry.p90, 5.01e-4) << n;
    EXPECT_NEAR(ChiSquareQuantile(0.95, n), entry.p95, 5.01e-4) << n;
    EXPECT_NEAR(ChiSquareQuantile(0.975, n), entry.p975, 5.01e-4) << n;
    EXPECT_NEAR(ChiSquareQuantile(0.99, n), entry.p99, 5.01e-4) << n;
    EXPECT_NEAR(ChiSquareQuantile(0.999, n), entry.p999, 5.01e-4) << n;
  }
}

// std::lgamma writes to the global `signgam`, a race between two threads.
TEST(ChiSquareQuantile, WritesNoGlobal) {
  signgam = 7;
  ChiSquareQuantile(0.99, 6);
  EXPECT_EQ(signgam, 7);
}

TEST(ChiSquareQuantile, OfTwoIsALogarithm) {
  for (const double p : {1e-6, 0.1, 0.5, 0.9, 1.0 - 1e-6, 1.0 - 1e-12}) {
    EXPECT_NEAR(ChiSquareQuantile(p, 2), -2.0 * std::log1p(-p), 1e-3 * p) << p;
  }
}

// The sum of n squares of standard normal numbers, by simulation.
TEST(ChiSquareQuantile, IsExceededByItsShareOfDraws) {
  constexpr int kNumDraws = 200000;
  for (const int n : {1, 2, 3, 6}) {
    Random random(static_cast<std::uint64_t>(n));
    const double bound = ChiSquareQuantile(0.8, n);
    int num_above = 0;
    for (int i = 0; i < kNumDraws; ++i) {
      double sum = 0.0;
      for (int k = 0; k < n; ++k) {
        const double radius = std::sqrt(-2.0 * std::log1p(-random.Uniform()));
        const double x = radius * std::cos(2.0 * M_PI * random.Uniform());
        sum += x * x;
      }
      if (sum > bound) ++num_above;
    }
    // Five standard deviations.
    EXPECT_NEAR(num_above / double{kNumDraws}, 0.2, 0.0045) << n;
  }
}

TEST(ChiSquareBound, GrowsWithTheDimension) {
  EXPECT_NEAR(ChiSquareBound(0.99, 1), 2.576, 1e-3);
  EXPECT_NEAR(ChiSquareBound(0.99, 3), 3.368, 1e-3);
  EXPECT_NEAR(ChiSquareBound(0.99, 6), 4.100, 1e-3);
}

}  // namespace
}  // namespace quatro::chi_square_test
