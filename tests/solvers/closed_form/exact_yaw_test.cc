// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "solvers/closed_form/exact_yaw.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "experiments/simulator/synthetic.h"
#include "features/base/random.h"
#include "features/base/rigid3.h"
#include "robust/estimators/distinct_matches.h"
#include "robust/gnc/gnc.h"
#include "robust/gnc/quasi_so3.h"
#include "robust/gnc/surrogate.h"
#include "solvers/closed_form/yaw.h"
#include "tests/support/matchers.h"
#include "tests/support/random_problems.h"

namespace quatro::exact_yaw_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Problem {
  Points source;
  Points target;
  Weights weights;
  Weights bounds;

  double CostAt(double yaw) const {
    return TruncatedYawCost(source, target, weights, bounds, yaw);
  }
  double CostAt(const std::optional<YawEstimate>& yaw) const {
    return yaw ? CostAt(yaw->target_from_source) : kInfinity;
  }
  std::optional<ExactYawEstimate> Solve() const {
    return EstimateExactYaw(source, target, weights, bounds);
  }
};

double Between(double low, double high, Random* random) {
  return low + (high - low) * random->Uniform();
}

Eigen::Vector3d PlanarVector(double length, double angle, double z) {
  return {length * std::cos(angle), length * std::sin(angle), z};
}

// Lengths are log-uniform between two values [m]. A third of the measurements
// are rotated by one yaw, the others by random ones. A sixth have inconsistent
// lengths. Some bounds exceed the lengths, so their arc is the full circle.
// Some weights are zero.
Problem RandomProblem(Eigen::Index n,
                      double shortest,
                      double longest,
                      std::uint64_t seed) {
  Random random(seed);
  Problem problem{Points(3, n), Points(3, n), Weights(n), Weights(n)};
  const double yaw = Between(-M_PI, M_PI, &random);
  for (Eigen::Index k = 0; k < n; ++k) {
    const double length =
        shortest * std::pow(longest / shortest, random.Uniform());
    const double bound = Between(0.1, 1.5, &random);
    const double angle = Between(-M_PI, M_PI, &random);
    const double turn =
        random.Below(3) == 0 ? yaw : Between(-M_PI, M_PI, &random);
    const double error = Between(-1.2, 1.2, &random) * bound;
    problem.source.col(k) = PlanarVector(length, angle, random.Uniform());
    problem.target.col(k) = PlanarVector(
        std::abs(length + error), angle + turn, 9.0 * random.Uniform());
    problem.weights[k] = random.Below(8) == 0 ? 0.0 : 2.0 * random.Uniform();
    problem.bounds[k] = bound;
  }
  return problem;
}

Problem FromTims(const MatchedProblem& tims, double bound) {
  const Eigen::Index n = tims.source.cols();
  return {
      tims.source, tims.target, Weights::Ones(n), Weights::Constant(n, bound)};
}

Problem Selected(const Problem& problem,
                 const std::vector<Eigen::Index>& columns) {
  Problem selected{Columns(problem.source, columns),
                   Columns(problem.target, columns),
                   Weights(static_cast<Eigen::Index>(columns.size())),
                   Weights(static_cast<Eigen::Index>(columns.size()))};
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    selected.weights[i] = problem.weights[columns[k]];
    selected.bounds[i] = problem.bounds[columns[k]];
  }
  return selected;
}

// The least-squares fit of a subset of the measurements.
std::optional<YawEstimate> Fit(const Problem& problem,
                               const Eigen::Array<bool, -1, 1>& is_in_set) {
  const Weights weights = is_in_set.select(
      problem.weights.array() / problem.bounds.array().square(), 0.0);
  return EstimateYaw(problem.source, problem.target, weights);
}

