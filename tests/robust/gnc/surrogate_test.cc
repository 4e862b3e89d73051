// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/gnc/surrogate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace quatro::surrogate_test {
namespace {

// Black-Rangarajan: the weight is the minimum over w in [0, 1] of
// w r2 + Phi(w), with the outlier process Phi of each loss.
double OutlierProcess(TruncatedLeastSquares, double w, double mu) {
  return mu * (1.0 - w) / (mu + w);
}
double OutlierProcess(GemanMcClure, double w, double mu) {
  return mu * (std::sqrt(w) - 1.0) * (std::sqrt(w) - 1.0);
}
double OutlierProcess(Welsch, double w, double mu) {
  return w > 0.0 ? mu * (1.0 + w * (std::log(w) - 1.0)) : mu;
}

template <typename Surrogate>
double WeightByGridSearch(double r2, double mu, int num_steps) {
  double best_weight = 0.0;
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k <= num_steps; ++k) {
    const double w = static_cast<double>(k) / num_steps;
    const double value = w * r2 + OutlierProcess(Surrogate(), w, mu);
    if (value < least) {
      least = value;
      best_weight = w;
    }
  }
  return best_weight;
}

template <typename Surrogate>
class SurrogateTest : public ::testing::Test {};
using Surrogates =
    ::testing::Types<TruncatedLeastSquares, GemanMcClure, Welsch>;
TYPED_TEST_SUITE(SurrogateTest, Surrogates);

TYPED_TEST(SurrogateTest, WeightMinimisesResidualPlusOutlierProcess) {
  constexpr int kNumSteps = 20000;
  for (const double mu : {0.01, 0.3, 1.0, 4.0, 50.0}) {
    for (const double r2 : {0.0, 0.1, 0.5, 0.9, 1.0, 1.1, 2.0, 7.0, 200.0}) {
      EXPECT_NEAR(TypeParam::Weight(r2, mu),
                  WeightByGridSearch<TypeParam>(r2, mu, kNumSteps),
                  1.0 / kNumSteps)
          << "r2 " << r2 << ", mu " << mu;
    }
  }
}

TYPED_TEST(SurrogateTest, WeightFallsFromOneAndNeverBelowZero) {
  for (const double mu : {0.01, 1.0, 50.0}) {
    EXPECT_EQ(TypeParam::Weight(0.0, mu), 1.0) << "mu " << mu;
    double previous = 1.0;
    for (double r2 = 0.0; r2 < 300.0; r2 += 0.01) {
      const double weight = TypeParam::Weight(r2, mu);
      ASSERT_LE(weight, previous) << "r2 " << r2 << ", mu " << mu;
      ASSERT_GE(weight, 0.0) << "r2 " << r2 << ", mu " << mu;
      previous = weight;
    }
  }
}

TYPED_TEST(SurrogateTest, LossIsTheLeastOfResidualPlusOutlierProcess) {
  constexpr int kNumSteps = 10000;
  for (const double mu : {0.01, 0.3, 1.0, 4.0, 50.0, 1e4}) {
    for (const double r2 : {0.0, 0.1, 0.5, 0.9, 1.0, 1.1, 2.0, 7.0, 200.0}) {
      const double loss = TypeParam::Loss(r2, mu);
      double least = std::numeric_limits<double>::infinity();
      for (int k = 0; k <= kNumSteps; ++k) {
        const double w = static_cast<double>(k) / kNumSteps;
        const double value = w * r2 + TypeParam::OutlierProcess(w, mu);
        EXPECT_NEAR(TypeParam::OutlierProcess(w, mu),
                    OutlierProcess(TypeParam(), w, mu),
                    1e-12 * mu);
        least = std::min(least, value);
      }
      EXPECT_GE(least, loss - 1e-12 * mu) << "r2 " << r2 << ", mu " << mu;
      EXPECT_LE(least, loss + 2.0 * (r2 + 1.0) / kNumSteps)
          << "r2 " << r2 << ", mu " << mu;
      const double weight = TypeParam::Weight(r2, mu);
      EXPECT_NEAR(weight * r2 + TypeParam::OutlierProcess(weight, mu),
                  loss,
                  1e-12 * std::max(1.0, mu))
          << "r2 " << r2 << ", mu " << mu;
    }
  }
}

