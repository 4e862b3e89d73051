// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/verdict/verdict.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "features/base/degree.h"
#include "robust/estimators/distinct_matches.h"

namespace quatro {
namespace {

long Percent(double share) { return std::lround(100.0 * share); }

// "2.3 m and 180 deg from this one".
std::string DescribeStep(const Rigid3& from, const Rigid3& to) {
  std::ostringstream text;
  text.precision(2);
  text << (to.translation - from.translation).norm() << " m and "
       << std::lround(AngleBetween(from.rotation, to.rotation) * 180.0 / M_PI)
       << " deg from this one";
  return text.str();
}

std::string DescribeMatches(const Verdict& verdict) {
  std::ostringstream text;
  text << verdict.num_inliers << " of " << verdict.num_matches
       << " matches are inliers; chance alone ";
  const double log10_false_alarms =
      verdict.false_alarms.back().log10_false_alarms;
  if (log10_false_alarms >= -1.0) {
    text << "could produce such a consensus, too";
  } else {
    text << "would produce such a consensus once in 1e"
         << std::lround(std::floor(-log10_false_alarms)) << " problems";
  }
  return text.str();
}

// The reasons to doubt the pose, empty if there are none.
std::string DescribeDoubts(const Verdict& verdict, const Rigid3& pose) {
  std::ostringstream text;
  if (verdict.rival && verdict.rival->margin < 2.0) {
    text << "; " << verdict.rival->num_inliers
         << " matches are inliers of another pose, "
         << DescribeStep(pose, verdict.rival->target_from_source);
  }
  if (!verdict.geometry) return text.str();
  const GeometricEvidence& geometry = *verdict.geometry;
  if (geometry.Distinctness() < 0.1 && geometry.rival.rival_overlap > 0.0) {
    text << "; the scans overlap as well at a pose "
         << DescribeStep(pose, geometry.rival.rival_target_from_source);
  }
  const auto contradicted = geometry.free_space.ContradictedShare();
  if (contradicted.value_or(0.0) > 0.3) {
    text
        << "; " << Percent(*contradicted)
        << " % of the surfaces lie in space that the other scan saw to be free";
  }
  return text.str();
}

// A direction of the pose that the inliers do not constrain. Returns null if
// there is none, or if there is no covariance.
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

SuccessTolerance ToleranceOf(double noise_bound) {
  return {20.0 / 3.0 * noise_bound, 10.0 * kDegree};
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
  verdict.tolerance = ToleranceOf(noise_bound);
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
      FindDistinctMatches(summary.scale * source, target, noise_bound);
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
    verdict.reason +=
        "; the inliers do not constrain the " + loose->Describe() + ".";
    return verdict;
  }
  if (geometry) {
    std::ostringstream text;
    text << ". " << Percent(geometry->structure_overlap)
         << " % of the structure overlaps";
    if (geometry->search) {
      text << ", and " << geometry->search->num_guided_inliers << " of "
           << geometry->search->num_guided_matches
           << " guided matches are inliers";
    }
    verdict.reason += text.str();
  }
  if (!verdict.IsRegistered()) {
    std::ostringstream text;
    text.precision(2);
    text << DescribeDoubts(verdict, pose)
         << "; the probability of a correct pose is " << verdict.probability
         << ", below the required " << options.min_probability;
    verdict.reason += text.str();
  }
  verdict.reason += ".";
  return verdict;
}

}  // namespace quatro
