// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/registration/clique_proposals.h"

#include <utility>

#include "robust/registration/methods.h"

namespace quatro {

std::vector<ProposedPose> ProposeByCliques(const PointsRef& source,
                                           const PointsRef& target,
                                           const RegistrationOptions& options) {
  std::vector<ProposedPose> proposed;
  for (const int factor : {1, 2}) {
    RegistrationOptions scaled = options;
    scaled.noise_bound *= factor;
    scaled = WithSharedValues(std::move(scaled));
    for (const auto& [name, space] : {std::pair{"quatro_single", "in yaw"},
                                      std::pair{"teaser", "in SO(3)"}}) {
      std::string ignored;
      const PoseSummary summary =
          FindMethod(name, &ignored)->make(scaled)(source, target);
      if (!summary.IsUsable()) continue;
      proposed.push_back({std::string("clique ") + space + ", bound x " +
                              std::to_string(factor),
                          *summary.target_from_source});
    }
  }
  return proposed;
}

}  // namespace quatro
