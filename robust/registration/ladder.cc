// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/registration/ladder.h"

#include <optional>
#include <utility>

#include "robust/estimators/consensus.h"
#include "robust/estimators/distinct_matches.h"
#include "robust/registration/front_end.h"
#include "robust/registration/pose_search.h"

namespace quatro {
namespace {

// Sizes of rung 2 over those of the options.
constexpr double kVoxelFactor = 2.0;
constexpr double kNormalFactor = 4.0 / 3.0;
constexpr double kFpfhFactor = 7.0 / 3.0;

// The estimator's pose replaces the candidate if its score is at least this
// share of the candidate's.
constexpr double kMinScoreShare = 0.95;

// Runs an estimator on the inliers of a candidate alone.
class CandidateSolver {
 public:
  CandidateSolver(const PoseSearch& search,
                  const PoseSolver& solver,
                  const Rigid3& candidate,
                  double noise_bound)
      : search_(search),
        solver_(solver),
        candidate_(candidate),
        noise_bound_(noise_bound) {}

  PoseSummary operator()(const PointsRef& source,
                         const PointsRef& target) const {
    const std::vector<Eigen::Index> inliers =
        FindWithinBall(source, target, candidate_, noise_bound_);
    PoseSummary summary =
        solver_(Columns(source, inliers), Columns(target, inliers));
    const auto to_input = [&](std::vector<Eigen::Index>* columns) {
      for (Eigen::Index& column : *columns) {
        column = inliers[static_cast<std::size_t>(column)];
      }
    };
    to_input(&summary.consistent);
    to_input(&summary.translation_inliers);
    summary.num_matches = source.cols();
    if (!IsAsGood(summary)) {
      // The candidate itself is the answer.
      summary.termination = PoseTermination::kSolved;
      summary.message =
          "solved; the structure of both scans fits the candidate "
          "better than the estimator's pose";
      summary.model = PoseModel::kRigid;
      summary.unpolished_target_from_source.reset();
      summary.target_from_source = candidate_;
      summary.consistent = inliers;
      summary.match_weights.clear();
      summary.translation_inliers = inliers;
      summary.num_consistent = static_cast<Eigen::Index>(inliers.size());
      summary.num_translation_inliers = summary.num_consistent;
    }
    return summary;
  }

 private:
  bool IsAsGood(const PoseSummary& summary) const {
    return summary.IsUsable() &&
           search_.ScoreOf(*summary.target_from_source).value() >=
               kMinScoreShare * search_.ScoreOf(candidate_).value();
  }

  const PoseSearch& search_;
  const PoseSolver& solver_;
  Rigid3 candidate_;
  double noise_bound_;
};

// The matches of a rung.
MatchedPoints MatchesOf(int rung,
                        const MatchedPoints& mutual_matches,
                        const LevelProblem& problem) {
  if (rung == 1) return mutual_matches;
  FrontEndOptions front_end = problem.options.front_end;
  front_end.voxel_size *= kVoxelFactor;
  front_end.normal_radius *= kNormalFactor;
  front_end.fpfh_radius *= kFpfhFactor;
  return MatchAgain(
      *problem.source, *problem.target, front_end, problem.options.num_threads);
}

// Stages of all rungs are summed by name.
void AddTime(const StageTime& time, std::vector<StageTime>* times) {
  for (StageTime& known : *times) {
    if (known.stage != time.stage) continue;
    known.seconds += time.seconds;
    return;
  }
  times->push_back(time);
}

double SumOf(const std::vector<StageTime>& times) {
  double sum = 0.0;
  for (const StageTime& time : times) sum += time.seconds;
  return sum;
}

}  // namespace

MatchedPoints Climb(const MatchedPoints& mutual_matches,
                    const LevelProblem& problem,
                    RegistrationSummary* summary) {
  MatchedPoints answer;
  const RegistrationOptions& options = problem.options;
  if (summary->verdict.IsRegistered() || options.search.max_rung == 0) {
    return answer;
  }
  const double voxel_size = options.front_end.voxel_size;
  std::optional<PoseSearch> search;
  for (int rung = 1; rung <= options.search.max_rung; ++rung) {
    if (SumOf(summary->stage_times) > options.search.time_limit_seconds) break;
    Stopwatch stopwatch;
    if (!search) {
      search.emplace(*problem.source,
                     *problem.target,
                     options.evidence.MaxDistance(voxel_size),
                     voxel_size,
                     options.noise_bound,
                     options.search,
                     options.num_threads);
    }
    const MatchedPoints matches = MatchesOf(rung, mutual_matches, problem);
    std::vector<PoseCandidate> candidates =
        search->Find(matches.source,
                     matches.target,
                     "rung " + std::to_string(rung),
                     problem.bounds);
    const StageTime search_time{"search", stopwatch.Lap()};
    AddTime(search_time, &summary->stage_times);
    if (options.progress) options.progress(search_time);
    if (candidates.empty()) continue;

    RegistrationSummary attempt;
    attempt.num_source_voxels = summary->num_source_voxels;
    attempt.num_target_voxels = summary->num_target_voxels;
    attempt.num_mutual_matches = summary->num_mutual_matches;
    const PoseSolver solver =
        CandidateSolver(*search,
                        problem.solver,
                        candidates.front().target_from_source,
                        options.search.bound_factor * options.noise_bound);
    RegisterLevel(
        matches.source,
        matches.target,
        {problem.source, problem.target, problem.bounds, options, solver},
        &attempt);
    attempt.rung = rung;
    std::vector<PoseCandidate> all = std::move(summary->candidates);
    all.insert(all.end(),
               std::make_move_iterator(candidates.begin()),
               std::make_move_iterator(candidates.end()));
    std::vector<StageTime> times = std::move(summary->stage_times);
    for (const StageTime& time : attempt.stage_times) AddTime(time, &times);
    if (attempt.verdict.IsRegistered() ||
        attempt.verdict.probability > summary->verdict.probability) {
      attempt.total_seconds = summary->total_seconds;
      *summary = std::move(attempt);
      answer = matches;
    }
    summary->candidates = std::move(all);
    summary->stage_times = std::move(times);
    if (summary->verdict.IsRegistered()) break;
  }
  return answer;
}

}  // namespace quatro
