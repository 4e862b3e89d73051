// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/registration/options.h"

#include <cmath>
#include <sstream>

namespace quatro {
namespace {

// Calls visit(name, field, shared value, default) for each field of a part that
// has the name of a shared value.
template <typename Options, typename Visit>
void ForEachSharedField(Options& o, const Visit& visit) {
  const auto bound = [&](const char* name, auto& field) {
    visit(name, field, o.noise_bound, 0.3);
  };
  bound("quatro.noise_bound", o.quatro.noise_bound);
  bound("arc_consensus.noise_bound", o.arc_consensus.noise_bound);
  bound("consensus.noise_bound", o.consensus.noise_bound);
  bound("teaser.noise_bound", o.teaser.noise_bound);
  bound("fgr.noise_bound", o.fgr.noise_bound);
  bound("ransac.minimal.noise_bound", o.ransac.minimal.noise_bound);
  const auto seed = [&](const char* name, auto& field) {
    visit(name, field, o.seed, std::uint64_t{0});
  };
  seed("quatro.seed", o.quatro.seed);
  seed("arc_consensus.seed", o.arc_consensus.seed);
  seed("teaser.seed", o.teaser.seed);
  seed("ransac.seed", o.ransac.seed);
  seed("front_end.tuple.seed", o.front_end.tuple.seed);
  seed("verdict.rival.seed", o.verdict.rival.seed);
  const auto threads = [&](const char* name, auto& field) {
    visit(name, field, o.num_threads, 1);
  };
  threads("quatro.num_threads", o.quatro.num_threads);
  threads("arc_consensus.num_threads", o.arc_consensus.num_threads);
  threads("consensus.num_threads", o.consensus.num_threads);
  threads("teaser.num_threads", o.teaser.num_threads);
  threads("fgr.num_threads", o.fgr.num_threads);
  threads("ransac.num_threads", o.ransac.num_threads);
  threads("front_end.tuple.num_threads", o.front_end.tuple.num_threads);
  threads("verdict.rival.num_threads", o.verdict.rival.num_threads);
  threads("refinement.alignment.num_threads",
          o.refinement.alignment.num_threads);
}

bool SharesValues(const RegistrationOptions& options, std::string* error) {
  std::ostringstream problem;
  ForEachSharedField(options,
                     [&](const std::string& name,
                         const auto& field,
                         const auto& shared,
                         const auto& usual) {
                       if (field == shared || field == usual) return;
                       if (problem.tellp() != 0) return;
                       problem << name << " = " << field << ", set "
                               << name.substr(name.rfind('.') + 1)
                               << " of the registration instead, which is "
                               << shared;
                     });
  *error = problem.str();
  return error->empty();
}

}  // namespace

bool RegistrationOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  if (num_threads < 0) {
    problem << "num_threads = " << num_threads << ", must be >= 0";
  } else if (!(noise_bound > 0.0 && std::isfinite(noise_bound))) {
    problem << "noise_bound = " << noise_bound << ", must be > 0 and finite";
  } else if (verdict.rival.bounds.IsActive() ||
             evidence.rival.bounds.IsActive()) {
    problem << "rival.bounds are set, set bounds of the registration instead";
  } else if (bounds.up != PoseBounds().up && bounds.up != ins.up) {
    problem << "bounds.up = (" << bounds.up.transpose()
            << "), set ins.up instead, which is (" << ins.up.transpose() << ")";
  }
  *error = problem.str();
  return error->empty() && SharesValues(*this, error) &&
         front_end.IsValid(error) && quatro.IsValid(error) &&
         arc_consensus.IsValid(error) && consensus.IsValid(error) &&
         teaser.IsValid(error) && fgr.IsValid(error) && ransac.IsValid(error) &&
         bounds.IsValid(error) && ins.IsValid(error) && search.IsValid(error) &&
         covariance.IsValid(error) && surface_observability.IsValid(error) &&
         evidence.IsValid(error) && verdict.IsValid(error) &&
         refinement.IsValid(error);
}

RegistrationOptions ScaledBy(double factor, RegistrationOptions options) {
  RefinementOptions& refinement = options.refinement;
  for (double* length : {&options.front_end.voxel_size,
                         &options.front_end.normal_radius,
                         &options.front_end.fpfh_radius,
                         &options.noise_bound,
                         &options.covariance.max_translation_std,
                         &refinement.voxel_size,
                         &refinement.max_translation,
                         &refinement.alignment.max_correspondence_distance,
                         &refinement.alignment.translation_tolerance}) {
    *length *= factor;
  }
  return options;
}

RegistrationOptions WithSharedValues(RegistrationOptions options) {
  ForEachSharedField(
      options, [](const char*, auto& field, const auto& shared, const auto&) {
        field = shared;
      });
  return options;
}

}  // namespace quatro
