// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/verdict/false_alarms.h"

#include <glog/logging.h>

#include <algorithm>
#include <array>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "features/base/random.h"
#include "robust/estimators/tims.h"

namespace quatro {
namespace {

// Number of comparisons that gives the probability c with sufficient accuracy.
// It is reached only with dense or very many matches.
constexpr Eigen::Index kMaxComparisons = 10'000'000;

// Number of pairs that gives the probability e with sufficient accuracy.
constexpr int kNumRandomPairs = 20'000;

// Only this many matches of a larger consensus are checked to be a clique.
constexpr Eigen::Index kMaxChecked = 1000;

// The share of pairings (i, j), i != j, with |q_j - p_i| <= bound on each axis.
// One is added to the count, so the share is never zero.
double MeasureChanceOfAgreement(const Points& moved,
                                const PointsRef& target,
                                double bound) {
  const Eigen::Index n = moved.cols();
  std::vector<std::array<double, 3>> sorted;
  sorted.reserve(static_cast<std::size_t>(n));
  for (const auto q : target.colwise()) sorted.push_back({q.x(), q.y(), q.z()});
  std::sort(sorted.begin(), sorted.end());

  Eigen::Index num_inliers = 0;
  Eigen::Index num_sources = 0;
  for (Eigen::Index compared = 0; num_sources < n && compared < kMaxComparisons;
       ++num_sources) {
    const Eigen::Vector3d p = moved.col(num_sources);
    auto it =
        std::lower_bound(sorted.begin(),
                         sorted.end(),
                         p.x() - bound,
                         [](const auto& q, double x) { return q[0] < x; });
    for (; it != sorted.end() && (*it)[0] <= p.x() + bound; ++it, ++compared) {
      num_inliers += std::abs((*it)[1] - p.y()) <= bound &&
                     std::abs((*it)[2] - p.z()) <= bound;
    }
    // Excludes i = j, which is not a random pairing.
    num_inliers -= (target.col(num_sources) - p).cwiseAbs().maxCoeff() <= bound;
  }
  const auto num_pairings =
      static_cast<double>(num_sources) *
      static_cast<double>(std::max<Eigen::Index>(1, n - 1));
  return std::min(
      1.0,
      static_cast<double>(std::max<Eigen::Index>(0, num_inliers) + 1) /
          num_pairings);
}

bool AreConsistent(const Eigen::Vector3d& a,
                   const Eigen::Vector3d& b,
                   double noise_bound) {
  return std::abs(a.norm() - b.norm()) <= 2.0 * noise_bound;
}

// The share of random pairs of differences, one of sources and one of targets,
// whose lengths are consistent. Never zero, as above. The draws are the same
// each time.
double MeasureChanceOfConsistency(const PointsRef& source,
                                  const PointsRef& target,
                                  double noise_bound) {
  const auto n = static_cast<std::uint64_t>(source.cols());
  Random random(0);
  const auto difference = [&](const PointsRef& points) -> Eigen::Vector3d {
    const auto i = static_cast<Eigen::Index>(random.Below(n));
    auto j = static_cast<Eigen::Index>(random.Below(n - 1));
    j += j >= i;
    return points.col(i) - points.col(j);
  };
  int num_consistent = 0;
  for (int k = 0; k < kNumRandomPairs; ++k) {
    const Eigen::Vector3d a = difference(source);
    num_consistent += AreConsistent(a, difference(target), noise_bound);
  }
  return std::min(1.0, (num_consistent + 1.0) / kNumRandomPairs);
}

double Log10(Eigen::Index count) {
  return std::log10(std::max(1.0, static_cast<double>(count)));
}

// log10 of n (n - 1) / 2, which can overflow 64-bit integers; 0 if there are no
// pairs.
double Log10Pairs(Eigen::Index count) {
  const auto n = static_cast<double>(count);
  return std::log10(std::max(1.0, n * (n - 1.0) / 2.0));
}

}  // namespace

std::optional<FalseAlarms> CliqueFalseAlarms(const PointsRef& source,
                                             const PointsRef& target,
                                             const PointsRef& consistent_source,
                                             const PointsRef& consistent_target,
                                             double noise_bound) {
  CHECK_EQ(source.cols(), target.cols());
  CHECK_EQ(consistent_source.cols(), consistent_target.cols());
  const Eigen::Index size = consistent_source.cols();
  if (size < 2 || source.cols() < 2) return std::nullopt;
  const Eigen::Index num_checked = std::min(size, kMaxChecked);
  // Allows for a consistency graph computed in single precision.
  const double bound = noise_bound * (1.0 + 1e-4);
  for (Eigen::Index i = 0; i < num_checked; ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      if (!AreConsistent(consistent_source.col(i) - consistent_source.col(j),
                         consistent_target.col(i) - consistent_target.col(j),
                         bound)) {
        return std::nullopt;
      }
    }
  }
  FalseAlarms alarms;
  alarms.stage = "clique";
  alarms.num_tested = source.cols();
  alarms.num_inliers = size;
  const double e = MeasureChanceOfConsistency(source, target, noise_bound);
  alarms.chance = e * e;
  alarms.log10_false_alarms =
      Log10Pairs(alarms.num_tested) + std::log10(e) +
      Log10BinomialTail(alarms.num_tested - 2, size - 2, alarms.chance);
  return alarms;
}

