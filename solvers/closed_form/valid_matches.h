// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// What any estimator asks of matched points (p_i, q_i), i < N: as many of one
// as of the other, and all finite. None at all is fine.

#ifndef QUATRO_SOLVERS_CLOSED_FORM_VALID_MATCHES_H_
#define QUATRO_SOLVERS_CLOSED_FORM_VALID_MATCHES_H_

#include <string>

#include "features/base/types.h"

namespace quatro {

// Returns false and says why in *error if column i of one cannot be matched
// with column i of the other.
bool AreValidMatches(const PointsRef& source,
                     const PointsRef& target,
                     std::string* error);

}  // namespace quatro

#endif  // QUATRO_SOLVERS_CLOSED_FORM_VALID_MATCHES_H_
