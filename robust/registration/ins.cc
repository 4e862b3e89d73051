// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/registration/ins.h"

#include <array>
#include <cmath>
#include <optional>
#include <sstream>
#include <utility>
#include <vector>

#include "features/base/stopwatch.h"
#include "robust/estimators/consensus.h"
#include "robust/estimators/distinct_matches.h"
#include "solvers/ceres/ins_refinement.h"

namespace quatro {
namespace {

// The noise bound in standard deviations of an inlier, unless
// InsOptions::match_std is set.
constexpr double kSigmasInBound = 3.0;

// Inlier bounds of the alternation between inliers and pose [noise bounds]. The
// first schedule reaches farther. The second never increases the cost.
using Schedule = std::array<double, 6>;
constexpr Schedule kSchedules[] = {{2.0, 1.5, 1.0, 1.0, 1.0, 1.0},
                                   {1.0, 1.0, 1.0, 1.0, 1.0, 1.0}};

// The cost (1) of solvers/ceres/ins_refinement.h over all matches, truncated at
// the noise bound.
double FusedCost(const DistinctMatches& matches,
                 const Rigid3& pose,
                 double noise_bound,
                 double match_std,
                 const VerticalPrior& prior) {
  const double sigmas = noise_bound / match_std;
  return sigmas * sigmas *
             ConsensusCost(matches.source, matches.target, pose, noise_bound) +
         prior.Cost(pose.rotation);
}

std::optional<Rigid3> Refine(const DistinctMatches& matches,
                             Rigid3 pose,
                             double noise_bound,
                             double match_std,
                             const VerticalPrior& prior,
                             const Schedule& schedule) {
  std::vector<Eigen::Index> before;
  for (const double factor : schedule) {
    std::vector<Eigen::Index> inliers = FindWithinBall(
        matches.source, matches.target, pose, factor * noise_bound);
    if (factor == 1.0 && inliers == before) break;
    const auto refined = RefineWithIns(Columns(matches.source, inliers),
                                       Columns(matches.target, inliers),
                                       match_std,
                                       pose,
                                       prior);
    if (!refined) return std::nullopt;
    pose = refined->target_from_source;
    before = std::move(inliers);
  }
  return pose;
}

// Refines the pose with the INS as a prior. Matches and pose are in the level
// frames, where z is up.
void Fuse(const PointsRef& source,
          const PointsRef& target,
          double noise_bound,
          const InsOptions& ins,
          PoseSummary* summary) {
  const DistinctMatches matches =
      FindDistinctMatches(summary->scale * source, target, noise_bound);
  const double match_std =
      ins.match_std > 0.0 ? ins.match_std : noise_bound / kSigmasInBound;
  VerticalPrior prior;
  prior.angle_std =
      std::sqrt(2.0) * ins.attitude_std;  // Both attitudes have errors.
  const Rigid3 start = *summary->target_from_source;
  bool is_refined = false;
  std::optional<Rigid3> fused;
  double least = FusedCost(matches, start, noise_bound, match_std, prior);
  for (const Schedule& schedule : kSchedules) {
    const auto refined =
        Refine(matches, start, noise_bound, match_std, prior, schedule);
    if (!refined) continue;
    is_refined = true;
    const double cost =
        FusedCost(matches, *refined, noise_bound, match_std, prior);
    if (!(cost < least)) continue;
    least = cost;
    fused = refined;
  }
  if (!fused) {
    summary->message += is_refined ? "; fusing with the INS gave nothing better"
                                   : "; too few inliers to fuse with the INS";
    return;
  }
  summary->message += "; fused with the INS";
  if (!summary->unpolished_target_from_source) {
    summary->unpolished_target_from_source = start;
  }
  summary->target_from_source = *fused;
  summary->model = PoseModel::kRigid;
  summary->vertical = prior;
  const auto inliers =
      FindInliers(matches.source, matches.target, *fused, noise_bound);
  summary->num_translation_inliers = static_cast<Eigen::Index>(inliers.size());
  summary->translation_inliers = InputColumns(matches, inliers);
}

bool IsFinite(const Attitude& attitude) {
  return std::isfinite(attitude.roll) && std::isfinite(attitude.pitch) &&
         std::isfinite(attitude.yaw);
}

}  // namespace

bool InsOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  if (!IsFinite(source_attitude)) {
    problem << "ins.source_attitude must be finite";
  } else if (!IsFinite(target_attitude)) {
    problem << "ins.target_attitude must be finite";
  } else if (!(attitude_std > 0.0 && attitude_std <= M_PI)) {
    problem << "ins.attitude_std = " << attitude_std << ", must be in (0, pi]";
  } else if (!(match_std >= 0.0 && std::isfinite(match_std))) {
    problem << "ins.match_std = " << match_std << ", must be >= 0 and finite";
  } else if (!(std::abs(up.norm() - 1.0) <= 1e-6)) {
    problem << "ins.up = (" << up.transpose() << "), must be a unit vector";
  }
  *error = problem.str();
  return error->empty();
}

bool InsOptions::IsPlain() const {
  return mode == InsMode::kNone && up == Eigen::Vector3d::UnitZ();
}

LevelFrames MakeLevelFrames(const InsOptions& ins) {
  const Eigen::Matrix3d body_from_cloud =
      RotationBetween(ins.up, Eigen::Vector3d::UnitZ());
  const Attitude& source = ins.source_attitude;
  const Attitude& target = ins.target_attitude;
  switch (ins.mode) {
    case InsMode::kRelative:
      return {RelativeTilt(source, target) * body_from_cloud, body_from_cloud};
    case InsMode::kLeveled:
    case InsMode::kFused:
      return {LevelFromBody(source.roll, source.pitch) * body_from_cloud,
              LevelFromBody(target.roll, target.pitch) * body_from_cloud};
    case InsMode::kNone:
      break;
  }
  return {body_from_cloud, body_from_cloud};
}

PoseSummary SolveLevel(const PointsRef& source,
                       const PointsRef& target,
                       const PoseSolver& solver,
                       double noise_bound,
                       const InsOptions& ins) {
  PoseSummary summary = solver(source, target);
  if (!summary.IsUsable() || ins.mode == InsMode::kNone) return summary;
  if (summary.model == PoseModel::kYawTranslation) {
    summary.vertical.emplace();
    summary.vertical->angle_std = std::sqrt(2.0) * ins.attitude_std;
  }
  if (ins.mode == InsMode::kFused) {
    Stopwatch stopwatch;
    Fuse(source, target, noise_bound, ins, &summary);
    summary.stage_times.push_back({"fusion", stopwatch.Lap()});
  }
  return summary;
}

}  // namespace quatro
