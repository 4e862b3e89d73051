// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The condition on matched points (p_i, q_i), i < N, that all estimators share:
// the numbers of p_i and q_i are equal, and all points are finite. N may be
// zero.

#ifndef QUATRO_SOLVERS_CLOSED_FORM_VALID_MATCHES_H_
#define QUATRO_SOLVERS_CLOSED_FORM_VALID_MATCHES_H_

#include <string>

#include "features/base/types.h"

namespace quatro {

// Returns false and sets *error unless column i of `source` can be matched with
// column i of `target` for all i.
bool AreValidMatches(const PointsRef& source,
                     const PointsRef& target,
                     std::string* error);

}  // namespace quatro

#endif  // QUATRO_SOLVERS_CLOSED_FORM_VALID_MATCHES_H_