TYPED_TEST(SurrogateTest, WeightIsTheSlopeOfTheLoss) {
  constexpr double kStep = 1e-6;
  for (const double mu : {0.01, 0.3, 1.0, 4.0, 50.0}) {
    for (const double r2 : {0.2, 0.6, 0.95, 1.3, 2.5, 7.0, 200.0}) {
      const double slope =
          (TypeParam::Loss(r2 + kStep, mu) - TypeParam::Loss(r2 - kStep, mu)) /
          (2.0 * kStep);
      EXPECT_NEAR(TypeParam::Weight(r2, mu), slope, 1e-6)
          << "r2 " << r2 << ", mu " << mu;
    }
  }
}

TYPED_TEST(SurrogateTest, SlopeOfTheWeightIsThatOfDifferences) {
  constexpr double kStep = 1e-6;
  for (const double mu : {0.01, 0.3, 1.0, 4.0, 50.0}) {
    for (const double r2 : {0.2, 0.6, 0.95, 1.3, 2.5, 7.0, 200.0}) {
      const double slope = (TypeParam::Weight(r2 + kStep, mu) -
                            TypeParam::Weight(r2 - kStep, mu)) /
                           (2.0 * kStep);
      EXPECT_NEAR(TypeParam::WeightSlope(r2, mu), slope, 1e-6)
          << "r2 " << r2 << ", mu " << mu;
    }
  }
}

TYPED_TEST(SurrogateTest, LossIsNothingForNoResidualAndAtMostTheSquare) {
  for (const double mu : {0.01, 1.0, 50.0}) {
    EXPECT_EQ(TypeParam::Loss(0.0, mu), 0.0) << "mu " << mu;
    for (const double r2 : {0.01, 0.5, 1.0, 3.0, 1e6}) {
      EXPECT_LE(TypeParam::Loss(r2, mu), r2) << "r2 " << r2 << ", mu " << mu;
      EXPECT_GT(TypeParam::Loss(r2, mu), 0.0) << "r2 " << r2 << ", mu " << mu;
    }
  }
}

TEST(SurrogateLoss, InTheLimitIsTheLossItStandsFor) {
  for (const double r2 : {0.0, 0.1, 0.5, 0.99, 1.01, 2.0, 7.0, 1e4}) {
    EXPECT_NEAR(TruncatedLeastSquares::Loss(r2, 1e12), std::min(r2, 1.0), 1e-9)
        << "r2 " << r2;
    EXPECT_NEAR(GemanMcClure::Loss(r2, 1.0), r2 / (1.0 + r2), 1e-15)
        << "r2 " << r2;
    EXPECT_NEAR(Welsch::Loss(r2, 1.0), 1.0 - std::exp(-r2), 1e-15)
        << "r2 " << r2;
  }
}

TYPED_TEST(SurrogateTest, FirstLossTakesNoMeasurementAwayAfterAPlainFit) {
  for (const double max_r2 : {1.01, 2.0, 100.0, 1e8}) {
    const double mu = TypeParam::InitialMu(max_r2, GncStart::kPlainFit);
    EXPECT_GT(TypeParam::Weight(max_r2, mu), 0.0) << "max_r2 " << max_r2;
  }
}

TEST(TruncatedLeastSquares, WeightIsOneBelowZeroAboveAndBetweenTheBounds) {
  // For mu = 1 the bounds are 1/2 and 2, and the weight between them is sqrt(2
  // / r2) - 1.
  EXPECT_EQ(TruncatedLeastSquares::Weight(0.49, 1.0), 1.0);
  EXPECT_EQ(TruncatedLeastSquares::Weight(0.5, 1.0), 1.0);
  EXPECT_NEAR(
      TruncatedLeastSquares::Weight(1.0, 1.0), std::sqrt(2.0) - 1.0, 1e-15);
  EXPECT_EQ(TruncatedLeastSquares::Weight(2.0, 1.0), 0.0);
  EXPECT_EQ(TruncatedLeastSquares::Weight(2.01, 1.0), 0.0);
}

