// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/verdict.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <vector>

#include "robust/distinct_matches.h"

namespace quatro {
namespace {

// Comparisons after which the chance of agreement is known well enough; it
// takes crowded or very many matches to reach it.
constexpr Eigen::Index kMaxComparisons = 10'000'000;

// The share of pairings (i, j), i != j, with |q_j - p_i| <= bound on each axis.
// Never zero: one agreement more is assumed than was seen.
double MeasureChanceOfAgreement(const Points& moved,
                                const Points& target,
                                double bound) {
  const Eigen::Index n = moved.cols();
  std::vector<std::array<double, 3>> sorted;
  sorted.reserve(static_cast<std::size_t>(n));
  for (const auto q : target.colwise()) sorted.push_back({q.x(), q.y(), q.z()});
  std::sort(sorted.begin(), sorted.end());

  Eigen::Index num_agreeing = 0;
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
      num_agreeing += std::abs((*it)[1] - p.y()) <= bound &&
                      std::abs((*it)[2] - p.z()) <= bound;
    }
    // Its own match is no pairing at random.
    num_agreeing -=
        (target.col(num_sources) - p).cwiseAbs().maxCoeff() <= bound;
  }
  const auto num_pairings =
      static_cast<double>(num_sources) *
      static_cast<double>(std::max<Eigen::Index>(1, n - 1));
  return std::min(
      1.0,
      static_cast<double>(std::max<Eigen::Index>(0, num_agreeing) + 1) /
          num_pairings);
}

std::string Describe(const Verdict& verdict) {
  std::ostringstream text;
  text << verdict.num_agreeing << " of " << verdict.num_matches
       << " matches agree with the pose, ";
  if (verdict.log10_false_alarms >= -1.0) {
    text << "as some pose found by chance would do too";
  } else {
    text << "as one found by chance would in 1 of 1e"
         << std::lround(std::floor(-verdict.log10_false_alarms)) << " problems";
  }
  return text.str();
}

}  // namespace

const char* StatusName(Status status) {
  switch (status) {
    case Status::kRegistered:
      return "registered";
    case Status::kAmbiguous:
      return "ambiguous";
    case Status::kDegenerate:
      return "degenerate";
    case Status::kInsufficient:
      break;
  }
  return "insufficient";
}

bool VerdictOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  if (!(max_log10_false_alarms <= 0.0)) {
    problem << "max_log10_false_alarms = " << max_log10_false_alarms
            << ", must be <= 0";
  } else if (!(min_structure_overlap >= 0.0 && min_structure_overlap <= 1.0)) {
    problem << "min_structure_overlap = " << min_structure_overlap
            << ", must be in [0, 1]";
  }
  *error = problem.str();
  return error->empty();
}

double Log10BinomialTail(Eigen::Index n, Eigen::Index k, double p) {
  if (k <= 0 || p >= 1.0) return 0.0;
  if (k > n || p <= 0.0) return -std::numeric_limits<double>::infinity();
  // From the first term on, each is the one before it times (n-i)/(i+1)
  // p/(1-p).
  const auto log_term = [&](Eigen::Index i) {
    const auto x = static_cast<double>(i);
    const auto m = static_cast<double>(n);
    return std::lgamma(m + 1.0) - std::lgamma(x + 1.0) -
           std::lgamma(m - x + 1.0) + x * std::log(p) +
           (m - x) * std::log1p(-p);
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

Verdict JudgeConsensus(const PointsRef& source,
                       const PointsRef& target,
                       const Rigid3& target_from_source,
                       double noise_bound,
                       const VerdictOptions& options) {
  const DistinctMatches matches = FindDistinctMatches(source, target);
  const Points moved = target_from_source.Apply(matches.source);
  Verdict verdict;
  verdict.num_matches = moved.cols();
  verdict.num_agreeing =
      ((matches.target - moved).cwiseAbs().colwise().maxCoeff().array() <=
       noise_bound)
          .count();
  verdict.chance_of_agreement =
      MeasureChanceOfAgreement(moved, matches.target, noise_bound);

  // Equation (1).
  const auto n = static_cast<double>(verdict.num_matches);
  verdict.log10_false_alarms = std::log10(std::max(1.0, n * (n - 1.0) / 2.0)) +
                               Log10BinomialTail(verdict.num_matches - 2,
                                                 verdict.num_agreeing - 2,
                                                 verdict.chance_of_agreement);
  verdict.status = verdict.log10_false_alarms <= options.max_log10_false_alarms
                       ? Status::kRegistered
                       : Status::kAmbiguous;
  verdict.reason = Describe(verdict);
  return verdict;
}

Verdict JudgeSummary(const PointsRef& source,
                     const PointsRef& target,
                     const PoseSummary& summary,
                     double noise_bound,
                     const VerdictOptions& options) {
  if (summary.IsUsable()) {
    return JudgeConsensus(summary.scale * source,
                          target,
                          *summary.target_from_source,
                          noise_bound,
                          options);
  }
  Verdict verdict;
  verdict.status = summary.termination == PoseTermination::kDegenerate
                       ? Status::kDegenerate
                       : Status::kInsufficient;
  verdict.reason = summary.message;
  verdict.num_matches = summary.num_distinct;
  return verdict;
}

void AddOverlap(const std::optional<double>& structure_overlap,
                const VerdictOptions& options,
                Verdict* verdict) {
  verdict->structure_overlap = structure_overlap;
  if (!structure_overlap) return;
  std::ostringstream text;
  text << "; " << std::lround(100.0 * *structure_overlap)
       << " % of what stands in one scan is met in the other";
  if (*structure_overlap < options.min_structure_overlap) {
    text << ", a right pose meets at least "
         << std::lround(100.0 * options.min_structure_overlap) << " %";
    if (verdict->IsRegistered()) verdict->status = Status::kAmbiguous;
  }
  verdict->reason += text.str();
}

}  // namespace quatro