// The minimum over the fits of all subsets, without arcs or a sweep.
double LeastOverAllSubsets(const Problem& problem) {
  const Eigen::Index n = problem.source.cols();
  double least = kInfinity;
  for (std::uint32_t bits = 1; bits < (1u << n); ++bits) {
    Eigen::Array<bool, -1, 1> is_in_set(n);
    for (Eigen::Index k = 0; k < n; ++k) is_in_set[k] = (bits >> k) & 1u;
    least = std::min(least, problem.CostAt(Fit(problem, is_in_set)));
  }
  return least;
}

// The minimum over the fits of the sets between consecutive ends of arcs.
double LeastOverAllIntervals(const Problem& problem) {
  const Eigen::Index n = problem.source.cols();
  std::vector<double> ends = {-M_PI, M_PI};
  Eigen::ArrayXd phi(n);
  Eigen::ArrayXd half_width(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const Eigen::Vector2d s = problem.source.col(k).head<2>();
    const Eigen::Vector2d t = problem.target.col(k).head<2>();
    const double a = s.norm();
    const double b = t.norm();
    const double c = problem.bounds[k];
    phi[k] = std::remainder(std::atan2(t.y(), t.x()) - std::atan2(s.y(), s.x()),
                            2.0 * M_PI);
    // Equation (2) as a sine, so that narrow arcs keep their digits.
    const double sine2 = (c - a + b) * (c + a - b) / (4.0 * a * b);
    half_width[k] = sine2 < 0.0    ? -1.0
                    : sine2 >= 1.0 ? 4.0
                                   : 2.0 * std::asin(std::sqrt(sine2));
    if (half_width[k] < 0.0 || half_width[k] > M_PI) continue;
    ends.push_back(std::remainder(phi[k] - half_width[k], 2.0 * M_PI));
    ends.push_back(std::remainder(phi[k] + half_width[k], 2.0 * M_PI));
  }
  std::ranges::sort(ends);
  double least = kInfinity;
  for (std::size_t i = 1; i < ends.size(); ++i) {
    const double middle = 0.5 * (ends[i - 1] + ends[i]);
    Eigen::Array<bool, -1, 1> is_in_set(n);
    for (Eigen::Index k = 0; k < n; ++k) {
      is_in_set[k] = std::abs(std::remainder(middle - phi[k], 2.0 * M_PI)) <=
                     half_width[k];
    }
    least = std::min(least, problem.CostAt(Fit(problem, is_in_set)));
  }
  return least;
}

// The minimum over a grid of 100,000 angles, refined around the best.
double LeastOverGrid(const Problem& problem) {
  constexpr int kNumAngles = 100'000;
  constexpr double kStep = 2.0 * M_PI / kNumAngles;
  const Eigen::ArrayXd angles =
      Eigen::ArrayXd::LinSpaced(kNumAngles, -M_PI, M_PI - kStep);
  static const Eigen::ArrayXd cosines = angles.cos();
  static const Eigen::ArrayXd sines = angles.sin();
  Eigen::ArrayXd cost = Eigen::ArrayXd::Zero(kNumAngles);
  for (Eigen::Index k = 0; k < problem.source.cols(); ++k) {
    const Eigen::Vector2d s = problem.source.col(k).head<2>();
    const Eigen::Vector2d t = problem.target.col(k).head<2>();
    const double cross = s.x() * t.y() - s.y() * t.x();
    const double scale = 1.0 / (problem.bounds[k] * problem.bounds[k]);
    cost += problem.weights[k] *
            (scale * (s.squaredNorm() + t.squaredNorm() -
                      2.0 * (s.dot(t) * cosines + cross * sines)))
                .min(1.0);
  }
  Eigen::Index best = 0;
  cost.minCoeff(&best);
  double low = angles[best] - kStep;
  double high = angles[best] + kStep;
  for (int i = 0; i < 60; ++i) {
    const double a = low + (high - low) / 3.0;
    const double b = high - (high - low) / 3.0;
    (problem.CostAt(a) < problem.CostAt(b) ? high : low) =
        problem.CostAt(a) < problem.CostAt(b) ? b : a;
  }
  return problem.CostAt(0.5 * (low + high));
}

