// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "features/base/rigid3.h"
#include "solvers/closed_form/exact_yaw.h"
#include "solvers/closed_form/rotation.h"
#include "solvers/closed_form/translation.h"
#include "solvers/closed_form/yaw.h"
#include "tests/properties/lattice.h"
#include "tests/support/horn_rotation.h"

namespace quatro::solvers_test {
namespace {

constexpr double kTolerance = 1e-9;

double YawCost(const Points& source,
               const Points& target,
               const Weights& weights,
               double yaw) {
  const Points errors = target - RotationZ(yaw) * source;
  return (errors.topRows<2>().colwise().squaredNorm() * weights).value();
}

// In whole numbers the sums that decide are exact, and so is their zero.
RC_GTEST_PROP(YawProperty, AnswersWhereTheSumsAreNotZero, ()) {
  const auto n = *NumUpTo(0, 5);
  const Points source = LatticePoints(n), target = LatticePoints(n);
  const Weights weights = LatticeNumbers(n, 0, 2);
  double cosine = 0.0, sine = 0.0;
  for (Eigen::Index i = 0; i < source.cols(); ++i) {
    const auto p = source.col(i), q = target.col(i);
    cosine += weights[i] * (p.x() * q.x() + p.y() * q.y());
    sine += weights[i] * (p.x() * q.y() - p.y() * q.x());
  }
  const auto yaw = EstimateYaw(source, target, weights);
  RC_ASSERT(yaw.has_value() == (cosine != 0.0 || sine != 0.0));
  if (!yaw) return;
  RC_ASSERT(
      std::abs(yaw->cost -
               YawCost(source, target, weights, yaw->target_from_source)) <
      kTolerance * (1.0 + yaw->cost));
  for (int k = 0; k < 16; ++k) {
    RC_ASSERT(yaw->cost <=
              YawCost(source, target, weights, k * M_PI / 8) + 1e-9);
  }
}

RC_GTEST_PROP(RotationProperty, BothClosedFormsAnswerTheSame, ()) {
  const auto n = *NumUpTo(0, 5);
  const Points source = LatticePoints(n), target = LatticePoints(n);
  const Weights weights = LatticeNumbers(n, 0, 2);
  const auto svd = EstimateRotation(source, target, weights);
  const auto horn = EstimateRotationHorn(source, target, weights);
  RC_ASSERT(svd.has_value() == horn.has_value());
  if (!svd) return;
  RC_ASSERT(std::abs(svd->cost - horn->cost) < kTolerance * (1.0 + svd->cost));
  for (const Eigen::Matrix3d& rotation :
       {svd->target_from_source, horn->target_from_source}) {
    RC_ASSERT((rotation * rotation.transpose()).isIdentity(kTolerance));
    RC_ASSERT(rotation.determinant() > 0.0);
  }
}

// The best mean of any subset, the truncated ones at their cost of 1.
double BestOfAllSubsets(const Weights& values, const Weights& bounds) {
  const Eigen::Index n = values.size();
  double best = static_cast<double>(n);
  for (int subset = 1; subset < (1 << n); ++subset) {
    double sum = 0.0, weight = 0.0;
    for (Eigen::Index i = 0; i < n; ++i) {
      if (((subset >> i) & 1) == 0) continue;
      sum += values[i] / (bounds[i] * bounds[i]);
      weight += 1.0 / (bounds[i] * bounds[i]);
    }
    double cost = 0.0;
    for (Eigen::Index i = 0; i < n; ++i) {
      const double r = (sum / weight - values[i]) / bounds[i];
      cost += std::min(r * r, 1.0);
    }
    best = std::min(best, cost);
  }
  return best;
}

// Values that are just as far apart as the bounds allow are common here.
RC_GTEST_PROP(ConsensusProperty, IsTheBestOfAllSubsets, ()) {
  const auto n = *NumUpTo(1, 7);
  const Weights values = LatticeNumbers(n, -6, 6);
  const Weights bounds = LatticeNumbers(n, 1, 3);
  const auto consensus = EstimateConsensus(values, bounds);
  RC_ASSERT(consensus.has_value());
  RC_ASSERT(std::abs(consensus->cost - BestOfAllSubsets(values, bounds)) <
            kTolerance);
}

RC_GTEST_PROP(ExactYawProperty, NoYawIsBetterAndATurnChangesNoCost, ()) {
  const auto n = *NumUpTo(1, 6);
  const Points source = LatticePoints(n), target = LatticePoints(n);
  const Weights weights = LatticeNumbers(n, 0, 3);
  const Weights bounds = LatticeNumbers(n, 1, 2);
  const auto exact = EstimateExactYaw(source, target, weights, bounds);
  const auto cost_at = [&](double yaw) {
    return TruncatedYawCost(source, target, weights, bounds, yaw);
  };
  if (!exact) return;
  RC_ASSERT(std::abs(exact->cost - cost_at(exact->target_from_source)) <
            kTolerance);
  for (int k = -180; k < 180; ++k) {
    RC_ASSERT(exact->cost <= cost_at(k * M_PI / 180) + kTolerance);
  }
  // A turn of the target by a quarter has no rounding.
  const auto turned =
      EstimateExactYaw(source, TurnedByQuarters(target, 1), weights, bounds);
  RC_ASSERT(turned.has_value());
  RC_ASSERT(std::abs(turned->cost - exact->cost) < kTolerance);
}

}  // namespace
}  // namespace quatro::solvers_test
