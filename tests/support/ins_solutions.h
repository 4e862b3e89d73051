// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Estimators with an INS, through RegisterMatches().

#ifndef QUATRO_TESTS_SUPPORT_INS_SOLUTIONS_H_
#define QUATRO_TESTS_SUPPORT_INS_SOLUTIONS_H_

#include "features/base/types.h"
#include "robust/registration/registration.h"

namespace quatro {

// The solution of any solver; invalid input is in its message.
inline PoseSummary SolveWithIns(const PointsRef& source,
                                const PointsRef& target,
                                const PoseSolver& solver,
                                double noise_bound,
                                const InsOptions& ins) {
  RegistrationOptions options;
  options.solver = solver;
  options.noise_bound = noise_bound;
  options.ins = ins;
  RegistrationSummary summary = RegisterMatches({source, target}, options);
  if (!summary.error.empty()) summary.solution.message = summary.error;
  return summary.solution;
}

inline PoseSummary SolveQuatroWithIns(const PointsRef& source,
                                      const PointsRef& target,
                                      const QuatroOptions& options,
                                      const InsOptions& ins) {
  const PoseSolver solver = [&](const PointsRef& p, const PointsRef& q) {
    return SolveQuatro(p, q, options);
  };
  return SolveWithIns(source, target, solver, options.noise_bound, ins);
}

}  // namespace quatro

#endif  // QUATRO_TESTS_SUPPORT_INS_SOLUTIONS_H_