TEST(ExactYaw, IsTheLeastOverAllSubsets) {
  int num_answers = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const auto n = static_cast<Eigen::Index>(1 + seed % 10);
    const Problem problem = RandomProblem(n, 0.3, 10.0, seed);
    const auto exact = problem.Solve();
    if (!exact) continue;
    ++num_answers;
    EXPECT_NEAR(exact->cost, LeastOverAllSubsets(problem), 1e-12)
        << "seed " << seed << ", yaw " << exact->target_from_source;
  }
  EXPECT_GT(num_answers, 250);
}

TEST(ExactYaw, IsTheLeastOverAllIntervals) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Problem problem = RandomProblem(60, 0.3, 30.0, seed);
    const auto exact = problem.Solve();
    ASSERT_TRUE(exact.has_value()) << "seed " << seed;
    EXPECT_NEAR(exact->cost, LeastOverAllIntervals(problem), 1e-11)
        << "seed " << seed << ", yaw " << exact->target_from_source;
  }
}

TEST(ExactYaw, NoAngleOfAFineGridIsBetter) {
  int num_answers = 0;
  int num_at_the_grids_best = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const auto n = static_cast<Eigen::Index>(2 + seed % 14);
    const Problem problem = RandomProblem(n, 0.3, 10.0, 1000 + seed);
    const auto exact = problem.Solve();
    if (!exact) continue;
    ++num_answers;
    const double least = LeastOverGrid(problem);
    EXPECT_LE(exact->cost, least + 1e-12) << "seed " << seed;
    num_at_the_grids_best += least <= exact->cost + 1e-9;
  }
  EXPECT_GT(num_answers, 180);
  EXPECT_GT(num_at_the_grids_best, 170);
}

TEST(ExactYaw, CostAndInliersAreThoseOfTheYaw) {
  int num_clear = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const Problem problem = RandomProblem(40, 0.3, 30.0, seed);
    const auto exact = problem.Solve();
    ASSERT_TRUE(exact.has_value());
    EXPECT_EQ(exact->cost, problem.CostAt(exact->target_from_source));
    EXPECT_LE(exact->cost, problem.weights.sum());
    EXPECT_GE(exact->cost, 0.0);
    EXPECT_LE(std::abs(exact->target_from_source), M_PI);
    ASSERT_EQ(exact->is_inlier.size(), 40);
    EXPECT_EQ(exact->num_inliers, exact->is_inlier.count());
    EXPECT_GT(exact->num_inliers, 0);
    const Points error =
        problem.target - RotationZ(exact->target_from_source) * problem.source;
    for (Eigen::Index k = 0; k < 40; ++k) {
      const double distance = error.col(k).head<2>().norm();
      if (std::abs(distance - problem.bounds[k]) < 1e-9) continue;
      ++num_clear;
      EXPECT_EQ(exact->is_inlier[k], distance < problem.bounds[k])
          << "seed " << seed << ", " << distance << " m";
    }
  }
  EXPECT_GT(num_clear, 3900);
}

TEST(ExactYaw, CostsNoMoreThanGraduatedNonConvexity) {
  constexpr double kBound = 0.3;
  int num_compared = 0;
  int num_missed = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const double ratio = 0.5 + 0.05 * static_cast<double>(seed % 10);
    const MatchedProblem tims = MakeTimProblem(200, ratio, 0.1, seed);
    const Problem problem = FromTims(tims, kBound);
    const auto exact = problem.Solve();
    ASSERT_TRUE(exact.has_value()) << "seed " << seed;
    const auto gnc = SolveGnc<TruncatedLeastSquares>(
        QuasiSo3{tims.source, tims.target, kBound}, GncOptions());
    if (!gnc.IsUsable()) continue;
    ++num_compared;
    const double gap = problem.CostAt(gnc.estimate) - exact->cost;
    EXPECT_GE(gap, -1e-9 * exact->cost) << "seed " << seed;
    num_missed += gap > 1e-3;
  }
  EXPECT_GT(num_compared, 250);
  EXPECT_GT(num_missed, 10) << "too easy to tell the two apart";
}

