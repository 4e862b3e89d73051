// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/peers/peer_summary.h"

#include <exception>

namespace quatro {
namespace {

constexpr int kNumNeeded = 3;

}  // namespace

PoseSummary SolveByPeer(const PointsRef& source,
                        const PointsRef& target,
                        double noise_bound,
                        const std::string& library,
                        const std::string& stage,
                        const std::function<Rigid3()>& solve) {
  PoseSummary summary;
  summary.num_needed = kNumNeeded;
  summary.num_matches = source.cols();
  if (!source.allFinite() || !target.allFinite()) {
    summary.message = "a matched point is not finite";
    return summary;
  }
  summary.termination = PoseTermination::kInsufficient;
  summary.message = library + " found no pose with at least three inliers";
  if (source.cols() < kNumNeeded) return summary;
  Stopwatch stopwatch;
  Rigid3 pose;
  try {
    pose = solve();
  } catch (const std::exception& exception) {
    summary.message = library + ": " + exception.what();
    return summary;
  }
  summary.stage_times.push_back({stage, stopwatch.Lap()});
  const Eigen::VectorXd errors =
      (target - pose.Apply(source)).colwise().norm().transpose();
  for (Eigen::Index i = 0; i < errors.size(); ++i) {
    if (errors[i] <= noise_bound) summary.translation_inliers.push_back(i);
  }
  summary.num_translation_inliers =
      static_cast<Eigen::Index>(summary.translation_inliers.size());
  summary.consistent = summary.translation_inliers;
  summary.num_consistent = summary.num_translation_inliers;
  summary.num_rotation_inliers = summary.num_translation_inliers;
  if (summary.num_consistent < kNumNeeded) return summary;
  summary.target_from_source = pose;
  summary.termination = PoseTermination::kSolved;
  summary.message = "solved";
  return summary;
}

}  // namespace quatro
