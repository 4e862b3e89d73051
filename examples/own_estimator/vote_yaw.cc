// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Adds an estimator to every table of quatro_experiment.

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "experiments/programs/experiment_program.h"
#include "features/base/random.h"
#include "robust/estimators/consensus.h"
#include "solvers/closed_form/translation.h"
#include "solvers/closed_form/yaw_translation.h"

namespace {

constexpr int kNumBins = 720;
constexpr int kNumPairs = 20000;

// Returns the yaw that most pairs of matches vote for [rad]. A pair votes if
// its planar lengths in both scans differ by at most twice the noise bound.
double VoteYaw(const quatro::PointsRef& source,
               const quatro::PointsRef& target,
               const quatro::QuatroOptions& options) {
  std::array<int, kNumBins> votes{};
  quatro::Random random(options.seed);
  const auto num_matches = static_cast<std::uint64_t>(source.cols());
  for (int k = 0; k < kNumPairs; ++k) {
    const auto i = static_cast<Eigen::Index>(random.Below(num_matches));
    const auto j = static_cast<Eigen::Index>(random.Below(num_matches));
    const Eigen::Vector2d a = (source.col(i) - source.col(j)).head<2>();
    const Eigen::Vector2d b = (target.col(i) - target.col(j)).head<2>();
    const double gap = std::abs(a.norm() - b.norm());
    if (a.norm() < 1.0 || gap > 2.0 * options.noise_bound) continue;
    const double yaw = std::atan2(b.y(), b.x()) - std::atan2(a.y(), a.x());
    const double turns = yaw / (2.0 * M_PI);
    const auto bin = static_cast<int>(kNumBins * (turns - std::floor(turns)));
    ++votes[static_cast<std::size_t>(std::min(bin, kNumBins - 1))];
  }
  const auto most = std::max_element(votes.begin(), votes.end());
  const auto bin = static_cast<double>(most - votes.begin());
  return (bin + 0.5) * 2.0 * M_PI / kNumBins;
}

quatro::PoseSummary SolveByVotes(const quatro::PointsRef& source,
                                 const quatro::PointsRef& target,
                                 const quatro::QuatroOptions& options) {
  quatro::PoseSummary summary;
  summary.num_needed = 2;
  summary.num_matches = source.cols();
  if (source.cols() < 2) {
    summary.termination = quatro::PoseTermination::kInsufficient;
    summary.message = "at least two matches are needed";
    return summary;
  }
  quatro::Rigid3 pose;
  pose.rotation = quatro::RotationZ(VoteYaw(source, target, options));
  pose.translation = quatro::EstimateTranslation(
                         pose.rotation * source, target, options.noise_bound)
                         ->target_from_source;

  // Fit the pose to its inliers by least squares, twice.
  for (int round = 0; round < 2; ++round) {
    const auto inliers =
        quatro::FindInliers(source, target, pose, options.noise_bound);
    const auto fit = quatro::EstimateYawTranslation(
        source(Eigen::all, inliers),
        target(Eigen::all, inliers),
        quatro::Weights::Ones(static_cast<Eigen::Index>(inliers.size())));
    if (fit) pose = fit->target_from_source;
  }
  summary.translation_inliers =
      quatro::FindInliers(source, target, pose, options.noise_bound);
  summary.consistent = summary.translation_inliers;
  summary.num_consistent = static_cast<Eigen::Index>(summary.consistent.size());
  summary.num_translation_inliers = summary.num_consistent;
  summary.target_from_source = pose;
  summary.model = quatro::PoseModel::kYawTranslation;
  summary.termination = quatro::PoseTermination::kSolved;
  summary.message = "solved";
  return summary;
}

quatro::PoseSolver MakeVoteYaw(const quatro::QuatroOptions& options) {
  return [options](const quatro::PointsRef& source,
                   const quatro::PointsRef& target) {
    return SolveByVotes(source, target, options);
  };
}

}  // namespace

int main(int argc, char** argv) {
  return quatro::RunExperimentProgram(
      argc, argv, {{"vote_yaw", "the yaw with the most votes", MakeVoteYaw}});
}
