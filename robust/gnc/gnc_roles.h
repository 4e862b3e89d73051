// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Roles and bounds of the residual blocks, from the lists of CeresGncOptions.
// Part of robust/gnc/ceres_gnc.h, which lists the errors.

#ifndef QUATRO_ROBUST_GNC_GNC_ROLES_H_
#define QUATRO_ROBUST_GNC_GNC_ROLES_H_

#include <ceres/ceres.h>

#include <optional>
#include <string>
#include <unordered_map>

#include "robust/gnc/ceres_gnc_options.h"

namespace quatro {

// The role and the bound of each residual block.
using GncBlocks = std::unordered_map<ceres::ResidualBlockId, GncBlock>;

// The roles of all residual blocks, and the bounds of the candidates. Returns
// nullopt and sets *error if the lists contradict each other or the problem, or
// if a loss never reaches its bound.
std::optional<GncBlocks> AssignGncRoles(const ceres::Problem& problem,
                                        const CeresGncOptions& options,
                                        std::string* error);

}  // namespace quatro

#endif  // QUATRO_ROBUST_GNC_GNC_ROLES_H_
