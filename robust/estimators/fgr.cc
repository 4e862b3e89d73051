// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/estimators/fgr.h"

#include <glog/logging.h>

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>
#include <vector>

#include "features/base/parallel.h"
#include "robust/estimators/distinct_matches.h"
#include "robust/estimators/rotation_observability.h"
#include "robust/gnc/surrogate.h"
#include "robust/graph/far_matches.h"
#include "solvers/closed_form/rotation.h"
#include "solvers/closed_form/valid_matches.h"

namespace quatro {
namespace {

constexpr int kFgrNeeds = 3;

// The number of matches that one thread sums at a time. The sums are added in
// order.
constexpr Eigen::Index kNumPerPiece = 4096;

// Sums over the matches for (3), with x = T p and e = q - x.
struct Moments {
  double l = 0.0;
  Eigen::Vector3d lx = Eigen::Vector3d::Zero();
  Eigen::Matrix3d lxx = Eigen::Matrix3d::Zero();
  Eigen::Vector3d le = Eigen::Vector3d::Zero();
  Eigen::Vector3d lxe = Eigen::Vector3d::Zero();  // x cross e
  double loss = 0.0;

  void Add(const Moments& other) {
    l += other.l;
    lx += other.lx;
    lxx += other.lxx;
    le += other.le;
    lxe += other.lxe;
    loss += other.loss;
  }
};

Eigen::Matrix3d CrossMatrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d cross;
  cross << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return cross;
}

// The matches relative to their means and in units of D, without those that are
// far from the others.
struct ScaledMatches {
  std::vector<Eigen::Index> columns;  // Distinct matches.
  Points source;
  Points target;
  // Aligned, because Eigen adds rows in an order that depends on the alignment
  // of the result.
  alignas(16) Eigen::Vector3d source_mean;
  alignas(16) Eigen::Vector3d target_mean;
  double extent = 1.0;  // D [m].
  double delta = 0.0;   // The noise bound over D.
};

ScaledMatches ScaleMatches(const DistinctMatches& matches,
                           const FgrOptions& options) {
  ScaledMatches scaled;
  scaled.columns =
      FindNear(matches.source, matches.target, options.noise_bound);
  Points& p = scaled.source;
  Points& q = scaled.target;
  p = Columns(matches.source, scaled.columns);
  q = Columns(matches.target, scaled.columns);
  scaled.source_mean = p.rowwise().mean();
  scaled.target_mean = q.rowwise().mean();
  p.colwise() -= scaled.source_mean;
  q.colwise() -= scaled.target_mean;
  scaled.extent = options.start_scale *
                  std::sqrt(std::max(p.colwise().squaredNorm().maxCoeff(),
                                     q.colwise().squaredNorm().maxCoeff()));
  p /= scaled.extent;
  q /= scaled.extent;
  scaled.delta = options.noise_bound / scaled.extent;
  return scaled;
}

// Returns the pose of the scaled matches after the last step.
Rigid3 Iterate(const ScaledMatches& matches,
               const FgrOptions& options,
               FgrSummary* summary) {
  Rigid3 pose;
  if (options.start_at_plain_fit) {
    const auto plain = EstimateRigid(
        matches.source, matches.target, Weights::Ones(matches.source.cols()));
    if (plain) pose = plain->target_from_source;
  }
  // mu is in units of delta^2, so that the schedule ends at 1.
  const double delta = matches.delta;
  double mu = std::max(1.0, 1.0 / (delta * delta));
  FgrNormalEquations equations;
  while (summary->iterations < options.max_iterations &&
         !summary->has_converged) {
    const bool is_exact = GemanMcClure::IsExact(mu);
    equations = LinearizeFgr(matches.source,
                             matches.target,
                             pose,
                             mu * delta * delta,
                             options.num_threads);
    const Eigen::Matrix<double, 6, 1> xi =
        equations.A.completeOrthogonalDecomposition().solve(equations.b);
    pose = ComposeLeft(xi, pose);
    summary->last_step = xi.norm();
    ++summary->iterations;
    summary->has_converged =
        is_exact && summary->last_step <= options.step_tolerance;
    if (summary->iterations % options.iterations_per_mu == 0) {
      mu = GemanMcClure::NextMu(mu, options.mu_step);
    }
  }
  summary->mu = mu * options.noise_bound * options.noise_bound;
  summary->cost = equations.loss * matches.extent * matches.extent;
  return pose;
}

// Returns columns of the distinct matches.
std::vector<Eigen::Index> FindInliers(const ScaledMatches& matches,
                                      const Rigid3& pose) {
  const double limit = matches.delta * matches.delta;
  const Points errors = matches.target - pose.Apply(matches.source);
  std::vector<Eigen::Index> inliers;
  for (Eigen::Index i = 0; i < errors.cols(); ++i) {
    if (errors.col(i).squaredNorm() <= limit) {
      inliers.push_back(matches.columns[static_cast<std::size_t>(i)]);
    }
  }
  return inliers;
}

}  // namespace

bool FgrOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  if (!(noise_bound > 0.0 && std::isfinite(noise_bound))) {
    problem << "noise_bound = " << noise_bound << ", must be > 0 and finite";
  } else if (!(start_scale > 0.0 && std::isfinite(start_scale))) {
    problem << "start_scale = " << start_scale << ", must be > 0 and finite";
  } else if (!(mu_step > 1.0 && std::isfinite(mu_step))) {
    problem << "mu_step = " << mu_step << ", must be > 1 and finite";
  } else if (iterations_per_mu < 1) {
    problem << "iterations_per_mu = " << iterations_per_mu << ", must be >= 1";
  } else if (max_iterations < 1) {
    problem << "max_iterations = " << max_iterations << ", must be >= 1";
  } else if (!(step_tolerance > 0.0)) {
    problem << "step_tolerance = " << step_tolerance << ", must be > 0";
  } else if (num_threads < 0) {
    problem << "num_threads = " << num_threads << ", must be >= 0";
  }
  *error = problem.str();
  return error->empty();
}

