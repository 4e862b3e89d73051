// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/estimators/ransac.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>
#include <utility>
#include <vector>

#include "features/base/parallel.h"
#include "features/base/random.h"
#include "robust/estimators/distinct_matches.h"
#include "robust/estimators/match_scorer.h"
#include "robust/estimators/rotation_observability.h"
#include "robust/graph/far_matches.h"
#include "solvers/closed_form/rotation.h"
#include "solvers/closed_form/valid_matches.h"
#include "solvers/closed_form/yaw_translation.h"

namespace quatro {
namespace {

// The number of samples between two updates of the best pose doubles from the
// first to the second value. It changes the time but not the result.
constexpr std::int64_t kFirstBatch = 64;
constexpr std::int64_t kLargestBatch = 4096;

// The bounds of the refits, in noise bounds, and the largest number of refits
// with the noise bound itself.
constexpr double kShrinkingBounds[] = {3.0, 2.0, 1.5};
constexpr int kMaxRefits = 10;

// The matches relative to the means of those that are near
// (robust/graph/far_matches.h), so that coordinates far from the origin keep
// their digits.
struct Problem {
  DistinctMatches matches;
  std::optional<MatchedNormals> normals;
  Eigen::Vector3d source_mean;
  Eigen::Vector3d target_mean;
  std::vector<Eigen::Index> near;

