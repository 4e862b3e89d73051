// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/registration/ladder.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "robust/estimators/consensus.h"
#include "robust/estimators/distinct_matches.h"
#include "robust/registration/clique_proposals.h"
#include "robust/registration/front_end.h"
#include "robust/registration/pose_search.h"

namespace quatro {
namespace {

// Ratios of the sizes of rung 2 to those of the options.
constexpr double kVoxelFactor = 2.0;
constexpr double kNormalFactor = 4.0 / 3.0;
constexpr double kFpfhFactor = 7.0 / 3.0;

// Searched poses with a geometric score below this are wrong. Of 57 correct
// ones on development pairs, the lowest had 0.21; of 19 pairs of unrelated
// scans, three quarters were below 0.12.
constexpr double kMinGeometry = 0.15;

constexpr int kNumMoreRounds = 1;  // Of matching on rung 3.

// A pose is as good as another one if its score is at least this share of the
// other's: the score is that of a sample.
constexpr double kMinScoreShare = 0.95;

// A consensus of more than this share of the matches is not due to chance.
constexpr double kSureShare = 0.2;

// From this number of inliers on, a polished pose has the tilt of the surfaces.
constexpr Eigen::Index kManyInliers = 25;

// Whether the tilt between the scans was estimated from many matches.
bool HasTilt(const PoseSummary& summary) {
  return summary.model == PoseModel::kRigid &&
         summary.num_translation_inliers >= kManyInliers;
}

// Runs an estimator on only the inliers of a candidate, and polishes its pose
// in SE(3) by VG-ICP.
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
    if (summary.IsUsable()) Polish(&summary);
    if (!summary.IsUsable() || ScoreOf(*summary.target_from_source) <
                                   kMinScoreShare * ScoreOf(candidate_)) {
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
  double ScoreOf(const Rigid3& pose) const {
    return search_.ScoreOf(pose).value();
  }

  // Aligns the pose with the clouds. The aligned pose is taken if it is as
  // good.
  void Polish(PoseSummary* summary) const {
    const Rigid3 pose = *summary->target_from_source;
    const Rigid3 aligned = search_.Align(pose);
    if (ScoreOf(aligned) < kMinScoreShare * ScoreOf(pose)) return;
    if (!summary->unpolished_target_from_source) {
      summary->unpolished_target_from_source = pose;
    }
    summary->target_from_source = aligned;
    summary->model = PoseModel::kRigid;
  }

  const PoseSearch& search_;
  const PoseSolver& solver_;
  Rigid3 candidate_;
  double noise_bound_;
};

// The candidates that are tried, in this order: the first and, if the geometry
// chooses, the one that fits it best if that is another. If the geometry of
// none is plausible, none is.
std::vector<std::size_t> Tried(const std::vector<PoseCandidate>& candidates,
                               bool geometric_choice) {
  if (candidates.empty()) return {};
  if (!geometric_choice) return {0};
  const auto best =
      std::max_element(candidates.begin(),
                       candidates.end(),
                       [](const PoseCandidate& a, const PoseCandidate& b) {
                         return a.geometry.value() < b.geometry.value();
                       });
  if (best->geometry.value() < kMinGeometry) return {};
  if (best == candidates.begin()) return {0};
  return {0, static_cast<std::size_t>(best - candidates.begin())};
}

// The matches of a rung.
MatchedPoints MatchesOf(int rung,
                        const std::vector<Match>& mutual_matches,
                        const LevelProblem& problem) {
  const DescribedCloud& source = *problem.source;
  const DescribedCloud& target = *problem.target;
  if (rung == 1) {
    return PointsOf(mutual_matches, source.points(), target.points());
  }
  if (rung == 3) {
    return PointsOf(MatchInRounds(mutual_matches,
                                  *source.descriptors,
                                  *target.descriptors,
                                  kNumMoreRounds,
                                  problem.options.num_threads),
                    source.points(),
                    target.points());
  }
  FrontEndOptions front_end = problem.options.front_end;
  front_end.voxel_size *= kVoxelFactor;
  front_end.normal_radius *= kNormalFactor;
  front_end.fpfh_radius *= kFpfhFactor;
  return MatchAgain(source, target, front_end, problem.options.num_threads);
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

class Ladder {
 public:
  Ladder(const std::vector<Match>& mutual_matches,
         const LevelProblem& problem,
         RegistrationSummary* summary)
      : mutual_matches_(mutual_matches),
        problem_(problem),
        options_(problem.options),
        summary_(*summary) {}

  // Aligns a registered pose whose tilt was estimated from few matches, or not
  // at all, with the clouds. If this improves the score, the aligned pose is
  // judged and replaces it.
  void CheckTilt(const PointsRef& matched_source,
                 const PointsRef& matched_target) {
    const bool is_refined =
        summary_.refinement && summary_.refinement->is_accepted;
    if (!summary_.verdict.IsRegistered() || HasTilt(summary_.solution) ||
        is_refined || options_.ins.mode != InsMode::kNone) {
      return;
    }
    Stopwatch stopwatch;
    const Rigid3& pose = *summary_.solution.target_from_source;
    const Rigid3 aligned = Search().Align(pose);
    const bool is_better =
        problem_.bounds.Contain(aligned, options_.noise_bound) &&
        Search().ScoreOf(aligned).value() > Search().ScoreOf(pose).value();
    FinishSearch(&stopwatch);
    if (is_better) Take(Attempt(matched_source, matched_target, 0, aligned));
  }

  // Climbs until a pose is registered. Returns the matches of the pose if it is
  // from a higher rung, else none.
  MatchedPoints Climb(const PointsRef& matched_source,
                      const PointsRef& matched_target) {
    MatchedPoints answer;
    if (IsSurelyOutside()) return answer;
    for (int rung = 1;
         rung <= options_.search.max_rung && !summary_.verdict.IsRegistered();
         ++rung) {
      if (SumOf(summary_.stage_times) > options_.search.time_limit_seconds) {
        break;
      }
      Stopwatch stopwatch;
      const MatchedPoints matches = MatchesOf(rung, mutual_matches_, problem_);
      const std::vector<ProposedPose> cliques =
          rung == 1 && options_.search.cliques
              ? ProposeByCliques(matched_source, matched_target, options_)
              : std::vector<ProposedPose>();
      if (rung == 1 && options_.search.segments) Search().UseSegments();
      std::vector<PoseCandidate> candidates =
          Search().Find(matches.source,
                        matches.target,
                        "rung " + std::to_string(rung),
                        cliques,
                        problem_.bounds);
      FinishSearch(&stopwatch);
      for (const std::size_t k :
           Tried(candidates, options_.search.geometric_choice)) {
        RegistrationSummary attempt = Attempt(matches.source,
                                              matches.target,
                                              rung,
                                              candidates[k].target_from_source);
        if (attempt.verdict.IsRegistered() ||
            attempt.verdict.probability > summary_.verdict.probability) {
          Take(std::move(attempt));
          answer = matches;
        }
        if (summary_.verdict.IsRegistered()) break;
      }
      summary_.candidates.insert(summary_.candidates.end(),
                                 std::make_move_iterator(candidates.begin()),
                                 std::make_move_iterator(candidates.end()));
    }
    return answer;
  }

 private:
  // Whether the matches clearly support a pose outside of the bounds. A pose
  // found within the bounds would then be due to chance.
  bool IsSurelyOutside() const {
    if (!problem_.bounds.IsActive() || summary_.solution.IsUsable()) {
      return false;
    }
    const PoseSummary& outside = summary_.solution;
    return static_cast<double>(outside.num_translation_inliers) >
           kSureShare * static_cast<double>(outside.num_matches);
  }

  // The search, built on first use.
  PoseSearch& Search() {
    const double voxel_size = options_.front_end.voxel_size;
    if (!search_) {
      search_.emplace(*problem_.source,
                      *problem_.target,
                      options_.evidence.MaxDistance(voxel_size),
                      voxel_size,
                      options_.noise_bound,
                      options_.search,
                      options_.num_threads);
    }
    return *search_;
  }

  void FinishSearch(Stopwatch* stopwatch) {
    const StageTime time{"search", stopwatch->Lap()};
    AddTime(time, &summary_.stage_times);
    if (options_.progress) options_.progress(time);
  }

  // Runs the estimator on the inliers of a candidate, and judges the pose. The
  // stage times are added to those of the summary.
  RegistrationSummary Attempt(const PointsRef& matched_source,
                              const PointsRef& matched_target,
                              int rung,
                              const Rigid3& candidate) {
    RegistrationSummary attempt;
    attempt.num_source_voxels = summary_.num_source_voxels;
    attempt.num_target_voxels = summary_.num_target_voxels;
    attempt.num_mutual_matches = summary_.num_mutual_matches;
    attempt.rung = rung;
    std::optional<SearchEvidence> search;
    if (rung > 0 && options_.search.guided_matching) {
      search.emplace();
      search->segment_ratio = Search().SegmentRatio(candidate);
      search->is_first = rung == 1 && options_.search.is_first_try;
    }
    const PoseSolver solver =
        CandidateSolver(Search(),
                        problem_.solver,
                        candidate,
                        options_.search.bound_factor * options_.noise_bound);
    RegisterLevel(matched_source,
                  matched_target,
                  {problem_.source,
                   problem_.target,
                   problem_.bounds,
                   options_,
                   solver,
                   search},
                  &attempt);
    for (const StageTime& time : attempt.stage_times) {
      AddTime(time, &summary_.stage_times);
    }
    return attempt;
  }

  // The attempt becomes the answer.
  void Take(RegistrationSummary attempt) {
    attempt.candidates = std::move(summary_.candidates);
    attempt.stage_times = std::move(summary_.stage_times);
    attempt.total_seconds = summary_.total_seconds;
    attempt.matched_source = std::move(summary_.matched_source);
    attempt.matched_target = std::move(summary_.matched_target);
    summary_ = std::move(attempt);
  }

  const std::vector<Match>& mutual_matches_;
  const LevelProblem& problem_;
  const RegistrationOptions& options_;
  RegistrationSummary& summary_;
  std::optional<PoseSearch> search_;
};

}  // namespace

MatchedPoints Climb(const PointsRef& matched_source,
                    const PointsRef& matched_target,
                    const std::vector<Match>& mutual_matches,
                    const LevelProblem& problem,
                    RegistrationSummary* summary) {
  if (problem.options.search.max_rung == 0) return {};
  Ladder ladder(mutual_matches, problem, summary);
  ladder.CheckTilt(matched_source, matched_target);
  return ladder.Climb(matched_source, matched_target);
}

}  // namespace quatro