TEST(ExactYaw, IsRightUnderUpTo99PercentOutliers) {
  for (const double ratio : {0.95, 0.98, 0.99}) {
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      const MatchedProblem tims = MakeTimProblem(5000, ratio, 0.1, seed);
      const auto exact = FromTims(tims, 0.3).Solve();
      ASSERT_TRUE(exact.has_value());
      EXPECT_THAT(exact->target_from_source,
                  IsAngleNear(Yaw(tims.true_target_from_source.rotation),
                              1.0 * M_PI / 180.0))
          << ratio << ", seed " << seed;
    }
  }
}

TEST(ExactYaw, OneMeasurementGivesItsExactYaw) {
  for (const double yaw : {0.0, 1e-9, 0.5, 1.6, 3.1, M_PI, -M_PI, -2.0}) {
    for (const double length : {1e-3, 1.0, 1e6}) {
      const Points source = PlanarVector(length, 0.4, 1.0);
      const auto exact = EstimateExactYaw(source,
                                          RotationZ(yaw) * source,
                                          Weights::Ones(1),
                                          Weights::Constant(1, 0.01));
      ASSERT_TRUE(exact.has_value()) << yaw << ", " << length << " m";
      EXPECT_THAT(exact->target_from_source, IsAngleNear(yaw, 1e-14))
          << length << " m";
      EXPECT_EQ(exact->num_inliers, 1);
    }
  }
}

TEST(ExactYaw, ArcsAcrossPiAreWhole) {
  // A third each about pi - 0.05, pi and pi + 0.05; arcs are 0.1 wide.
  for (const double center : {M_PI, -M_PI, 0.0, 0.5 * M_PI}) {
    Problem problem{Points(3, 9),
                    Points(3, 9),
                    Weights::Ones(9),
                    Weights::Constant(9, 0.5)};
    for (Eigen::Index k = 0; k < 9; ++k) {
      const double off = 0.05 * static_cast<double>(k % 3 - 1);
      problem.source.col(k) = PlanarVector(5.0, static_cast<double>(k), 0.0);
      problem.target.col(k) =
          RotationZ(center + off) * Eigen::Vector3d(problem.source.col(k));
    }
    const auto exact = problem.Solve();
    ASSERT_TRUE(exact.has_value());
    EXPECT_THAT(exact->target_from_source, IsAngleNear(center, 1e-14));
    EXPECT_EQ(exact->num_inliers, 9) << "about " << center;
  }
}

TEST(ExactYaw, BoundsAboveTheLengthsAreNeverAnOutlier) {
  // Nothing is truncated, so this is the least-squares fit.
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Problem problem = RandomProblem(20, 0.3, 3.0, seed);
    problem.bounds.setConstant(100.0);
    const auto exact = problem.Solve();
    ASSERT_TRUE(exact.has_value());
    const auto plain =
        EstimateYaw(problem.source, problem.target, problem.weights);
    EXPECT_THAT(exact->target_from_source,
                IsAngleNear(plain->target_from_source, 1e-9))
        << "seed " << seed;
    EXPECT_EQ(exact->num_inliers, 20);
  }
}

TEST(ExactYaw, LengthsThatDisagreeChangeTheCostAlone) {
  const Problem problem = RandomProblem(30, 1.0, 10.0, /*seed=*/3);
  Problem more{Points(3, 40), Points(3, 40), Weights(40), Weights(40)};
  more.source << problem.source, 10.0 * RandomPoints(10, 1.0, 1);
  more.target << problem.target, (1000.0 * RandomPoints(10, 1.0, 2)).colwise() +
                                     Eigen::Vector3d(5e3, 0, 0);
  more.weights << problem.weights, Weights::Constant(10, 0.7);
  more.bounds << problem.bounds, Weights::Constant(10, 0.5);
  const auto expected = problem.Solve();
  const auto exact = more.Solve();
  ASSERT_TRUE(expected && exact);
  EXPECT_THAT(exact->target_from_source,
              IsAngleNear(expected->target_from_source, 1e-12));
  EXPECT_NEAR(exact->cost, expected->cost + 7.0, 1e-12);
}

