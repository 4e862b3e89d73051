// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/registration/registration.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "robust/registration/ladder.h"
#include "robust/registration/level.h"
#include "robust/registration/level_registration.h"
#include "robust/registration/local_registration.h"
#include "robust/registration/methods.h"
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
    prepared->options.search.max_rung = 0;
    return true;
  }
  const Method* method = FindMethod(options.method, error);
  if (!method || !CanUseIns(*method, options.ins, error)) return false;
  if (method->adjust) method->adjust(&prepared->options);
  if (!method->searches) prepared->options.search.max_rung = 0;
  if (method->make) prepared->solver = method->make(prepared->options);
  prepared->works_on_matches = method->input == MethodInput::kMatches;
  return true;
}

bool IsBetter(const RegistrationSummary& a, const RegistrationSummary& b) {
  if (a.verdict.IsRegistered() != b.verdict.IsRegistered()) {
    return a.verdict.IsRegistered();
  }
  return a.verdict.probability > b.verdict.probability;
}

// Through the door, and back. `clouds` is null without clouds.
void RegisterBehindDoor(const Matches& matches,
                        const MatchedClouds* clouds,
                        const Prepared& prepared,
                        RegistrationSummary* summary) {
  Stopwatch stopwatch;
  const RegistrationOptions& options = prepared.options;
  const LevelFrames frames = MakeLevelFrames(options.ins);
  const PoseBounds bounds = Leveled(frames, options.ins, options.bounds);
  MatchedPoints rung_matches;
  const auto run = [&](const PointsRef& p,
                       const PointsRef& q,
                       const DescribedCloud* source,
                       const DescribedCloud* target,
                       const MatchedPoints* mutual_matches) {
    const LevelProblem problem{
        source, target, bounds, options, prepared.solver};
    RegisterLevel(p, q, problem, summary);
    if (mutual_matches)
      rung_matches = Climb(p, q, *mutual_matches, problem, summary);
  };
  if (frames.AreIdentity()) {
    run(matches.source,
        matches.target,
        clouds ? &clouds->source : nullptr,
        clouds ? &clouds->target : nullptr,
        clouds ? &clouds->mutual_matches : nullptr);
  } else {
    std::optional<DescribedCloud> source, target;
    std::optional<MatchedPoints> mutual_matches;
    if (clouds) {
      source = Leveled(frames.level_from_source, clouds->source);
      target = Leveled(frames.level_from_target, clouds->target);
      mutual_matches = MatchedPoints{
          Leveled(frames.level_from_source, clouds->mutual_matches.source),
          Leveled(frames.level_from_target, clouds->mutual_matches.target)};
    }
    run(Leveled(frames.level_from_source, matches.source),
        Leveled(frames.level_from_target, matches.target),
        source ? &*source : nullptr,
        target ? &*target : nullptr,
        mutual_matches ? &*mutual_matches : nullptr);
    TakeBack(frames, summary);
    rung_matches.source =
        frames.level_from_source.transpose() * rung_matches.source;
    rung_matches.target =
        frames.level_from_target.transpose() * rung_matches.target;
  }
  if (rung_matches.source.cols() > 0) {
    summary->matched_source = std::move(rung_matches.source);
    summary->matched_target = std::move(rung_matches.target);
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
  const bool searches = method && method->searches && !options.solver &&
                        options.search.max_rung > 0;
  std::optional<RegistrationSummary> best;
  double seconds = 0.0;
  for (const double factor : options.search.scale_factors) {
    RegistrationOptions scaled = ScaledBy(factor, options);
    scaled.search.time_limit_seconds =
        std::max(0.0, options.search.time_limit_seconds - seconds);
    RegistrationSummary summary =
        RegisterMatched(MatchClouds(source, target, scaled), scaled);
    summary.scale_factor = factor;
    seconds += summary.total_seconds;
    if (!best || IsBetter(summary, *best)) best = std::move(summary);
    if (!searches || !best->error.empty() || best->verdict.IsRegistered() ||
        seconds > options.search.time_limit_seconds) {
      break;
    }
  }
  if (!best) {  // There are no factors, which the options' check reports.
    return RegisterMatched(MatchClouds(source, target, options), options);
  }
  best->total_seconds = seconds;
  return *std::move(best);
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
  RegisterBehindDoor(matches, nullptr, prepared, &summary);
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
                     &clouds,
                     prepared,
                     &summary);
  return summary;
}

}  // namespace quatro
