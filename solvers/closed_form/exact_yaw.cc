// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "solvers/closed_form/exact_yaw.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>
#include <vector>

#include "solvers/closed_form/yaw.h"

namespace quatro {
namespace {

// Costs that differ by less than this, relative to the total weight, are equal
// up to rounding.
constexpr double kTie = 1e-12;

// One measurement of (1). Squared lengths are multiplied by w / c^2.
struct Arc {
  double phi = 0.0;           // [rad]
  double length_error = 0.0;  // (a - b)^2
  double pull = 0.0;          // 2 a b
  double weight = 0.0;
};

struct ArcEnd {
  double at = 0.0;
  bool leaves = false;
  std::int32_t arc = 0;

  // Arcs are closed, so an arc enters before another leaves at the same angle.
  friend bool operator<(const ArcEnd& x, const ArcEnd& y) {
    return std::tie(x.at, x.leaves, x.arc) < std::tie(y.at, y.leaves, y.arc);
  }
};

// The sinusoid of a set of arcs about a reference angle theta0,
//   g(theta0 + d) = at_reference + cosine (1 - cos d) + sine sin d.
// The reference moves with the sweep, so at_reference is a sum of small
// residuals and nothing cancels.
//
// Removing an arc leaves rounding errors of the arc's own size in the sums. So
// they are recomputed once the removed arcs outweigh the remaining ones by a
// factor of four. Then a long measurement does not hide the short ones, at a
// cost of O(1) per arc if lengths are comparable.
class Sinusoid {
 public:
  explicit Sinusoid(const std::vector<Arc>& arcs)
      : arcs_(arcs), position_(arcs.size()) {}

  void Enter(std::int32_t arc) {
    position_[static_cast<std::size_t>(arc)] = set_.size();
    set_.push_back(arc);
    Add(arc, 1.0);
  }

  void Leave(std::int32_t arc) {
    const std::size_t position = position_[static_cast<std::size_t>(arc)];
    set_[position] = set_.back();
    position_[static_cast<std::size_t>(set_.back())] = position;
    set_.pop_back();
    Add(arc, -1.0);
    removed_pull_ += arcs_[static_cast<std::size_t>(arc)].pull;
    if (!(removed_pull_ > 4.0 * pull_) && !set_.empty()) return;
    at_reference_ = cosine_ = sine_ = pull_ = removed_pull_ = 0.0;
    for (const std::int32_t i : set_) Add(i, 1.0);
  }

  bool IsEmpty() const { return set_.empty(); }

  void MoveReference(double theta) {
    const double step = theta - reference_;
    reference_ = theta;
    const double half = std::sin(0.5 * step);
    const double versine = 2.0 * half * half;  // 1 - cos(step)
    const double s = std::sin(step);
    at_reference_ += cosine_ * versine + sine_ * s;
    const double cosine = cosine_ - cosine_ * versine - sine_ * s;
    sine_ += cosine_ * s - sine_ * versine;
    cosine_ = cosine;
  }

  // at_reference + C - |(C, S)| with C = cosine_ and S = sine_, in a form that
  // does not cancel.
  double Minimum() const {
    const double length = std::hypot(cosine_, sine_);
    if (!(cosine_ > 0.0)) return at_reference_ + cosine_ - length;
    return at_reference_ - sine_ * sine_ / (cosine_ + length);
  }

  double Argmin() const { return reference_ + std::atan2(-sine_, cosine_); }

 private:
  void Add(std::int32_t index, double sign) {
    const Arc& arc = arcs_[static_cast<std::size_t>(index)];
    const double u = reference_ - arc.phi;
    const double half = std::sin(0.5 * u);
    at_reference_ += sign * (arc.length_error + arc.pull * 2.0 * half * half);
    cosine_ += sign * arc.pull * std::cos(u);
    sine_ += sign * arc.pull * std::sin(u);
    pull_ += sign * arc.pull;
  }