TEST(ExactYaw, OfEqualMinimaTheFirstFromMinusPi) {
  for (const Eigen::Index num_copies : {1, 2, 3, 10}) {
    // Equal numbers at four angles, in any order.
    const double angles[] = {1.0, -2.0, 2.5, -0.5};
    const Eigen::Index n = 4 * num_copies;
    Problem problem{Points(3, n),
                    Points(3, n),
                    Weights::Ones(n),
                    Weights::Constant(n, 0.25)};
    for (Eigen::Index k = 0; k < n; ++k) {
      problem.source.col(k) = PlanarVector(2.0, 0.0, 0.0);
      problem.target.col(k) = PlanarVector(2.0, angles[k % 4], 0.0);
    }
    const auto exact = problem.Solve();
    ASSERT_TRUE(exact.has_value());
    EXPECT_THAT(exact->target_from_source, IsAngleNear(-2.0, 1e-12))
        << num_copies << " copies";
    EXPECT_NEAR(exact->cost, 3.0 * static_cast<double>(num_copies), 1e-12);
  }
}

TEST(ExactYaw, DoesNotAnswerWhereNoMeasurementHoldsAYaw) {
  EXPECT_FALSE(
      EstimateExactYaw(Points(3, 0), Points(3, 0), Weights(0), Weights(0)));
  const Problem problem = RandomProblem(10, 1.0, 10.0, /*seed=*/1);
  ASSERT_TRUE(problem.Solve());

  Problem weightless = problem;
  weightless.weights.setZero();
  EXPECT_FALSE(weightless.Solve());

  Problem vertical = problem;
  vertical.source.topRows<2>().setZero();
  EXPECT_FALSE(vertical.Solve());
  vertical = problem;
  vertical.target.topRows<2>().setZero();
  EXPECT_FALSE(vertical.Solve());

  Problem disagreeing = problem;
  disagreeing.target *= 100.0;
  EXPECT_FALSE(disagreeing.Solve());
}

TEST(ExactYaw, TurningTheTargetAddsToTheYaw) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Problem problem = RandomProblem(30, 1.0, 10.0, seed);
    const auto base = problem.Solve();
    ASSERT_TRUE(base.has_value());
    for (const double turn : {0.3, 2.9, M_PI, -1.7}) {
      Problem turned = problem;
      turned.target = RotationZ(turn) * problem.target;
      const auto exact = turned.Solve();
      ASSERT_TRUE(exact.has_value());
      EXPECT_THAT(exact->target_from_source,
                  IsAngleNear(base->target_from_source + turn, 1e-12))
          << "seed " << seed << ", turn " << turn;
      EXPECT_NEAR(exact->cost, base->cost, 1e-12);
    }
  }
}

TEST(ExactYaw, SwappingSourceAndTargetNegatesIt) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const Problem problem = RandomProblem(30, 1.0, 10.0, seed);
    Problem swapped = problem;
    std::swap(swapped.source, swapped.target);
    const auto forward = problem.Solve();
    const auto backward = swapped.Solve();
    ASSERT_TRUE(forward && backward);
    EXPECT_THAT(backward->target_from_source,
                IsAngleNear(-forward->target_from_source, 1e-12))
        << "seed " << seed;
    EXPECT_NEAR(backward->cost, forward->cost, 1e-12);
  }
}

TEST(ExactYaw, OrderDoesNotMatter) {
  const Problem problem = RandomProblem(100, 0.3, 10.0, /*seed=*/5);
  const auto expected = problem.Solve();
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const auto permuted =
        Selected(problem, RandomPermutation(100, seed)).Solve();
    EXPECT_THAT(permuted->target_from_source,
                IsAngleNear(expected->target_from_source, 1e-12))
        << "seed " << seed;
    EXPECT_NEAR(permuted->cost, expected->cost, 1e-12);
  }
}

