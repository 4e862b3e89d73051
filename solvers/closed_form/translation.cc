// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "solvers/closed_form/translation.h"

#include <glog/logging.h>

#include <algorithm>
#include <limits>
#include <tuple>
#include <vector>

namespace quatro {
namespace {

// The value at which a measurement enters or leaves the consensus set.
struct IntervalEnd {
  double at = 0.0;
  bool leaves = false;
  double value = 0.0;
  double inverse_bound2 = 0.0;

  // Intervals are closed, so a measurement enters before another leaves at the
  // same value. The other keys make sums independent of the order of
  // measurements.
  friend bool operator<(const IntervalEnd& a, const IntervalEnd& b) {
    return std::tie(a.at, a.leaves, a.value, a.inverse_bound2) <
           std::tie(b.at, b.leaves, b.value, b.inverse_bound2);
  }
};

}  // namespace

std::optional<ConsensusEstimate> EstimateConsensus(
    const Eigen::Ref<const Eigen::VectorXd>& values,
    const Eigen::Ref<const Eigen::VectorXd>& bounds) {
  CHECK_EQ(values.size(), bounds.size());
  const Eigen::Index n = values.size();
  if (n == 0) return std::nullopt;

  std::vector<IntervalEnd> ends;
  ends.reserve(static_cast<std::size_t>(2 * n));
  for (Eigen::Index i = 0; i < n; ++i) {
    const double inverse_bound2 = 1.0 / (bounds[i] * bounds[i]);
    ends.push_back({values[i] - bounds[i], false, values[i], inverse_bound2});
    ends.push_back({values[i] + bounds[i], true, values[i], inverse_bound2});
  }
  std::sort(ends.begin(), ends.end());

  // Weighted sums over the consensus set of 1, (v - at) and (v - at)^2. The
  // origin moves with the sweep, so it is near the whole set, and distant
  // outliers leave no rounding error.
  double weight = 0.0;
  double first = 0.0;
  double second = 0.0;
  double at = 0.0;
  Eigen::Index count = 0;
  double best_cost = std::numeric_limits<double>::infinity();
  double best_value = 0.0;
  for (const IntervalEnd& end : ends) {
    const double step = end.at - at;
    at = end.at;
    if (count == 0) {
      weight = first = second = 0.0;
    } else {
      second += step * (step * weight - 2.0 * first);
      first -= step * weight;
    }
    const double sign = end.leaves ? -1.0 : 1.0;
    const double offset = end.value - at;
    weight += sign * end.inverse_bound2;
    first += sign * end.inverse_bound2 * offset;
    second += sign * end.inverse_bound2 * offset * offset;
    count += end.leaves ? -1 : 1;
    // The set after a removal is also a candidate. The larger set before it was
    // already considered.
    if (count == 0) continue;
    const double mean = first / weight;
    const double cost = second - mean * first + static_cast<double>(n - count);
    if (cost < best_cost) {
      best_cost = cost;
      best_value = at + mean;
    }
  }

  ConsensusEstimate estimate;
  estimate.value = best_value;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double r = (best_value - values[i]) / bounds[i];
    estimate.cost += std::min(r * r, 1.0);
    if (r * r <= 1.0) ++estimate.num_inliers;
  }
  return estimate;
}

std::optional<TranslationEstimate> EstimateTranslation(
    const PointsRef& rotated_source,
    const PointsRef& target,
    double noise_bound) {
  CHECK_EQ(rotated_source.cols(), target.cols());
  const Eigen::Index n = target.cols();
  if (n == 0) return std::nullopt;

  const Eigen::VectorXd bounds = Eigen::VectorXd::Constant(n, noise_bound);
  TranslationEstimate estimate;
  estimate.is_inlier.setConstant(n, true);
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::VectorXd values =
        (target.row(axis) - rotated_source.row(axis)).transpose();
    const auto consensus = EstimateConsensus(values, bounds);
    estimate.target_from_source[axis] = consensus->value;
    estimate.cost[axis] = consensus->cost;
    estimate.is_inlier =
        estimate.is_inlier &&
        (values.array() - consensus->value).abs() <= noise_bound;
  }
  return estimate;
}

}  // namespace quatro
