// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/verdict/verdict.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "robust/estimators/distinct_matches.h"

namespace quatro {
namespace {

long Percent(double share) { return std::lround(100.0 * share); }

// "2.3 m and 180 deg from the pose".
std::string DescribeStep(const Rigid3& from, const Rigid3& to) {
  std::ostringstream text;
  text.precision(2);
  text << (to.translation - from.translation).norm() << " m and "
       << std::lround(AngleBetween(from.rotation, to.rotation) * 180.0 / M_PI)
       << " deg from the pose";
  return text.str();
}

std::string DescribeMatches(const Verdict& verdict) {
  std::ostringstream text;
  text << verdict.num_inliers << " of " << verdict.num_matches
       << " matches agree with the pose, ";
  const double log10_false_alarms =
      verdict.false_alarms.back().log10_false_alarms;
  if (log10_false_alarms >= -1.0) {
    text << "as some pose found by chance would do too";
  } else {
    text << "as one found by chance would in 1 of 1e"
         << std::lround(std::floor(-log10_false_alarms)) << " problems";
  }
  return text.str();
}

// What speaks against the pose, if it does.
std::string DescribeDoubts(const Verdict& verdict, const Rigid3& pose) {
  std::ostringstream text;
  if (verdict.rival && verdict.rival->margin < 2.0) {
    text << "; " << verdict.rival->num_inliers << " agree with another, "
         << DescribeStep(pose, verdict.rival->target_from_source);
  }
  if (!verdict.geometry) return text.str();
  const GeometricEvidence& geometry = *verdict.geometry;
  if (geometry.Distinctness() < 0.1 && geometry.rival.rival_overlap > 0.0) {
    text << "; the scans fit as well "
         << DescribeStep(pose, geometry.rival.rival_target_from_source);
  }
  const auto contradicted = geometry.free_space.ContradictedShare();
  if (contradicted.value_or(0.0) > 0.3) {
    text << "; " << Percent(*contradicted)
         << " % of the surfaces stand where the other scan saw through";
  }
  return text.str();
}

// A direction of the pose that its own inliers do not hold; null if there is
// none, or no covariance.
const UnobservableDirection* FindLoose(const PoseSummary& summary) {
  if (!summary.covariance) return nullptr;
  for (const UnobservableDirection& direction :
       summary.covariance->unobservable) {
    if (direction.reason == UnobservableReason::kNoData ||
        direction.reason == UnobservableReason::kWithinNoise) {
      return &direction;
    }
  }
  return nullptr;
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
  if (!(min_probability >= 0.0 && min_probability <= 1.0)) {
    std::ostringstream problem;
    problem << "min_probability = " << min_probability << ", must be in [0, 1]";
    *error = problem.str();
    return false;
  }
  return rival.IsValid(error);
}

Verdict Judge(const PointsRef& source,
              const PointsRef& target,
              const PoseSummary& summary,
              double noise_bound,
              const std::optional<GeometricEvidence>& geometry,
              const VerdictOptions& options) {
  Verdict verdict;
  if (!summary.IsUsable()) {
    verdict.status = summary.termination == PoseTermination::kDegenerate
                         ? Status::kDegenerate
                         : Status::kInsufficient;
    verdict.reason = summary.message;
    verdict.num_matches = summary.num_matches;
    return verdict;
  }

  const Rigid3& pose = *summary.target_from_source;
  const DistinctMatches all =
      FindDistinctMatches(summary.scale * source, target);
  const DistinctMatches consistent =
      FindDistinctMatches(summary.scale * Columns(source, summary.consistent),
                          Columns(target, summary.consistent));
  if (auto alarms = CliqueFalseAlarms(all.source,
                                      all.target,
                                      consistent.source,
                                      consistent.target,
                                      noise_bound)) {
    verdict.false_alarms.push_back(std::move(*alarms));
  }
  if (auto alarms = RotationFalseAlarms(
          consistent.source, consistent.target, pose, noise_bound)) {
    verdict.false_alarms.push_back(std::move(*alarms));
  }
  verdict.false_alarms.push_back(
      PoseFalseAlarms(all.source, all.target, pose, noise_bound));
  verdict.num_matches = verdict.false_alarms.back().num_tested;
  verdict.num_inliers = verdict.false_alarms.back().num_inliers;
  verdict.rival =
      FindMatchRival(all.source, all.target, pose, noise_bound, options.rival);
  verdict.geometry = geometry;

  verdict.features =
      MakeFeatures(verdict.false_alarms.back().log10_false_alarms,
                   verdict.rival,
                   verdict.geometry);
  verdict.probability = ProbabilityOfSuccess(verdict.features);
  verdict.status = verdict.probability >= options.min_probability
                       ? Status::kRegistered
                       : Status::kAmbiguous;
  verdict.reason = DescribeMatches(verdict);
  if (const UnobservableDirection* loose = FindLoose(summary)) {
    verdict.status = Status::kDegenerate;
    verdict.reason += "; they do not hold the " + loose->Describe();
    return verdict;
  }
  if (geometry) {
    std::ostringstream text;
    text << "; " << Percent(geometry->structure_overlap)
         << " % of what stands in one scan is met in the other";
    verdict.reason += text.str();
  }
  if (!verdict.IsRegistered()) {
    std::ostringstream text;
    text.precision(2);
    text << DescribeDoubts(verdict, pose) << "; right with a probability of "
         << verdict.probability << ", " << options.min_probability
         << " is asked for";
    verdict.reason += text.str();
  }
  return verdict;
}

}  // namespace quatro
