// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// log |Gamma(x)|, the bits of std::lgamma, which writes a global (the sign) and
// must not be called by two threads at once.

#ifndef QUATRO_ROBUST_LOG_GAMMA_H_
#define QUATRO_ROBUST_LOG_GAMMA_H_

#include <cmath>

namespace quatro {

// By POSIX, and so not of std.
inline double LogGamma(double x) {
  int sign = 0;
  return ::lgamma_r(x, &sign);
}

}  // namespace quatro

#endif  // QUATRO_ROBUST_LOG_GAMMA_H_
