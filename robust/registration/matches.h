// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#ifndef QUATRO_ROBUST_REGISTRATION_MATCHES_H_
#define QUATRO_ROBUST_REGISTRATION_MATCHES_H_

#include "features/base/types.h"

namespace quatro {

// Column i of `source` is matched with column i of `target` [m].
struct Matches {
  PointsRef source;
  PointsRef target;
};

}  // namespace quatro

#endif  // QUATRO_ROBUST_REGISTRATION_MATCHES_H_