FgrNormalEquations LinearizeFgr(const PointsRef& source,
                                const PointsRef& target,
                                const Rigid3& target_from_source,
                                double mu,
                                int num_threads) {
  CHECK_EQ(source.cols(), target.cols());
  const Eigen::Index n = source.cols();
  std::vector<Moments> pieces(static_cast<std::size_t>(n / kNumPerPiece + 1));
  ParallelFor(
      num_threads, n, kNumPerPiece, [&](Eigen::Index begin, Eigen::Index end) {
        Moments sums;
        for (Eigen::Index i = begin; i < end; ++i) {
          const Eigen::Vector3d x =
              target_from_source * Eigen::Vector3d(source.col(i));
          const Eigen::Vector3d e = target.col(i) - x;
          const double r2 = e.squaredNorm();
          const double l = GemanMcClure::Weight(r2, mu);  // Equation (2).
          const Eigen::Vector3d lx = l * x;
          const Eigen::Vector3d le = l * e;
          sums.l += l;
          sums.lx += lx;
          sums.lxx += lx * x.transpose();
          sums.le += le;
          sums.lxe += x.cross(le);
          sums.loss += GemanMcClure::Loss(r2, mu);  // Equation (1).
        }
        pieces[static_cast<std::size_t>(begin / kNumPerPiece)] = sums;
      });
  Moments sums;
  for (const Moments& piece : pieces) sums.Add(piece);

  FgrNormalEquations equations;
  equations.A.topLeftCorner<3, 3>() =
      sums.lxx.trace() * Eigen::Matrix3d::Identity() - sums.lxx;
  equations.A.topRightCorner<3, 3>() = CrossMatrix(sums.lx);
  equations.A.bottomLeftCorner<3, 3>() = -CrossMatrix(sums.lx);
  equations.A.bottomRightCorner<3, 3>() = sums.l * Eigen::Matrix3d::Identity();
  equations.b << sums.lxe, sums.le;
  equations.loss = sums.loss;
  return equations;
}

Rigid3 ComposeLeft(const Eigen::Matrix<double, 6, 1>& xi,
                   const Rigid3& target_from_source) {
  const Eigen::Vector3d omega = xi.head<3>();
  const double angle = omega.norm();
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
  if (angle > 0.0) {
    turn = Eigen::AngleAxisd(angle, Eigen::Vector3d(omega / angle));
  }
  // A normalized quaternion remains a rotation over hundreds of steps.
  const Eigen::Quaterniond rotation =
      turn * Eigen::Quaterniond(target_from_source.rotation);
  return {rotation.normalized().toRotationMatrix(),
          turn * target_from_source.translation + xi.tail<3>()};
}

FgrSummary SolveFgr(const PointsRef& source,
                    const PointsRef& target,
                    const FgrOptions& options) {
  FgrSummary summary;
  summary.num_needed = kFgrNeeds;
  if (!options.IsValid(&summary.message) ||
      !AreValidMatches(source, target, &summary.message)) {
    return summary;
  }

  Stopwatch stopwatch;
  const DistinctMatches matches =
      FindDistinctMatches(source, target, options.noise_bound);
  summary.num_matches = matches.source.cols();
  summary.termination = PoseTermination::kInsufficient;
  if (summary.num_matches < kFgrNeeds) {
    std::ostringstream message;
    message << "a pose needs three matches; there are " << summary.num_matches;
    summary.message = message.str();
    return summary;
  }

  const ScaledMatches scaled = ScaleMatches(matches, options);
  const Rigid3 pose = Iterate(scaled, options, &summary);
  const Rigid3 target_from_source{pose.rotation,
                                  scaled.extent * pose.translation +
                                      scaled.target_mean -
                                      pose.rotation * scaled.source_mean};
  const std::vector<Eigen::Index> inliers = FindInliers(scaled, pose);
  summary.num_consistent = static_cast<Eigen::Index>(inliers.size());
  summary.num_rotation_inliers = summary.num_consistent;
  summary.consistent = InputColumns(matches, inliers);
  summary.stage_times.push_back({"fgr", stopwatch.Lap()});
  if (summary.num_consistent < kFgrNeeds) {
    std::ostringstream message;
    message << "a pose needs three inliers; the final pose has "
            << summary.num_consistent << " among " << summary.num_matches
            << " matches";
    summary.message = message.str();
    return summary;
  }
  const auto rigid = EstimateRigid(Columns(matches.source, inliers),
                                   Columns(matches.target, inliers),
                                   Weights::Ones(summary.num_consistent));
  if (!rigid || !IsRotationObservable(*rigid, options.noise_bound)) {
    summary.termination = PoseTermination::kDegenerate;
    summary.message =
        "the inliers do not constrain the rotation: they are on one line";
    return summary;
  }
  summary.num_translation_inliers = summary.num_consistent;
  summary.translation_inliers = summary.consistent;
  summary.target_from_source = target_from_source;
  summary.termination = PoseTermination::kSolved;
  summary.message =
      summary.has_converged
          ? "solved"
          : "solved, but max_iterations was reached before convergence";
  return summary;
}

}  // namespace quatro
