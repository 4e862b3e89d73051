// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/registration/door.h"

#include <optional>
#include <utility>

#include "robust/registration/ladder.h"
#include "robust/registration/level.h"
#include "robust/registration/level_registration.h"
#include "robust/registration/methods.h"

namespace quatro {

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

void RegisterBehindDoor(const Matches& matches,
                        const MatchedClouds* clouds,
                        const LevelFrames& frames,
                        const Prepared& prepared,
                        RegistrationSummary* summary) {
  Stopwatch stopwatch;
  const RegistrationOptions& options = prepared.options;
  const PoseBounds bounds = Leveled(frames, options.ins, options.bounds);
  MatchedPoints rung_matches;
  const auto run = [&](const PointsRef& p,
                       const PointsRef& q,
                       const DescribedCloud* source,
                       const DescribedCloud* target) {
    LevelProblem problem{
        source, target, bounds, options, prepared.solver, std::nullopt};
    // The more poses are tried, the more evidence one of them needs.
    if (source && !options.search.is_first_try &&
        options.search.guided_matching) {
      problem.search = SearchEvidence();
      problem.search->is_first = false;
    }
    RegisterLevel(p, q, problem, summary);
    if (clouds) {
      rung_matches = Climb(p, q, clouds->mutual_matches, problem, summary);
    }
  };
  if (frames.AreIdentity()) {
    run(matches.source,
        matches.target,
        clouds ? &clouds->source : nullptr,
        clouds ? &clouds->target : nullptr);
  } else {
    std::optional<DescribedCloud> source, target;
    if (clouds) {
      source = Leveled(frames.level_from_source, clouds->source);
      target = Leveled(frames.level_from_target, clouds->target);
    }
    run(Leveled(frames.level_from_source, matches.source),
        Leveled(frames.level_from_target, matches.target),
        source ? &*source : nullptr,
        target ? &*target : nullptr);
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

RegistrationSummary RegisterIn(const LevelFrames& frames,
                               const MatchedClouds& clouds,
                               const Prepared& prepared) {
  RegistrationSummary summary;
  summary.matched_source = clouds.matched_source;
  summary.matched_target = clouds.matched_target;
  summary.num_source_voxels = clouds.source.points().cols();
  summary.num_target_voxels = clouds.target.points().cols();
  summary.num_mutual_matches =
      static_cast<Eigen::Index>(clouds.mutual_matches.size());
  summary.stage_times = clouds.stage_times;
  for (const StageTime& time : clouds.stage_times) {
    summary.total_seconds += time.seconds;
  }
  RegisterBehindDoor({clouds.matched_source, clouds.matched_target},
                     &clouds,
                     frames,
                     prepared,
                     &summary);
  return summary;
}

bool IsBetter(const RegistrationSummary& a, const RegistrationSummary& b) {
  if (a.verdict.IsRegistered() != b.verdict.IsRegistered()) {
    return a.verdict.IsRegistered();
  }
  return a.verdict.probability > b.verdict.probability;
}

}  // namespace quatro
