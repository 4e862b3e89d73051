// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/estimators/polish.h"

#include <glog/logging.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>
#include <utility>

#include "robust/estimators/consensus.h"
#include "robust/estimators/distinct_matches.h"
#include "robust/estimators/tims.h"
#include "robust/gnc/gnc.h"
#include "robust/gnc/so3.h"
#include "robust/gnc/surrogate.h"
#include "solvers/closed_form/rotation.h"
#include "solvers/closed_form/translation.h"

namespace quatro {
namespace {

// Bounds of the alternation, in units of the noise bound.
constexpr double kSchedule[] = {2.0, 1.5, 1.0, 1.0, 1.0, 1.0};

// Minimizes (1) from an initial pose. Returns nullopt if the inliers do not
// determine a pose.
std::optional<Rigid3> Refine(const PointsRef& source,
                             const PointsRef& target,
                             Rigid3 pose,
                             double noise_bound) {
  std::vector<Eigen::Index> before;
  for (const double factor : kSchedule) {
    std::vector<Eigen::Index> inliers =
        FindWithinBall(source, target, pose, factor * noise_bound);
    if (factor == 1.0 && inliers == before) break;
    const auto rigid =
        EstimateRigid(Columns(source, inliers),
                      Columns(target, inliers),
                      Weights::Ones(static_cast<Eigen::Index>(inliers.size())));
    if (!rigid) return std::nullopt;
    pose = rigid->target_from_source;
    before = std::move(inliers);
  }
  return pose;
}

// An initial pose with a rotation in SO(3) from the consistent set. Returns
// nullopt if GNC fails.
std::optional<Rigid3> SolveSo3(const PointsRef& source,
                               const PointsRef& target,
                               const std::vector<Eigen::Index>& consistent,
                               double noise_bound) {
  const Points p = Columns(source, consistent);
  const Points q = Columns(target, consistent);
  const auto pairs = MakeTimPairs(p.cols(), TimLayout::kRing, 0, 0);
  const auto gnc = SolveGnc<TruncatedLeastSquares>(
      So3{ComputeTims(p, pairs), ComputeTims(q, pairs), 2.0 * noise_bound},
      GncOptions{});
  if (!gnc.IsUsable()) return std::nullopt;
  const Eigen::Matrix3d& rotation = gnc.estimate->target_from_source;
  const auto translation = EstimateTranslation(rotation * p, q, noise_bound);
  return Rigid3{rotation, translation->target_from_source};
}

// The standard deviation of the rotation about its least certain axis [rad].
double RotationStd(const PointsRef& source,
                   const PointsRef& target,
                   const Rigid3& pose,
                   double noise_bound) {
  const auto inliers = FindWithinBall(source, target, pose, noise_bound);
  const auto n = static_cast<double>(inliers.size());
  if (inliers.size() < 3) return std::numeric_limits<double>::infinity();
  const Points moved = pose.Apply(Columns(source, inliers));
  const Points error = Columns(target, inliers) - moved;
  const double variance = error.squaredNorm() / std::max(1.0, 3.0 * n - 6.0);
  const Points centered = moved.colwise() - moved.rowwise().mean();
  const Eigen::Matrix3d scatter = centered * centered.transpose();
  const Eigen::Matrix3d half_curvature =
      scatter.trace() * Eigen::Matrix3d::Identity() - scatter;
  const double least =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(half_curvature)
          .eigenvalues()[0];
  // A few exact matches have zero residuals, so the standard deviation is
  // assumed to be at least a tenth of the bound.
  const double floor = 0.01 * noise_bound * noise_bound;
  return std::sqrt(std::max(variance, floor) / std::max(0.0, least));
}

}  // namespace

bool PolishOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  if (!(noise_bound > 0.0 && std::isfinite(noise_bound))) {
    problem << "noise_bound = " << noise_bound << ", must be > 0 and finite";
  } else if (!(max_tilt > 0.0 && max_tilt <= M_PI)) {
    problem << "polish.max_tilt = " << max_tilt << ", must be in (0, pi]";
  } else if (!(max_rotation_std > 0.0)) {
    problem << "polish.max_rotation_std = " << max_rotation_std
            << ", must be > 0";
  }
  *error = problem.str();
  return error->empty();
}

PolishSummary Polish(const PointsRef& source,
                     const PointsRef& target,
                     const std::vector<Eigen::Index>& consistent,
                     const Rigid3& target_from_source,
                     const PolishOptions& options) {
  CHECK_EQ(source.cols(), target.cols());
  const double bound = options.noise_bound;
  PolishSummary summary;
  summary.target_from_source = target_from_source;
  summary.message = "no pose in SE(3) fits the matches better";

  std::vector<Rigid3> starts = {target_from_source};
  if (const auto so3 = SolveSo3(source, target, consistent, bound)) {
    starts.push_back(*so3);
  }
  // Records why a candidate was rejected, unless another one has been accepted.
  const auto refuse = [&](const char* why) {
    if (!summary.is_polished) summary.message = why;
  };
  double least = ConsensusCost(source, target, target_from_source, bound);
  for (const Rigid3& start : starts) {
    const auto refined = Refine(source, target, start, bound);
    if (!refined) {
      refuse("the inliers do not constrain roll and pitch");
      continue;
    }
    const double cost = ConsensusCost(source, target, *refined, bound);
    if (!(cost < least)) continue;
    const double tilt =
        AngleBetween(refined->rotation, target_from_source.rotation);
    const double rotation_std = RotationStd(source, target, *refined, bound);
    if (tilt > options.max_tilt) {
      refuse("the better pose is rotated too far from the yaw-only pose");
      continue;
    }
    if (!(rotation_std <= options.max_rotation_std)) {
      refuse("the inliers do not constrain roll and pitch");
      continue;
    }
    least = cost;
    summary.target_from_source = *refined;
    summary.is_polished = true;
    summary.rotation_std = rotation_std;
    summary.message = "polished";
  }
  return summary;
}

}  // namespace quatro
