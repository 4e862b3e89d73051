// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/registration/registration.h"

#include <utility>

#include "robust/estimators/bound_solver.h"
#include "robust/registration/level.h"
#include "robust/registration/local_registration.h"
#include "robust/registration/methods.h"
#include "robust/verdict/summary_covariance.h"
#include "solvers/closed_form/valid_matches.h"

namespace quatro {
namespace {

// The method of the options with what it adjusts; the solver, empty for a
// method that works on clouds. Returns false and sets *error if there is no
// such method, or an option is out of range.
struct Prepared {
  RegistrationOptions options;
  PoseSolver solver;
  bool works_on_matches = true;
};

bool Prepare(const RegistrationOptions& options,
             Prepared* prepared,
             std::string* error) {
  if (!options.IsValid(error)) return false;
  prepared->options = WithSharedValues(options);
  if (options.solver) {
    prepared->solver = options.solver;
    return true;
  }
  const Method* method = FindMethod(options.method, error);
  if (!method || !CanUseIns(*method, options.ins, error)) return false;
  if (method->adjust) method->adjust(&prepared->options);
  if (method->make) prepared->solver = method->make(prepared->options);
  prepared->works_on_matches = method->input == MethodInput::kMatches;
  return true;
}

// All that follows the matches, with z up.
class LevelRegistration {
 public:
  // `source` and `target` are null without clouds.
  LevelRegistration(const PointsRef& matched_source,
                    const PointsRef& matched_target,
                    const DescribedCloud* source,
                    const DescribedCloud* target,
                    const PoseBounds& bounds,
                    const Prepared& prepared,
                    RegistrationSummary* summary)
      : matched_source_(matched_source),
        matched_target_(matched_target),
        source_(source),
        target_(target),
        bounds_(bounds),
        options_(prepared.options),
        solver_(prepared.solver),
        summary_(*summary) {}

  void Run() {
    Estimate();
    if (source_ && summary_.solution.IsUsable()) {
      Refine();
      WeighGeometry();
    }
    Judge();
  }

 private:
  void FinishStage(const char* stage) {
    summary_.stage_times.push_back({stage, stopwatch_.Lap()});
    if (options_.progress) options_.progress(summary_.stage_times.back());
  }

  void Estimate() {
    const PoseSolver solve = [this](const PointsRef& p, const PointsRef& q) {
      return SolveLevel(p, q, solver_, options_.noise_bound, options_.ins);
    };
    summary_.solution = BoundSolver(solve, bounds_, options_.noise_bound)(
        matched_source_, matched_target_);
    AddCovariance(matched_source_,
                  matched_target_,
                  options_.noise_bound,
                  options_.covariance,
                  &summary_.solution);
    stopwatch_.Lap();
    for (const StageTime& time : summary_.solution.stage_times) {
      summary_.stage_times.push_back(time);
      if (options_.progress) options_.progress(time);
    }
  }

  void Refine() {
    if (options_.refinement.method == RefinementMethod::kNone) return;
    RefinementSummary refinement =
        quatro::Refine(*source_,
                       *target_,
                       matched_source_,
                       matched_target_,
                       options_.noise_bound,
                       *summary_.solution.target_from_source,
                       options_.refinement);
    if (!bounds_.Contain(refinement.target_from_source, options_.noise_bound)) {
      refinement.is_accepted = false;
      refinement.message = "the refined pose is outside of the bounds";
      refinement.target_from_source = refinement.unrefined_target_from_source;
    }
    summary_.solution.target_from_source = refinement.target_from_source;
    summary_.refinement = std::move(refinement);
    FinishStage("refinement");
  }

  // What the clouds say about the pose, and which directions they constrain.
  void WeighGeometry() {
    const Rigid3& pose = *summary_.solution.target_from_source;
    const double voxel_size = options_.front_end.voxel_size;
    const int num_threads = options_.num_threads;
    EvidenceOptions evidence = options_.evidence;
    evidence.rival.bounds = bounds_;
    const MutualContacts contacts =
        FindMutualContacts(*source_,
                           *target_,
                           pose,
                           evidence.MaxDistance(voxel_size),
                           num_threads);
    summary_.surface_observability =
        MeasureSurfaceObservability(*source_,
                                    *target_,
                                    pose,
                                    contacts,
                                    options_.surface_observability,
                                    num_threads);
    if (summary_.surface_observability) {
      auto& unobservable = summary_.solution.covariance->unobservable;
      const auto& more = summary_.surface_observability->unobservable;
      unobservable.insert(unobservable.end(), more.begin(), more.end());
    }
    geometry_ = MeasureGeometricEvidence(
        *source_, *target_, pose, contacts, voxel_size, evidence, num_threads);
    FinishStage("evidence");
  }

  void Judge() {
    VerdictOptions verdict = options_.verdict;
    verdict.rival.bounds = bounds_;
    summary_.verdict = quatro::Judge(matched_source_,
                                     matched_target_,
                                     summary_.solution,
                                     options_.noise_bound,
                                     geometry_,
                                     verdict);
    FinishStage("verdict");
  }

