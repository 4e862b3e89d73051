// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/verdict/match_rival.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

#include "robust/estimators/arc_consensus.h"
#include "robust/estimators/consensus.h"
#include "robust/estimators/distinct_matches.h"
#include "solvers/closed_form/translation.h"

namespace quatro {
namespace {

constexpr double kYawStep = 5.0 * M_PI / 180.0;

// This many inliers suffice to find a rotation about them.
constexpr Eigen::Index kMaxSameMatches = 500;

// The columns whose value on the axis is within `bound` of the center of the
// largest consensus.
std::vector<Eigen::Index> FindConsensus(
    const Points& offsets,
    int axis,
    const std::vector<Eigen::Index>& candidates,
    double bound,
    double* center) {
  const Points selected = Columns(offsets, candidates);
  const auto consensus =
      EstimateConsensus(selected.row(axis).transpose(),
                        Weights::Constant(selected.cols(), bound));
  *center = consensus->value;
  std::vector<Eigen::Index> kept;
  for (const Eigen::Index i : candidates) {
    if (std::abs(offsets(axis, i) - *center) <= bound) kept.push_back(i);
  }
  return kept;
}

// The rotation by at least `min_rotation`, followed by a horizontal shift, with
// the most inliers of `moved` and `target` in x and y. Both are centered at the
// origin.
Rigid3 FindTurnOfSameMatches(const Points& moved,
                             const Points& target,
                             double bound,
                             double min_rotation) {
  std::vector<Eigen::Index> all(static_cast<std::size_t>(moved.cols()));
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i] = static_cast<Eigen::Index>(i);
  }
  Rigid3 best;
  std::size_t most = 0;
  const double arc = 2.0 * (M_PI - min_rotation);
  const int num_steps = static_cast<int>(std::ceil(arc / kYawStep));
  for (int step = 0; step <= num_steps; ++step) {
    Rigid3 turn;
    turn.rotation = RotationZ(min_rotation + arc * step / num_steps);
    const Points offsets = target - turn.rotation * moved;
    const auto along_x =
        FindConsensus(offsets, 0, all, bound, &turn.translation.x());
    const auto inliers =
        FindConsensus(offsets, 1, along_x, bound, &turn.translation.y());
    if (inliers.size() > most) {
      most = inliers.size();
      best = turn;
    }
  }
  return best;
}

}  // namespace

bool MatchRivalOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  if (!(min_rotation > 0.0 && min_rotation < M_PI)) {
    problem << "min_rotation = " << min_rotation << ", must be in (0, pi)";
  } else if (!(min_shift_factor >= 2.0 && std::isfinite(min_shift_factor))) {
    problem << "min_shift_factor = " << min_shift_factor
            << ", must be >= 2 and finite";
  } else if (num_pairs < 1) {
    problem << "num_pairs = " << num_pairs << ", must be >= 1";
  } else if (max_num_matches < 2) {
    problem << "max_num_matches = " << max_num_matches << ", must be >= 2";
  } else if (num_threads < 0) {
    problem << "num_threads = " << num_threads << ", must be >= 0";
  }
  *error = problem.str();
  return error->empty() && bounds.IsValid(error);
}

std::optional<MatchRival> FindMatchRival(const PointsRef& source,
                                         const PointsRef& target,
                                         const Rigid3& target_from_source,
                                         double noise_bound,
                                         const MatchRivalOptions& options) {
  const Points moved = target_from_source.Apply(source);
  const std::vector<Eigen::Index> inliers =
      FindInliers(source, target, target_from_source, noise_bound);
  const double min_shift = options.min_shift_factor * noise_bound;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  std::vector<Rigid3> turns;  // D

  const bool has_same_matches = inliers.size() >= 2;
  if (has_same_matches) {
    middle = Columns(target, inliers).rowwise().mean();
    std::vector<Eigen::Index> some = inliers;
    some.resize(
        std::min(inliers.size(), static_cast<std::size_t>(kMaxSameMatches)));
    Rigid3 turn =
        FindTurnOfSameMatches(Columns(moved, some).colwise() - middle,
                              Columns(target, some).colwise() - middle,
                              noise_bound,
                              options.min_rotation);
    turn.translation += middle - turn.rotation * middle;
    turns.push_back(turn);
  }

  std::vector<Eigen::Index> far;
  for (Eigen::Index i = 0; i < moved.cols(); ++i) {
    if ((target.col(i) - moved.col(i)).cwiseAbs().maxCoeff() <= min_shift ||
        !options.bounds.CanBeInlier(
            source.col(i), target.col(i), noise_bound)) {
      continue;
    }
    far.push_back(i);
    if (static_cast<Eigen::Index>(far.size()) == options.max_num_matches) break;
  }
  ArcConsensusOptions arc;
  arc.noise_bound = noise_bound;
  arc.num_pairs = options.num_pairs;
  arc.seed = options.seed;
  arc.num_threads = options.num_threads;
  const PoseSummary other =
      SolveArcConsensus(Columns(moved, far), Columns(target, far), arc);
  if (other.IsUsable()) turns.push_back(*other.target_from_source);

  std::optional<MatchRival> best;
  for (const Rigid3& turn : turns) {
    if (Eigen::AngleAxisd(turn.rotation).angle() <
            0.999 * options.min_rotation &&
        (turn * middle - middle).norm() <= min_shift) {
      continue;
    }
    MatchRival rival;
    rival.target_from_source = turn * target_from_source;
    if (!options.bounds.Contain(rival.target_from_source, noise_bound))
      continue;
    rival.has_same_matches = has_same_matches && &turn == &turns.front();
    rival.num_inliers = static_cast<Eigen::Index>(
        FindInliers(source, target, rival.target_from_source, noise_bound)
            .size());
    const auto k = static_cast<double>(inliers.size());
    const auto l = static_cast<double>(rival.num_inliers);
    rival.margin = (k - l) / std::sqrt(std::max(1.0, k + l));
    if (rival.num_inliers >= 2 &&
        (!best || rival.num_inliers > best->num_inliers)) {
      best = rival;
    }
  }
  return best;
}

}  // namespace quatro