  Rigid3 Uncentered(const Rigid3& pose) const {
    return {pose.rotation,
            pose.translation + target_mean - pose.rotation * source_mean};
  }
};

// The normals of the distinct matches. If copies of a match have different
// normals, the lexicographically smallest ones are used, so that the input
// order does not matter.
MatchedNormals DistinctNormals(const DistinctMatches& matches,
                               const MatchedNormals& normals) {
  const auto is_less = [&](Eigen::Index i, Eigen::Index j) {
    Eigen::Matrix<double, 6, 1> a, b;
    a << normals.source.col(i), normals.target.col(i);
    b << normals.source.col(j), normals.target.col(j);
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
  };
  std::vector<Eigen::Index> columns;
  for (const auto& copies : matches.columns) {
    columns.push_back(*std::min_element(copies.begin(), copies.end(), is_less));
  }
  return {Columns(normals.source, columns), Columns(normals.target, columns)};
}

Problem MakeProblem(const PointsRef& source,
                    const PointsRef& target,
                    const MatchedNormals* normals,
                    double noise_bound) {
  Problem problem;
  problem.matches = FindDistinctMatches(source, target, noise_bound);
  if (normals) problem.normals = DistinctNormals(problem.matches, *normals);
  if (problem.matches.source.cols() == 0) return problem;
  problem.near =
      FindNear(problem.matches.source, problem.matches.target, noise_bound);
  const Points p = Columns(problem.matches.source, problem.near);
  const Points q = Columns(problem.matches.target, problem.near);
  problem.source_mean = p.rowwise().mean();
  problem.target_mean = q.rowwise().mean();
  problem.matches.source.colwise() -= problem.source_mean;
  problem.matches.target.colwise() -= problem.target_mean;
  return problem;
}

struct Fit {
  Rigid3 pose;
  double least_turn = 0.0;  // robust/estimators/rotation_observability.h [m^2]
};

// Least squares over the degrees of freedom that the sample estimates.
std::optional<Fit> FitTo(const Problem& problem,
                         const std::vector<Eigen::Index>& inliers,
                         MinimalSample sample) {
  const Points p = Columns(problem.matches.source, inliers);
  const Points q = Columns(problem.matches.target, inliers);
  const Weights ones = Weights::Ones(p.cols());
  if (sample == MinimalSample::kThreePoints) {
    const auto rigid = EstimateRigid(p, q, ones);
    if (!rigid) return std::nullopt;
    return Fit{rigid->target_from_source, LeastTurn(*rigid)};
  }
  const auto yaw = EstimateYawTranslation(p, q, ones);
  if (!yaw) return std::nullopt;
  return Fit{yaw->target_from_source, 0.5 * yaw->curvature(0, 0)};
}

struct Best {
  Rigid3 pose;
  double cost = std::numeric_limits<double>::infinity();
};

// Refits with shrinking bounds, or only with the last bound, and keeps each
// pose with a lower cost.
void Refit(const Problem& problem,
           const MatchScorer& scorer,
           MinimalSample sample,
           bool shrink,
           Best* best) {
  Rigid3 pose = best->pose;
  const auto step = [&](const std::vector<Eigen::Index>& inliers) {
    const auto fit = FitTo(problem, inliers, sample);
    if (!fit) return false;
    pose = fit->pose;
    const double cost = scorer.Cost(pose, best->cost);
    if (cost < best->cost) *best = {pose, cost};
    return true;
  };
  if (shrink) {
    for (const double bound : kShrinkingBounds) {
      if (!step(scorer.Inliers(pose, bound))) return;
    }
  }
  std::vector<Eigen::Index> before;
  for (int k = 0; k < kMaxRefits; ++k) {
    std::vector<Eigen::Index> inliers = scorer.Inliers(pose);
    if (inliers == before || !step(inliers)) return;
    before = std::move(inliers);
  }
}

// Runs the search. Returns nullopt if no sample gave a pose.
std::optional<Best> Search(const Problem& problem,
                           const MatchScorer& scorer,
                           const RansacOptions& options,
                           RansacSummary* summary) {
  struct Hypothesis {
    std::optional<Rigid3> pose;
    double cost = 0.0;
  };
  const MinimalSample sample = options.minimal.sample;
  const Eigen::Index n = scorer.num_matches();
  const bool takes_each_once = sample == MinimalSample::kPointAndNormal;
  const std::int64_t last =
      takes_each_once ? std::min<std::int64_t>(options.max_iterations, n)
                      : options.max_iterations;
  Best best;
  double num_enough = std::numeric_limits<double>::infinity();
  std::vector<Hypothesis> batch;
  std::int64_t batch_size = kFirstBatch;
  for (std::int64_t begin = 0; begin < last; begin += batch_size) {
    if (begin > 0) batch_size = std::min(2 * batch_size, kLargestBatch);
    batch.assign(static_cast<std::size_t>(std::min(batch_size, last - begin)),
                 {});
    // A pose that costs more than the best one before the batch cannot become
    // the best.
    const double limit = best.cost;
    ParallelFor(options.num_threads,
                static_cast<Eigen::Index>(batch.size()),
                16,
                [&](Eigen::Index from, Eigen::Index to) {
                  for (Eigen::Index k = from; k < to; ++k) {
                    const std::int64_t iteration = begin + k;
                    Random random(Mix(options.seed) +
                                  static_cast<std::uint64_t>(iteration));
                    Hypothesis& hypothesis = batch[static_cast<std::size_t>(k)];
                    hypothesis.pose = EstimateMinimalPose(
                        problem.matches.source,
                        problem.matches.target,
                        problem.normals ? &*problem.normals : nullptr,
                        takes_each_once
                            ? std::array<Eigen::Index, 3>{iteration, -1, -1}
                            : DrawSample(sample, n, &random),
                        options.minimal);
                    if (hypothesis.pose) {
                      hypothesis.cost = scorer.Cost(*hypothesis.pose, limit);
                    }
                  }
                });
    for (const Hypothesis& hypothesis : batch) {
      ++summary->num_iterations;
      if (hypothesis.pose) {
        ++summary->num_hypotheses;
        if (hypothesis.cost < best.cost) {
          ++summary->num_improvements;
          best = {*hypothesis.pose, hypothesis.cost};
          if (options.local_optimization) {
            Refit(problem, scorer, sample, true, &best);
          }
          num_enough = NumIterationsFor(
              options.confidence,
              static_cast<Eigen::Index>(scorer.Inliers(best.pose).size()),
              n,
              SampleSize(sample));
        }
      }
      if (static_cast<double>(summary->num_iterations) >= num_enough) {
        summary->is_confident = true;
        return best;
      }
    }
  }
  summary->is_confident = takes_each_once && last == n;
  if (summary->num_improvements == 0) return std::nullopt;
  return best;
}

// Whether the inliers constrain the pose. A single match with normals does.
bool ConstrainPose(const Problem& problem,
                   const std::vector<Eigen::Index>& inliers,
                   const MinimalPoseOptions& minimal) {
  if (minimal.sample == MinimalSample::kPointAndNormal) return true;
  const auto fit = FitTo(problem, inliers, minimal.sample);
  return fit && fit->least_turn > minimal.noise_bound * minimal.noise_bound;
}

bool AreValidNormals(const PointsRef& source,
                     const PointsRef& target,
                     const MatchedNormals* normals,
                     std::string* error) {
  if (normals == nullptr) {
    *error =
        "samples of a point and its normal need normals; pass one unit normal "
        "of each cloud per match";
  } else if (normals->source.cols() != source.cols() ||
             normals->target.cols() != target.cols()) {
    *error = std::to_string(normals->source.cols()) + " source normals and " +
             std::to_string(normals->target.cols()) + " target normals for " +
             std::to_string(source.cols()) +
             " matches; equal numbers are required";
  } else if (!normals->source.allFinite() || !normals->target.allFinite()) {
    *error = "a normal is not finite; leave out matches without a normal";
  } else {
    return true;
  }
  return false;
}

}  // namespace

bool RansacOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  if (max_iterations < 1) {
    problem << "max_iterations = " << max_iterations << ", must be >= 1";
  } else if (!(confidence > 0.0 && confidence <= 1.0)) {
    problem << "confidence = " << confidence << ", must be in (0, 1]";
  } else if (num_threads < 0) {
    problem << "num_threads = " << num_threads << ", must be >= 0";
  } else {
    return minimal.IsValid(error);
  }
  *error = problem.str();
  return false;
}

