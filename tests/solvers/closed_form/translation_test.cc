// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "solvers/closed_form/translation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "features/base/random.h"
#include "tests/support/matched_problems.h"
#include "tests/support/random_problems.h"

namespace quatro::translation_test {
namespace {

using Vector = Eigen::VectorXd;

// An independent implementation of (1) of the header.
double TruncatedCost(double t, const Vector& values, const Vector& bounds) {
  return ((t - values.array()) / bounds.array()).square().min(1.0).sum();
}

Vector Filled(Eigen::Index n, double value) {
  return Vector::Constant(n, value);
}

struct AxisProblem {
  Vector values;
  Vector bounds;
};

// Values crowded enough that many intervals overlap.
AxisProblem RandomAxis(Eigen::Index n, bool equal_bounds, std::uint64_t seed) {
  Random random(seed);
  AxisProblem axis;
  axis.values =
      Vector::NullaryExpr(n, [&] { return 2.0 * SignedUniform(&random); });
  axis.bounds = Vector::NullaryExpr(n, [&] {
    return equal_bounds ? 0.4 : std::pow(10.0, SignedUniform(&random) - 0.5);
  });
  return axis;
}

// The least (1) over the weighted means of all non-empty subsets. The minimum
// is the mean of its own consensus set, so it is one of them.
double LeastCostOverAllSubsets(const AxisProblem& axis) {
  const auto n = static_cast<unsigned>(axis.values.size());
  double least = std::numeric_limits<double>::infinity();
  for (unsigned subset = 1; subset < 1u << n; ++subset) {
    double weight = 0.0;
    double sum = 0.0;
    for (unsigned i = 0; i < n; ++i) {
      if ((subset >> i & 1u) == 0) continue;
      const double w = 1.0 / (axis.bounds[i] * axis.bounds[i]);
      weight += w;
      sum += w * axis.values[i];
    }
    least =
        std::min(least, TruncatedCost(sum / weight, axis.values, axis.bounds));
  }
  return least;
}

double LeastCostOnGrid(const AxisProblem& axis, int num_steps) {
  const double low = axis.values.minCoeff();
  const double high = axis.values.maxCoeff();
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k <= num_steps; ++k) {
    const double t = low + (high - low) * k / num_steps;
    least = std::min(least, TruncatedCost(t, axis.values, axis.bounds));
  }
  return least;
}

TEST(EstimateConsensus, IsTheBestOfAllSubsets) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const AxisProblem axis =
        RandomAxis(1 + static_cast<Eigen::Index>(seed % 9), seed % 2, seed);
    const auto estimate = EstimateConsensus(axis.values, axis.bounds);
    ASSERT_TRUE(estimate.has_value());
    EXPECT_NEAR(estimate->cost, LeastCostOverAllSubsets(axis), 1e-12)
        << "seed " << seed << ", value " << estimate->value;
  }
}

TEST(EstimateConsensus, NoPointOfADenseGridIsBetter) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const AxisProblem axis = RandomAxis(60, seed % 2, seed);
    const auto estimate = EstimateConsensus(axis.values, axis.bounds);
    const double least = LeastCostOnGrid(axis, 20000);
    EXPECT_LE(estimate->cost, least + 1e-12) << "seed " << seed;
    EXPECT_GE(estimate->cost, least - 0.05) << "seed " << seed;
  }
}

TEST(EstimateConsensus, CostAndCountAreThoseAtTheValue) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const AxisProblem axis = RandomAxis(100, seed % 2, seed);
    const auto estimate = EstimateConsensus(axis.values, axis.bounds);
    EXPECT_NEAR(estimate->cost,
                TruncatedCost(estimate->value, axis.values, axis.bounds),
                1e-12 * estimate->cost)
        << "seed " << seed;
    EXPECT_EQ(
        estimate->num_inliers,
        ((estimate->value - axis.values.array()).abs() <= axis.bounds.array())
            .count())
        << "seed " << seed;
  }
}

TEST(EstimateConsensus, NoValuesHaveNone) {
  EXPECT_FALSE(EstimateConsensus(Vector(0), Vector(0)).has_value());
}

TEST(EstimateConsensus, OneValueIsItself) {
  for (const double value : {0.0, -3.25, 1e-9, 1e12}) {
    const auto estimate = EstimateConsensus(Filled(1, value), Filled(1, 0.125));
    EXPECT_NEAR(estimate->value, value, 1e-17);
    EXPECT_NEAR(estimate->cost, 0.0, 1e-30);
    EXPECT_EQ(estimate->num_inliers, 1);
  }
}

TEST(EstimateConsensus, TwoNearValuesGiveTheirWeightedMean) {
  // Weights 1 / 0.5^2 and 1 / 1^2: mean (4 * 0 + 1 * 1) / 5.
  const auto estimate =
      EstimateConsensus(Eigen::Vector2d(0.0, 1.0), Eigen::Vector2d(0.5, 1.0));
  EXPECT_NEAR(estimate->value, 0.2, 1e-15);
  EXPECT_NEAR(estimate->cost, 0.16 + 0.64, 1e-15);
  EXPECT_EQ(estimate->num_inliers, 2);
}

