// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/registration/fgr_clouds.h"

namespace quatro {

FrontEndOptions WithTupleTestOfFgr(FrontEndOptions options) {
  options.tuple_test = true;
  options.tuple.scale = 0.95;
  options.tuple.num_triples_per_match = 100;
  options.tuple.max_num_triples = 1000;
  return options;
}

RegistrationSummary RegisterByFgr(const PointCloud& source,
                                  const PointCloud& target,
                                  const RegistrationOptions& options,
                                  const FgrOptions& fgr_options) {
  FgrOptions fgr = fgr_options;
  fgr.noise_bound = options.quatro.noise_bound;
  fgr.num_threads = options.num_threads;
  RegistrationOptions front_door = options;
  front_door.front_end = WithTupleTestOfFgr(options.front_end);
  front_door.solver = [fgr](const PointsRef& matched_source,
                            const PointsRef& matched_target) {
    return SolveFgr(matched_source, matched_target, fgr);
  };
  RegistrationSummary summary;
  if (!fgr.IsValid(&summary.error)) return summary;
  return Register(source, target, front_door);
}

}  // namespace quatro