double NumIterationsFor(double confidence,
                        Eigen::Index num_inliers,
                        Eigen::Index num_matches,
                        int sample_size) {
  double all_inliers = 1.0;
  for (int j = 0; j < sample_size; ++j) {
    all_inliers *=
        static_cast<double>(std::max<Eigen::Index>(0, num_inliers - j)) /
        static_cast<double>(num_matches - j);
  }
  if (!(all_inliers > 0.0)) return std::numeric_limits<double>::infinity();
  if (all_inliers >= 1.0) return 1.0;
  return std::max(
      1.0, std::ceil(std::log1p(-confidence) / std::log1p(-all_inliers)));
}

RansacSummary SolveRansac(const PointsRef& source,
                          const PointsRef& target,
                          const RansacOptions& options,
                          const MatchedNormals* normals) {
  const MinimalSample sample = options.minimal.sample;
  const int num_needed = SampleSize(sample);
  const double bound = options.minimal.noise_bound;
  RansacSummary summary;
  summary.num_needed = num_needed;
  if (!options.IsValid(&summary.message) ||
      !AreValidMatches(source, target, &summary.message)) {
    return summary;
  }
  if (sample != MinimalSample::kPointAndNormal) normals = nullptr;
  if (sample == MinimalSample::kPointAndNormal &&
      !AreValidNormals(source, target, normals, &summary.message)) {
    return summary;
  }

  Stopwatch stopwatch;
  const Problem problem = MakeProblem(source, target, normals, bound);
  summary.num_matches = problem.matches.source.cols();
  summary.termination = PoseTermination::kInsufficient;
  std::optional<Best> best;
  const MatchScorer scorer(
      problem.matches.source, problem.matches.target, bound);
  if (summary.num_matches >= num_needed) {
    best = Search(problem, scorer, options, &summary);
  }
  std::vector<Eigen::Index> inliers;
  if (best) {
    Refit(problem, scorer, sample, false, &*best);
    inliers = scorer.Inliers(best->pose);
    summary.cost = best->cost;
  }
  summary.num_consistent = static_cast<Eigen::Index>(inliers.size());
  summary.num_rotation_inliers = summary.num_consistent;
  summary.consistent = InputColumns(problem.matches, inliers);
  summary.stage_times.push_back({"ransac", stopwatch.Lap()});
  const bool are_too_few = summary.num_consistent < num_needed;
  // If all matches are on a line, no sample constrains a pose.
  const bool are_all_alike =
      are_too_few && summary.num_matches >= num_needed &&
      !ConstrainPose(problem, problem.near, options.minimal);
  if (are_too_few && !are_all_alike) {
    std::ostringstream message;
    if (summary.num_matches < num_needed) {
      message << "a pose needs at least " << num_needed
              << " matches, but there are only " << summary.num_matches
              << "; use larger radii or other scans";
      summary.message = message.str();
      return summary;
    }
    message << "no pose with at least " << num_needed
            << " inliers was found in " << summary.num_iterations
            << " samples of " << summary.num_matches
            << " matches; use a larger noise bound, more iterations or other "
               "matches";
    summary.message = message.str();
    return summary;
  }
  if (are_all_alike || !ConstrainPose(problem, inliers, options.minimal)) {
    summary.termination = PoseTermination::kDegenerate;
    summary.message =
        sample == MinimalSample::kThreePoints
            ? "the inliers do not constrain the rotation: they are on one line"
            : "the inliers do not constrain the heading: they are on a "
              "vertical line";
    return summary;
  }
  summary.num_translation_inliers = summary.num_consistent;
  summary.translation_inliers = summary.consistent;
  summary.target_from_source = problem.Uncentered(best->pose);
  summary.model = sample == MinimalSample::kThreePoints
                      ? PoseModel::kRigid
                      : PoseModel::kYawTranslation;
  summary.termination = PoseTermination::kSolved;
  summary.message = "solved";
  return summary;
}

}  // namespace quatro