TEST(ExactYaw, ZeroWeightIsTheSameAsLeavingTheMeasurementOut) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Problem problem = RandomProblem(50, 0.3, 10.0, seed);
    problem.weights.tail(30).setZero();
    std::vector<Eigen::Index> kept(20);
    for (std::size_t k = 0; k < kept.size(); ++k) {
      kept[k] = static_cast<Eigen::Index>(k);
    }
    const auto masked = problem.Solve();
    const auto without = Selected(problem, kept).Solve();
    ASSERT_TRUE(masked && without);
    EXPECT_THAT(masked->target_from_source,
                IsAngleNear(without->target_from_source, 1e-12))
        << "seed " << seed;
    EXPECT_NEAR(masked->cost, without->cost, 1e-12);
  }
}

TEST(ExactYaw, HeightDoesNotMatterBitForBit) {
  const Problem problem = RandomProblem(50, 0.3, 10.0, /*seed=*/2);
  Problem raised = problem;
  raised.source.row(2).setConstant(1e6);
  raised.target.row(2).array() -= 5.0;
  EXPECT_EQ(raised.Solve()->target_from_source,
            problem.Solve()->target_from_source);
  EXPECT_EQ(raised.Solve()->cost, problem.Solve()->cost);
}

TEST(ExactYaw, CopiesAreTheSameAsWeight) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Problem problem = RandomProblem(20, 0.3, 10.0, seed);
    std::vector<Eigen::Index> columns;
    Problem weighted = problem;
    for (Eigen::Index k = 0; k < 20; ++k) {
      const Eigen::Index num_copies = 1 + k % 4;
      weighted.weights[k] *= static_cast<double>(num_copies);
      columns.insert(columns.end(), static_cast<std::size_t>(num_copies), k);
    }
    const auto expected = weighted.Solve();
    const auto copied = Selected(problem, columns).Solve();
    ASSERT_TRUE(expected && copied);
    EXPECT_THAT(copied->target_from_source,
                IsAngleNear(expected->target_from_source, 1e-12))
        << "seed " << seed;
    EXPECT_NEAR(copied->cost, expected->cost, 1e-12);
  }
}

TEST(ExactYaw, UnitOfLengthDoesNotMatter) {
  for (const double unit : {1e-3, 1e3, 1e6}) {
    Problem problem = RandomProblem(60, 0.3, 30.0, /*seed=*/7);
    const auto expected = problem.Solve();
    problem.source *= unit;
    problem.target *= unit;
    problem.bounds *= unit;
    const auto exact = problem.Solve();
    ASSERT_TRUE(exact.has_value());
    EXPECT_THAT(exact->target_from_source,
                IsAngleNear(expected->target_from_source, 1e-12))
        << unit;
    EXPECT_NEAR(exact->cost, expected->cost, 1e-11) << unit;
  }
}

TEST(ExactYaw, AMillimetreBesideAThousandKilometresIsAsGood) {
  // A long measurement that leaves the set must not leave rounding errors that
  // drown the short ones.
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Problem problem = RandomProblem(60, 1e-3, 1e6, seed);
    const auto exact = problem.Solve();
    ASSERT_TRUE(exact.has_value()) << "seed " << seed;
    EXPECT_NEAR(exact->cost, LeastOverAllIntervals(problem), 1e-6)
        << "seed " << seed << ", yaw " << exact->target_from_source;
  }
}

