// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Poses proposed by the largest cliques of consistent matches, in addition to
// those of the consensus search: yaw-only (Quatro) and in SO(3) (TEASER++), for
// scans that are tilted against each other, at the noise bound and at twice the
// noise bound. A clique at the wider bound contains matches that a tilt or a
// coarse voxel moved out of the bound.

#ifndef QUATRO_ROBUST_REGISTRATION_CLIQUE_PROPOSALS_H_
#define QUATRO_ROBUST_REGISTRATION_CLIQUE_PROPOSALS_H_

#include <vector>

#include "features/base/types.h"
#include "robust/estimators/proposal.h"
#include "robust/registration/options.h"

namespace quatro {

// At most four poses. Column i of `source` is matched with column i of `target`
// [m]; z is up.
std::vector<ProposedPose> ProposeByCliques(const PointsRef& source,
                                           const PointsRef& target,
                                           const RegistrationOptions& options);

}  // namespace quatro

#endif  // QUATRO_ROBUST_REGISTRATION_CLIQUE_PROPOSALS_H_