TEST(EstimateConsensus, TwoFarValuesGiveOneOfThem) {
  const auto estimate =
      EstimateConsensus(Eigen::Vector2d(0.0, 9.0), Eigen::Vector2d(1.0, 1.0));
  EXPECT_TRUE(estimate->value == 0.0 || estimate->value == 9.0)
      << estimate->value;
  EXPECT_NEAR(estimate->cost, 1.0, 1e-15);
  EXPECT_EQ(estimate->num_inliers, 1);
}

TEST(EstimateConsensus, AgreementAtTheVeryBoundGainsNothing) {
  // Halfway between, both are exactly at their bound and cost 1 each. At either
  // of them, only the other one costs 1.
  const auto estimate =
      EstimateConsensus(Eigen::Vector2d(0.0, 1.0), Eigen::Vector2d(0.5, 0.5));
  EXPECT_EQ(estimate->cost, 1.0);
  EXPECT_EQ(estimate->num_inliers, 1);
}

TEST(EstimateConsensus, MoreValuesBeatTighterOnes) {
  Vector values(5);
  values << 0.0, 0.0, 10.0, 10.2, 10.4;
  EXPECT_NEAR(EstimateConsensus(values, Filled(5, 0.5))->value, 10.2, 1e-14);
}

TEST(EstimateConsensus, CostDecidesAndNotTheCount) {
  // The three of a wide set cost 1 + 0 + 1, plus two outliers. The two equal
  // ones cost nothing, plus three outliers. 2 + 2 > 0 + 3.
  Vector values(5);
  values << 0.0, 1.0, 2.0, 50.0, 50.0;
  const auto estimate = EstimateConsensus(values, Filled(5, 1.0));
  EXPECT_EQ(estimate->value, 50.0);
  EXPECT_EQ(estimate->cost, 3.0);
  EXPECT_EQ(estimate->num_inliers, 2);
}

TEST(EstimateConsensus, FarOutliersLeaveNoResidue) {
  Vector inliers(4);
  inliers << 0.1, 0.15, 0.2, 0.3;
  const auto alone = EstimateConsensus(inliers, Filled(4, 0.25));
  for (const double far : {1e7, 1e12}) {
    Vector values(10);
    values << inliers, -far, -far, 1.5 * far, far, -2.0 * far, 0.7 * far;
    const auto estimate = EstimateConsensus(values, Filled(10, 0.25));
    EXPECT_NEAR(estimate->value, alone->value, 1e-15) << "outliers at " << far;
    EXPECT_NEAR(estimate->cost, alone->cost + 6.0, 1e-14);
    EXPECT_EQ(estimate->num_inliers, 4);
  }
}

TEST(EstimateConsensus, GroupsFarApartDoNotMixTheirCosts) {
  // Three copies of one group, equal up to the digits lost far away.
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const Vector group = 0.1 * RandomAxis(6, true, seed).values;
    const Vector bounds = Filled(6, 0.3);
    const double far = seed % 2 == 0 ? 1e10 : 1e12;
    const Vector left = group.array() - far;
    const Vector right = group.array() + far;
    const double least = std::min({EstimateConsensus(left, bounds)->cost,
                                   EstimateConsensus(group, bounds)->cost,
                                   EstimateConsensus(right, bounds)->cost});
    Vector values(18);
    values << left, group, right;
    EXPECT_NEAR(
        EstimateConsensus(values, Filled(18, 0.3))->cost, 12.0 + least, 1e-12)
        << "seed " << seed << ", groups " << far << " apart";
  }
}

TEST(EstimateConsensus, OrderDoesNotMatterBitForBit) {
  const AxisProblem axis = RandomAxis(200, true, 11);
  const auto expected = EstimateConsensus(axis.values, axis.bounds);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const auto order = RandomPermutation(axis.values.size(), seed);
    const auto estimate =
        EstimateConsensus(Vector(axis.values(order)), axis.bounds);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(estimate->value),
              std::bit_cast<std::uint64_t>(expected->value));
    EXPECT_EQ(estimate->num_inliers, expected->num_inliers);
  }
}

TEST(EstimateConsensus, ShiftingTheValuesShiftsTheAnswer) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const AxisProblem axis = RandomAxis(50, seed % 2, seed);
    const auto base = EstimateConsensus(axis.values, axis.bounds);
    const auto shifted =
        EstimateConsensus(axis.values.array() + 123.0, axis.bounds);
    EXPECT_NEAR(shifted->value, base->value + 123.0, 1e-12) << "seed " << seed;
    EXPECT_NEAR(shifted->cost, base->cost, 1e-10) << "seed " << seed;
  }
}