std::optional<FalseAlarms> RotationFalseAlarms(
    const PointsRef& consistent_source,
    const PointsRef& consistent_target,
    const Rigid3& target_from_source,
    double noise_bound) {
  CHECK_EQ(consistent_source.cols(), consistent_target.cols());
  const auto pairs = MakeTimPairs(
      consistent_source.cols(), TimLayout::kRing, /*num_random=*/0, /*seed=*/0);
  const Points turned =
      target_from_source.rotation * ComputeTims(consistent_source, pairs);
  const Points beta = ComputeTims(consistent_target, pairs);
  const double bound = 2.0 * noise_bound;
  FalseAlarms alarms;
  alarms.stage = "rotation";
  double sum = 0.0;
  for (Eigen::Index k = 0; k < beta.cols(); ++k) {
    const Eigen::Vector2d p = turned.col(k).head<2>();
    const Eigen::Vector2d q = beta.col(k).head<2>();
    // Equation (2) of solvers/closed_form/exact_yaw.h.
    const double cosine = (p.squaredNorm() + q.squaredNorm() - bound * bound) /
                          (2.0 * p.norm() * q.norm());
    if (!(std::abs(cosine) < 1.0)) continue;
    ++alarms.num_tested;
    sum += std::acos(cosine) / M_PI;
    alarms.num_inliers += (q - p).norm() <= bound;
  }
  if (alarms.num_tested == 0) return std::nullopt;
  alarms.chance = sum / static_cast<double>(alarms.num_tested);
  alarms.log10_false_alarms =
      Log10(alarms.num_tested) + Log10BinomialTail(alarms.num_tested - 1,
                                                   alarms.num_inliers - 1,
                                                   alarms.chance);
  return alarms;
}

FalseAlarms PoseFalseAlarms(const PointsRef& source,
                            const PointsRef& target,
                            const Rigid3& target_from_source,
                            double noise_bound) {
  CHECK_EQ(source.cols(), target.cols());
  const Points moved = target_from_source.Apply(source);
  FalseAlarms alarms;
  alarms.stage = "pose";
  alarms.num_tested = moved.cols();
  alarms.num_inliers =
      ((target - moved).cwiseAbs().colwise().maxCoeff().array() <= noise_bound)
          .count();
  alarms.chance = MeasureChanceOfAgreement(moved, target, noise_bound);
  alarms.log10_false_alarms =
      Log10Pairs(alarms.num_tested) + Log10BinomialTail(alarms.num_tested - 2,
                                                        alarms.num_inliers - 2,
                                                        alarms.chance);
  return alarms;
}

double Log10BinomialTail(Eigen::Index n, Eigen::Index k, double p) {
  if (k <= 0 || p >= 1.0) return 0.0;
  if (k > n || p <= 0.0) return -std::numeric_limits<double>::infinity();
  // After the first term, each term is the previous one times (n - i) / (i + 1)
  // * p / (1 - p).
  const auto log_term = [&](Eigen::Index i) {
    const auto x = static_cast<double>(i);
    const auto m = static_cast<double>(n);
    using boost::math::lgamma;
    return lgamma(m + 1.0) - lgamma(x + 1.0) - lgamma(m - x + 1.0) +
           x * std::log(p) + (m - x) * std::log1p(-p);
  };
  const double first = log_term(k);
  double sum = 1.0;
  double term = 1.0;
  for (Eigen::Index i = k; i < n; ++i) {
    term *=
        static_cast<double>(n - i) / static_cast<double>(i + 1) * p / (1.0 - p);
    sum += term;
    if (term < 1e-17 * sum) break;
  }
  return std::min(0.0, (first + std::log(sum)) / std::log(10.0));
}

}  // namespace quatro