TEST(ExactYaw, OneFromTheEndOfTheWorldDoesNotDrownTheOthers) {
  for (const double far : {1e6, 1e7, 1e8, 1e9, 1e10}) {
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
      Problem problem = RandomProblem(41, 0.3, 30.0, seed);
      problem.source.col(40) = PlanarVector(far, 0.0, 0.0);
      problem.target.col(40) =
          PlanarVector(far, static_cast<double>(seed), 0.0);
      problem.weights[40] = 1.0;
      problem.bounds[40] = 0.3;
      const auto exact = problem.Solve();
      ASSERT_TRUE(exact.has_value());
      EXPECT_NEAR(exact->cost, LeastOverAllIntervals(problem), 1e-5)
          << far << " m, seed " << seed;
    }
  }
}

TEST(ExactYaw, ArcsThatJustCloseAreAllOfTheCircle) {
  // a + b = c up to rounding: at most the last digit is beyond the bound.
  int num_answers = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Problem problem = RandomProblem(8, 0.05, 0.5, seed);
    Random random(seed);
    for (Eigen::Index k = 0; k < 8; ++k) {
      if (random.Below(2) == 0) continue;
      problem.weights[k] = 1.0;
      problem.bounds[k] = problem.source.col(k).head<2>().norm() +
                          problem.target.col(k).head<2>().norm();
    }
    const auto exact = problem.Solve();
    if (!exact) continue;
    ++num_answers;
    EXPECT_NEAR(exact->cost, LeastOverAllSubsets(problem), 1e-12)
        << "seed " << seed << ", yaw " << exact->target_from_source;
  }
  EXPECT_GT(num_answers, 250);
}

TEST(ExactYaw, LengthsWhoseSquaresOverflowAreLeftOut) {
  Problem problem = RandomProblem(20, 0.3, 10.0, /*seed=*/1);
  const auto expected = problem.Solve();
  ASSERT_TRUE(expected.has_value());
  for (const double far : {1e155, 1e200, 1e308}) {
    Problem more{Points(3, 22), Points(3, 22), Weights(22), Weights(22)};
    more.source << problem.source, Eigen::Vector3d(far, far, 0.0),
        Eigen::Vector3d(-far, far, 0.0);
    more.target << problem.target, Eigen::Vector3d(-far, far, 0.0),
        Eigen::Vector3d(far, far, 0.0);
    more.weights << problem.weights, 1.0, 1.0;
    more.bounds << problem.bounds, 0.3, 0.3;
    const auto exact = more.Solve();
    ASSERT_TRUE(exact.has_value()) << far << " m";
    EXPECT_EQ(exact->target_from_source, expected->target_from_source)
        << far << " m";
  }
}

TEST(ExactYaw, DoesNotAnswerToNaN) {
  const Problem problem = RandomProblem(20, 1.0, 10.0, /*seed=*/1);
  ASSERT_TRUE(problem.Solve().has_value());
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  for (int which = 0; which < 4; ++which) {
    Problem broken = problem;
    if (which == 0) broken.source(0, 3) = kNaN;
    if (which == 1) broken.target(1, 3) = kNaN;
    if (which == 2) broken.weights[3] = kNaN;
    if (which == 3) broken.bounds[3] = kNaN;
    EXPECT_FALSE(broken.Solve().has_value()) << which;
  }
}

TEST(TruncatedYawCost, ByHand) {
  // Rotated by 90 deg: residuals are 0, 1 with bound 2, and 5 with bound 2.
  Points source(3, 3);
  source << 1.0, 2.0, 3.0,  //
      0.0, 0.0, 0.0,        //
      7.0, 8.0, 9.0;
  Points target(3, 3);
  target << 0.0, 0.0, 4.0,  //
      1.0, 3.0, 0.0,        //
      0.0, 0.0, 0.0;
  EXPECT_NEAR(TruncatedYawCost(source,
                               target,
                               Eigen::Vector3d(5.0, 2.0, 3.0),
                               Eigen::Vector3d(1.0, 2.0, 2.0),
                               0.5 * M_PI),
              5.0 * 0.0 + 2.0 * 0.25 + 3.0 * 1.0,
              1e-15);
}

}  // namespace
}  // namespace quatro::exact_yaw_test
