// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/registration/registration.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "robust/registration/any_vertical.h"
#include "robust/registration/door.h"
#include "robust/registration/local_registration.h"
#include "robust/registration/methods.h"
#include "solvers/closed_form/valid_matches.h"

namespace quatro {

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
    scaled.search.is_first_try = !best;
    scaled.search.time_limit_seconds =
        std::max(0.0, options.search.time_limit_seconds - seconds);
    RegistrationSummary summary =
        RegisterMatched(MatchClouds(source, target, scaled), scaled);
    summary.scale_factor = factor;
    // That of the clouds, not of the attempt.
    summary.verdict.tolerance = ToleranceOf(options.noise_bound);
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
  if (options.ins.gravity == Gravity::kNone) {
    summary.error =
        "gravity is none, which needs clouds; with matches alone, state which "
        "way is up";
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
  RegisterBehindDoor(matches,
                     nullptr,
                     MakeLevelFrames(prepared.options.ins),
                     prepared,
                     &summary);
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
  if (!MayLevelByScans(prepared.options)) {
    if (prepared.options.ins.gravity == Gravity::kNone) {
      summary.error =
          "gravity is none, which method " + options.method +
          " cannot use, nor any with an INS or bounds; state which way is up";
      return summary;
    }
    return RegisterIn(MakeLevelFrames(options.ins), clouds, prepared);
  }
  return RegisterByAnyVertical(clouds, prepared);
}

}  // namespace quatro