TEST(EstimateConsensus, NegatingTheValuesNegatesTheAnswer) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const AxisProblem axis = RandomAxis(50, seed % 2, seed);
    const auto base = EstimateConsensus(axis.values, axis.bounds);
    const auto mirrored = EstimateConsensus(-axis.values, axis.bounds);
    EXPECT_NEAR(mirrored->value, -base->value, 1e-13) << "seed " << seed;
    EXPECT_NEAR(mirrored->cost, base->cost, 1e-12) << "seed " << seed;
  }
}

TEST(EstimateConsensus, DoublingAllLeavesTheValueAndDoublesTheCost) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const AxisProblem axis = RandomAxis(50, seed % 2, seed);
    Vector values(100);
    values << axis.values, axis.values;
    Vector bounds(100);
    bounds << axis.bounds, axis.bounds;
    const auto once = EstimateConsensus(axis.values, axis.bounds);
    const auto twice = EstimateConsensus(values, bounds);
    EXPECT_NEAR(twice->value, once->value, 1e-13) << "seed " << seed;
    EXPECT_NEAR(twice->cost, 2.0 * once->cost, 1e-12) << "seed " << seed;
    EXPECT_EQ(twice->num_inliers, 2 * once->num_inliers) << "seed " << seed;
  }
}

TEST(EstimateConsensus, EqualValuesAreOneConsensus) {
  const auto estimate = EstimateConsensus(Filled(1000, 0.3), Filled(1000, 0.1));
  EXPECT_NEAR(estimate->value, 0.3, 1e-15);
  EXPECT_NEAR(estimate->cost, 0.0, 1e-20);
  EXPECT_EQ(estimate->num_inliers, 1000);
}

TEST(EstimateConsensus, APreciseValueDoesNotDrownTheOthers) {
  // The first weighs 1e6 times as much as each other one, but the others
  // outnumber it.
  Vector values(5);
  values << 0.0, 0.5, 0.6, 0.7, 0.8;
  Vector bounds = Filled(5, 1.0);
  bounds[0] = 1e-3;
  const auto estimate = EstimateConsensus(values, bounds);
  EXPECT_NEAR(estimate->value, 0.65, 1e-9);
  EXPECT_EQ(estimate->num_inliers, 4);
}

TEST(EstimateTranslation, IsEachAxisOnItsOwn) {
  Random random(12);
  const Points rotated_source =
      RandomPointsInBox(30, Eigen::Vector3d::Constant(20.0), &random);
  const Points target =
      rotated_source +
      RandomPointsInBox(30, Eigen::Vector3d(0.5, 1.0, 2.0), &random);
  const auto estimate = EstimateTranslation(rotated_source, target, 0.3);
  Eigen::Array<bool, Eigen::Dynamic, 1> is_inlier(30);
  is_inlier.setConstant(true);
  for (int axis = 0; axis < 3; ++axis) {
    const Vector values = (target - rotated_source).row(axis).transpose();
    const auto consensus = EstimateConsensus(values, Filled(30, 0.3));
    EXPECT_EQ(estimate->target_from_source[axis], consensus->value);
    EXPECT_EQ(estimate->cost[axis], consensus->cost);
    is_inlier = is_inlier && (values.array() - consensus->value).abs() <= 0.3;
  }
  EXPECT_TRUE((estimate->is_inlier == is_inlier).all());
  EXPECT_GT(estimate->is_inlier.count(), 0);
  EXPECT_LT(estimate->is_inlier.count(), 30);
}

TEST(EstimateTranslation, FindsTheShiftUnderOutliers) {
  MatchedProblemOptions options;
  options.yaw = 0.0;
  options.num_outliers = 360;
  const KnownProblem problem = MakeMatchedProblem(options, 13);
  const auto estimate =
      EstimateTranslation(problem.source, problem.target, 0.2);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(
        estimate->target_from_source[axis], options.translation[axis], 0.1)
        << "axis " << axis;
  }
  for (const Eigen::Index i : problem.inliers) {
    EXPECT_TRUE(estimate->is_inlier[i]) << "match " << i;
  }
}

TEST(EstimateTranslation, SwappingSourceAndTargetTurnsItRound) {
  const KnownProblem problem = MakeMatchedProblem({.yaw = 0.0}, /*seed=*/14);
  const auto forward = EstimateTranslation(problem.source, problem.target, 0.2);
  const auto backward =
      EstimateTranslation(problem.target, problem.source, 0.2);
  EXPECT_LE((forward->target_from_source + backward->target_from_source).norm(),
            1e-13);
  EXPECT_TRUE((forward->is_inlier == backward->is_inlier).all());
}

TEST(EstimateTranslation, NoMatchesHaveNone) {
  EXPECT_FALSE(
      EstimateTranslation(Points(3, 0), Points(3, 0), 0.3).has_value());
}

}  // namespace
}  // namespace quatro::translation_test
