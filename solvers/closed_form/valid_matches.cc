// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "solvers/closed_form/valid_matches.h"

namespace quatro {

bool AreValidMatches(const PointsRef& source,
                     const PointsRef& target,
                     std::string* error) {
  if (source.cols() != target.cols()) {
    *error = std::to_string(source.cols()) + " source points but " +
             std::to_string(target.cols()) +
             " target points; equal numbers are required";
    return false;
  }
  if (!source.allFinite() || !target.allFinite()) {
    *error = "a matched point is not finite";
    return false;
  }
  return true;
}

}  // namespace quatro
