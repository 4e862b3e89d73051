// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Robust kernels rho(s) of a squared error s >= 0, with width c > 0:
//
//   none           s                                       weight 1
//   Huber          s if s <= c^2, else 2 c sqrt(s) - c^2   min(1, c / sqrt(s))
//   Cauchy         c^2 log(1 + s / c^2)                    c^2 / (c^2 + s)
//   Geman-McClure  c^2 s / (c^2 + s)                       (c^2 / (c^2 + s))^2
//
// The weight is the derivative of rho. Each kernel is concave in s and behaves
// like s for small s. So a step that lowers the weighted sum of the s also
// lowers the sum of the rho(s).

#ifndef QUATRO_SOLVERS_LOCAL_ROBUST_KERNEL_H_
#define QUATRO_SOLVERS_LOCAL_ROBUST_KERNEL_H_

#include <cmath>

namespace quatro {

// The kernels above, by name.
enum class RobustKernelType { kNone, kHuber, kCauchy, kGemanMcClure };

// A kernel and its width.
struct RobustKernel {
  RobustKernelType type = RobustKernelType::kNone;
  double width = 1.0;  // c, in units of sqrt(s). Not used by kNone.

  // rho(s).
  double Cost(double s) const {
    const double c2 = width * width;
    switch (type) {
      case RobustKernelType::kHuber:
        return s <= c2 ? s : 2.0 * width * std::sqrt(s) - c2;
      case RobustKernelType::kCauchy:
        return c2 * std::log1p(s / c2);
      case RobustKernelType::kGemanMcClure:
        return c2 * s / (c2 + s);
      case RobustKernelType::kNone:
        break;
    }
    return s;
  }

  // rho'(s).
  double Weight(double s) const {
    const double c2 = width * width;
    switch (type) {
      case RobustKernelType::kHuber:
        return s <= c2 ? 1.0 : width / std::sqrt(s);
      case RobustKernelType::kCauchy:
        return c2 / (c2 + s);
      case RobustKernelType::kGemanMcClure:
        return c2 * c2 / ((c2 + s) * (c2 + s));
      case RobustKernelType::kNone:
        break;
    }
    return 1.0;
  }
};

}  // namespace quatro

#endif  // QUATRO_SOLVERS_LOCAL_ROBUST_KERNEL_H_