TEST(TruncatedLeastSquares, WeightDoesNotJumpAtTheBounds) {
  for (const double mu : {0.01, 1.0, 50.0}) {
    const double upper = (mu + 1.0) / mu;
    const double lower = mu / (mu + 1.0);
    EXPECT_NEAR(
        TruncatedLeastSquares::Weight(upper * (1.0 - 1e-12), mu), 0.0, 1e-9);
    EXPECT_NEAR(
        TruncatedLeastSquares::Weight(lower * (1.0 + 1e-12), mu), 1.0, 1e-9);
  }
}

TEST(TruncatedLeastSquares, BecomesAStepAtTheNoiseBound) {
  EXPECT_EQ(TruncatedLeastSquares::Weight(0.999, 1e6), 1.0);
  EXPECT_EQ(TruncatedLeastSquares::Weight(1.001, 1e6), 0.0);
}

TEST(TruncatedLeastSquares, StartsWhereTheLargestResidualSaysSo) {
  EXPECT_DOUBLE_EQ(TruncatedLeastSquares::InitialMu(9.0, GncStart::kPlainFit),
                   1.0 / 17.0);
  EXPECT_DOUBLE_EQ(TruncatedLeastSquares::InitialMu(9.0, GncStart::kIdentity),
                   1.0 / 8.0);
}

TEST(TruncatedLeastSquares, GrowsAndIsNeverExact) {
  EXPECT_DOUBLE_EQ(TruncatedLeastSquares::NextMu(2.0, 1.4), 2.8);
  EXPECT_FALSE(TruncatedLeastSquares::IsExact(1.0));
  EXPECT_FALSE(TruncatedLeastSquares::IsExact(1e300));
}

TEST(GemanMcClure, WeightByNumber) {
  // mu = 3, r2 = 1: (3 / 4)^2.
  EXPECT_DOUBLE_EQ(GemanMcClure::Weight(1.0, 3.0), 0.5625);
  EXPECT_DOUBLE_EQ(GemanMcClure::Weight(1.0, 1.0), 0.25);
}

TEST(GemanMcClure, StartsAtTwiceTheLargestResidualEitherWay) {
  EXPECT_EQ(GemanMcClure::InitialMu(9.0, GncStart::kPlainFit), 18.0);
  EXPECT_EQ(GemanMcClure::InitialMu(9.0, GncStart::kIdentity), 18.0);
  EXPECT_EQ(GemanMcClure::InitialMu(0.1, GncStart::kPlainFit), 1.0);
}

TEST(GemanMcClure, FallsToOneWhereItIsExact) {
  EXPECT_DOUBLE_EQ(GemanMcClure::NextMu(2.8, 1.4), 2.0);
  EXPECT_EQ(GemanMcClure::NextMu(1.2, 1.4), 1.0);
  EXPECT_FALSE(GemanMcClure::IsExact(1.001));
  EXPECT_TRUE(GemanMcClure::IsExact(1.0));
}

TEST(Welsch, WeightByNumber) {
  EXPECT_DOUBLE_EQ(Welsch::Weight(3.0, 1.5), std::exp(-2.0));
  EXPECT_EQ(Welsch::Weight(1e9, 1.0), 0.0);
}

TEST(Welsch, StartsAndFallsAsGemanMcClureDoes) {
  EXPECT_EQ(Welsch::InitialMu(9.0, GncStart::kPlainFit), 18.0);
  EXPECT_EQ(Welsch::InitialMu(0.1, GncStart::kIdentity), 1.0);
  EXPECT_DOUBLE_EQ(Welsch::NextMu(2.8, 1.4), 2.0);
  EXPECT_EQ(Welsch::NextMu(1.2, 1.4), 1.0);
  EXPECT_FALSE(Welsch::IsExact(1.001));
  EXPECT_TRUE(Welsch::IsExact(1.0));
}

}  // namespace
}  // namespace quatro::surrogate_test