  const std::vector<Arc>& arcs_;
  std::vector<std::int32_t> set_;
  std::vector<std::size_t>
      position_;  // Position in set_ of each arc of the set.
  double reference_ = -M_PI;
  double at_reference_ = 0.0;
  double cosine_ = 0.0;
  double sine_ = 0.0;
  double pull_ = 0.0;          // Total pull of the set.
  double removed_pull_ = 0.0;  // Removed since the sums were computed.
};

Eigen::ArrayXd SquaredResiduals(const PointsRef& source,
                                const PointsRef& target,
                                const WeightsRef& noise_bounds,
                                double yaw) {
  const double c = std::cos(yaw);
  const double s = std::sin(yaw);
  const auto x = target.row(0) - (c * source.row(0) - s * source.row(1));
  const auto y = target.row(1) - (s * source.row(0) + c * source.row(1));
  return (x.array().square() + y.array().square()).transpose() /
         noise_bounds.array().square();
}

// The arcs, their ends in order, and the state at -pi, where the sweep starts.
struct Circle {
  std::vector<Arc> arcs;
  std::vector<ArcEnd> ends;
  std::vector<std::int32_t> first_set;  // The arcs that contain -pi.
  double outlier_weight = 0.0;          // Weight of the other arcs.
};

Circle MakeCircle(const PointsRef& source,
                  const PointsRef& target,
                  const WeightsRef& weights,
                  const WeightsRef& noise_bounds) {
  Circle circle;
  for (Eigen::Index k = 0; k < source.cols(); ++k) {
    const double sx = source(0, k);
    const double sy = source(1, k);
    const double tx = target(0, k);
    const double ty = target(1, k);
    const double a = std::hypot(sx, sy);
    const double b = std::hypot(tx, ty);
    const double bound2 = noise_bounds[k] * noise_bounds[k];
    const double scale = weights[k] / bound2;
    const double pull = 2.0 * a * b;
    // Equation (2) by the half angle, which keeps its digits for narrow arcs:
    // sin^2(half_width / 2) = (c^2 - (a - b)^2) / (4 a b).
    const double room = bound2 - (a - b) * (a - b);
    if (!(weights[k] > 0.0) || !(pull > 0.0) || !(room >= 0.0)) continue;
    if (!std::isfinite(pull * scale)) continue;  // Overflow.
    const double phi = std::atan2(sx * ty - sy * tx, sx * tx + sy * ty);
    const auto index = static_cast<std::int32_t>(circle.arcs.size());
    circle.arcs.push_back(
        {phi, (a - b) * (a - b) * scale, pull * scale, weights[k]});
    if (room >= 2.0 * pull) {
      circle.first_set.push_back(index);
      continue;
    }
    circle.outlier_weight += weights[k];
    const double half_width = 2.0 * std::asin(std::sqrt(room / (2.0 * pull)));
    double begin = phi - half_width;
    double end = phi + half_width;
    if (begin < -M_PI) begin += 2.0 * M_PI;
    if (end > M_PI) end -= 2.0 * M_PI;
    circle.ends.push_back({begin, false, index});
    circle.ends.push_back({end, true, index});
    if (begin > end) {  // The arc contains -pi.
      circle.first_set.push_back(index);
      circle.outlier_weight -= weights[k];
    }
  }
  std::sort(circle.ends.begin(), circle.ends.end());
  return circle;
}

// The yaw with the least cost over all sets of arcs that the sweep visits.
double SweepYaws(const Circle& circle, double total_weight) {
  double outlier_weight = circle.outlier_weight;
  Sinusoid sinusoid(circle.arcs);
  for (const std::int32_t arc : circle.first_set) sinusoid.Enter(arc);
  const double tie = kTie * total_weight;
  double best_cost = std::numeric_limits<double>::infinity();
  double best_yaw = 0.0;
  const auto consider = [&] {
    if (sinusoid.IsEmpty()) return;
    const double cost = sinusoid.Minimum() + outlier_weight;
    if (cost < best_cost - tie) {
      best_cost = cost;
      best_yaw = sinusoid.Argmin();
    }
  };
  consider();
  for (const ArcEnd& end : circle.ends) {
    const Arc& arc = circle.arcs[static_cast<std::size_t>(end.arc)];
    sinusoid.MoveReference(end.at);
    if (end.leaves) {
      sinusoid.Leave(end.arc);
      outlier_weight += arc.weight;
    } else {
      sinusoid.Enter(end.arc);
      outlier_weight -= arc.weight;
    }
    consider();
  }
  return best_yaw;
}

}  // namespace

double TruncatedYawCost(const PointsRef& source,
                        const PointsRef& target,
                        const WeightsRef& weights,
                        const WeightsRef& noise_bounds,
                        double yaw) {
  return SquaredResiduals(source, target, noise_bounds, yaw)
      .min(1.0)
      .matrix()
      .dot(weights);
}

std::optional<ExactYawEstimate> EstimateExactYaw(
    const PointsRef& source,
    const PointsRef& target,
    const WeightsRef& weights,
    const WeightsRef& noise_bounds) {
  CHECK_EQ(source.cols(), target.cols());
  CHECK_EQ(source.cols(), weights.size());
  CHECK_EQ(source.cols(), noise_bounds.size());
  if (!source.allFinite() || !target.allFinite() || !weights.allFinite() ||
      !noise_bounds.allFinite()) {
    return std::nullopt;
  }

  const Circle circle = MakeCircle(source, target, weights, noise_bounds);
  if (circle.arcs.empty()) return std::nullopt;
  const double best_yaw = SweepYaws(circle, weights.sum());

  // Solves once more with the inliers found, which removes the rounding of the
  // running sums. This can only lower the cost.
  ExactYawEstimate estimate;
  estimate.target_from_source = std::remainder(best_yaw, 2.0 * M_PI);
  const auto evaluate = [&](double yaw) {
    return TruncatedYawCost(source, target, weights, noise_bounds, yaw);
  };
  estimate.cost = evaluate(estimate.target_from_source);
  const auto inliers_at = [&](double yaw) {
    return (SquaredResiduals(source, target, noise_bounds, yaw) <= 1.0).eval();
  };
  estimate.is_inlier = inliers_at(estimate.target_from_source);
  const Weights inlier_weights = estimate.is_inlier.select(
      weights.array() / noise_bounds.array().square(), 0.0);
  if (const auto refined = EstimateYaw(source, target, inlier_weights)) {
    const double cost = evaluate(refined->target_from_source);
    if (cost < estimate.cost) {
      estimate.cost = cost;
      estimate.target_from_source = refined->target_from_source;
      estimate.is_inlier = inliers_at(estimate.target_from_source);
    }
  }
  estimate.num_inliers = estimate.is_inlier.count();
  return estimate;
}

}  // namespace quatro