  const PointsRef& matched_source_;
  const PointsRef& matched_target_;
  const DescribedCloud* source_;
  const DescribedCloud* target_;
  const PoseBounds& bounds_;
  const RegistrationOptions& options_;
  const PoseSolver& solver_;
  RegistrationSummary& summary_;
  Stopwatch stopwatch_;
  std::optional<GeometricEvidence> geometry_;
};

// Through the door, and back. `source` and `target` are null without clouds.
void RegisterBehindDoor(const Matches& matches,
                        const DescribedCloud* source,
                        const DescribedCloud* target,
                        const Prepared& prepared,
                        RegistrationSummary* summary) {
  Stopwatch stopwatch;
  const RegistrationOptions& options = prepared.options;
  const LevelFrames frames = MakeLevelFrames(options.ins);
  const PoseBounds bounds = Leveled(frames, options.ins, options.bounds);
  if (frames.AreIdentity()) {
    LevelRegistration(matches.source,
                      matches.target,
                      source,
                      target,
                      bounds,
                      prepared,
                      summary)
        .Run();
  } else {
    std::optional<DescribedCloud> level_source, level_target;
    if (source) {
      level_source = Leveled(frames.level_from_source, *source);
      level_target = Leveled(frames.level_from_target, *target);
    }
    const Points p = Leveled(frames.level_from_source, matches.source);
    const Points q = Leveled(frames.level_from_target, matches.target);
    LevelRegistration(p,
                      q,
                      level_source ? &*level_source : nullptr,
                      level_target ? &*level_target : nullptr,
                      bounds,
                      prepared,
                      summary)
        .Run();
    TakeBack(frames, summary);
  }
  summary->total_seconds += stopwatch.Lap();
}

}  // namespace

RegistrationSummary Register(const PointCloud& source,
                             const PointCloud& target,
                             const RegistrationOptions& options) {
  std::string error;
  const Method* method = FindMethod(options.method, &error);
  if (method && method->input == MethodInput::kClouds && !options.solver) {
    RegistrationSummary summary;
    if (!CanUseIns(*method, options.ins, &summary.error)) return summary;
    RegistrationOptions local = options;
    method->adjust(&local);
    return RegisterLocally(source, target, options.bounds.guess, local);
  }
  return RegisterMatched(MatchClouds(source, target, options), options);
}

RegistrationSummary RegisterMatches(const Matches& matches,
                                    const RegistrationOptions& options) {
  RegistrationSummary summary;
  Prepared prepared;
  if (!Prepare(options, &prepared, &summary.error)) return summary;
  if (!prepared.works_on_matches) {
    summary.error =
        "method " + options.method + " works on clouds, not on matches";
    return summary;
  }
  if (options.refinement.method != RefinementMethod::kNone) {
    summary.error = "refinement needs clouds, and there are only matches";
    return summary;
  }
  if (!AreValidMatches(matches.source, matches.target, &summary.error)) {
    return summary;
  }
  summary.matched_source = matches.source;
  summary.matched_target = matches.target;
  RegisterBehindDoor(matches, nullptr, nullptr, prepared, &summary);
  return summary;
}

MatchedClouds MatchClouds(const PointCloud& source,
                          const PointCloud& target,
                          const RegistrationOptions& options) {
  MatchedClouds clouds;
  if (!options.IsValid(&clouds.error)) return clouds;
  const LevelFrames frames = MakeLevelFrames(options.ins);
  return MatchClouds(source,
                     target,
                     frames.level_from_source.row(2).transpose(),
                     frames.level_from_target.row(2).transpose(),
                     options.front_end,
                     options.seed,
                     options.num_threads,
                     options.progress);
}

RegistrationSummary RegisterMatched(const MatchedClouds& clouds,
                                    const RegistrationOptions& options) {
  RegistrationSummary summary;
  Prepared prepared;
  summary.error = clouds.error;
  if (!summary.error.empty() || !Prepare(options, &prepared, &summary.error)) {
    return summary;
  }
  if (!prepared.solver) {
    summary.error = "method " + options.method + " needs the clouds themselves";
    return summary;
  }
  summary.matched_source = clouds.matched_source;
  summary.matched_target = clouds.matched_target;
  summary.num_source_voxels = clouds.source.points().cols();
  summary.num_target_voxels = clouds.target.points().cols();
  summary.num_mutual_matches = clouds.num_mutual_matches;
  summary.stage_times = clouds.stage_times;
  for (const StageTime& time : clouds.stage_times) {
    summary.total_seconds += time.seconds;
  }
  RegisterBehindDoor({clouds.matched_source, clouds.matched_target},
                     &clouds.source,
                     &clouds.target,
                     prepared,
                     &summary);
  return summary;
}

}  // namespace quatro
